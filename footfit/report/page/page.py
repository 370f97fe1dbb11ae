"""What every page shares: one file, a strict policy, escaped words, pictures inside it."""

from __future__ import annotations

import base64
from html import escape
from typing import TYPE_CHECKING

from footfit import __version__
from footfit.report.page.page_style import STYLE, policy
from footfit.report.page.scene import scene_script
from footfit.report.wording.text import visible

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from matplotlib.figure import Figure

    from footfit.results import Notice

LIGHTS = {"good": "●", "acceptable": "▲", "poor": "■", "reject": "✕"}
"""A shape beside each word, so that no one needs the colours."""
Cell = tuple[str, str]
"""HTML of a cell, and its class."""


def text(outside: str) -> str:
    """An outside string as HTML text or an attribute's value: escaped, nothing hidden in it."""
    return escape(visible(outside), quote=True)


def page(title: str, body: Iterable[str], *, scene: bool) -> str:
    """A whole page; with the viewer's script, and the policy that lets it run, where asked for."""
    script = scene_script() if scene else None
    running = f"<script>{script}</script>\n" if script else ""
    content = "\n".join(part for part in body if part)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy(script)}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<title>{text(title)}</title>
<style>{STYLE}</style>
</head>
<body>
{content}
<footer>footfit {text(__version__)}</footer>
{running}</body>
</html>
"""


def light(verdict: str | None) -> str:
    """A verdict as a shape and a word.

    Examples
    --------
    >>> light("good")
    '<span class="light good"><i>●</i> good</span>'
    >>> light(None)
    '<span class="light none">not judged</span>'
    """
    if verdict not in LIGHTS:
        return '<span class="light none">not judged</span>'
    return f'<span class="light {verdict}"><i>{LIGHTS[verdict]}</i> {verdict}</span>'


def shape_of(verdict: str | None) -> str:
    """A verdict as a shape alone, with its word for who cannot see it."""
    if verdict not in LIGHTS:
        return '<i class="none" title="not judged">–</i>'
    return f'<i class="{verdict}" title="{verdict}">{LIGHTS[verdict]}</i>'


def table(heads: Sequence[tuple[str, str]], rows: Iterable[Sequence[Cell]], kind: str = "") -> str:
    """A table; ``heads`` are words with a class, cells are HTML with a class.

    Each row's first cell of class "name" is the row's head. A cell knows its column's head, since a
    narrow screen shows a row as a paragraph.
    """
    head = "".join(f'<th scope="col" class="{style}">{text(name)}</th>' for name, style in heads)
    names = [name for name, _ in heads]
    cells = (map(_cell, row, names) for row in rows)
    lines = "\n".join(f"<tr>{''.join(row)}</tr>" for row in cells)
    return (
        f'<div class="scroll"><table class="{kind}">\n<thead><tr>{head}</tr></thead>\n'
        f"<tbody>\n{lines}\n</tbody>\n</table></div>"
    )


def _cell(cell: Cell, head: str) -> str:
    content, kind = cell
    if kind.startswith("name"):
        return f'<th scope="row" class="{kind}">{content}</th>'
    return f'<td class="{kind}" data-head="{text(head)}">{content}</td>'


def together(title: str, content: str) -> str:
    """A part of the page under its title, on one sheet of paper."""
    return f'<section class="together"><h2>{text(title)}</h2>{content}</section>'


def facts(rows: Iterable[tuple[str, str]]) -> str:
    """Names and values in two columns."""
    inside = "".join(f"<dt>{text(name)}</dt><dd>{text(value)}</dd>" for name, value in rows)
    return f"<dl>{inside}</dl>"


def warning(notice: Notice) -> str:
    """A notice as a paragraph that is seen."""
    return f'<p class="warn"><b>Note:</b> {text(notice.message)}</p>'


def picture(figure: Figure, words: str, kind: str = "") -> str:
    """A figure as an image inside the page: a browser draws it and runs nothing in it."""
    from footfit.report.pictures.figures import svg_text

    data = base64.b64encode(svg_text(figure).encode("utf-8")).decode("ascii")
    image = f'<img alt="{text(words)}" src="data:image/svg+xml;base64,{data}">'
    return f'<figure class="{kind}">{image}<figcaption>{text(words)}</figcaption></figure>'
