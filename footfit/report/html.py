"""The page of one match: a file that opens offline, prints on A4 and asks for no trust.

It holds no script, names no outside address and no folder of the machine; every name is escaped;
the pictures are images inside the page, which a browser draws without running anything.
"""

from __future__ import annotations

import base64
from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING

from footfit import __version__
from footfit.report.html_style import STYLE, policy
from footfit.report.parts import NOT_YET
from footfit.report.text import (
    file_name,
    measured_text,
    plain,
    signed,
    size_text,
    tie_words,
    visible,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from footfit.report.match_figure import Shapes
    from footfit.results import Candidate, Match, Notice, Profiled

HOW = {
    "fit": "Lasts whose length leaves the toe room that the profile asks for, nearest flare "
    "profile first; of tied lasts the one with the best length comes first.",
    "flare": "All lasts, nearest flare profile first. This search is scale-free: it compares "
    "shapes and cannot tell one size from another, so look at the length.",
    "shape": "All lasts, nearest in length and flare profile first: which last is this?",
}
ONLY_FEW_FEET = 2
"""Each foot has its own pictures; a customer has at most two."""


def match_report(match: Match, shapes: Shapes | None = None) -> str:
    """One customer's answer as a whole HTML page; the same bytes for the same match.

    Parameters
    ----------
    match : Match
    shapes : mapping of str to (vertices_mm, faces), optional
        The candidates' meshes by name, canonical mm, each on its own side; the pictures draw
        the outline of those that are there.
    """
    body = [
        "<h1>Which last fits?</h1>",
        f'<p class="lead">{text(_lead(match))}</p>',
        _best(match),
        *(_warning(notice) for notice in match.warnings),
        "<h2>The feet</h2>" if len(match.feet) > 1 else "<h2>The foot</h2>",
        f'<div class="feet">{"".join(_foot(foot) for foot in match.feet)}</div>',
        _pair(match),
        "<h2>The lasts, best first</h2>",
        f"<p>{text(HOW[match.by])}</p>",
        _table(match),
        f"<p>{text(_left_out(match))}</p>",
        "<h2>How to read it</h2>",
        _legend(match),
        "<h2>Pictures</h2>",
        *(_pictures(match, index, shapes) for index in range(len(match.feet))),
        f"<footer>footfit {text(__version__)}</footer>",
    ]
    return _page(title=f"footfit: {_names(match)}", body="\n".join(body))


def text(outside: str) -> str:
    """An outside string as HTML text or an attribute's value: escaped, nothing hidden in it."""
    return escape(visible(outside), quote=True)


def _page(title: str, body: str) -> str:
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy()}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<title>{text(title)}</title>
<style>{STYLE}</style>
</head>
<body>
{body}
</body>
</html>
"""


def _names(match: Match) -> str:
    return ", ".join(file_name(foot.aligned.alignment.info.path) for foot in match.feet)


def _lead(match: Match) -> str:
    noun = "last" if match.catalogue_lasts == 1 else "lasts"
    profile = f", fit profile {match.profile}" if match.by == "fit" else ""
    return f"{_names(match)} against {match.catalogue_lasts} {noun}, by {match.by}{profile}."


def _best(match: Match) -> str:
    if not match.candidates:
        return '<div class="best"><p><b>No last fits.</b></p></div>'
    best = match.candidates[0]
    labels = _labels(best)
    aside = f" <span>{text(labels)}</span>" if labels else ""
    tie = f"<p>{text(tie_words(best.tied_with))}</p>" if best.tied_with else ""
    name = f"<p><b>{text(best.last)}</b>{aside}</p>"
    return f'<div class="best">{name}<p>{text(best.why)}.</p>{tie}</div>'


def _labels(candidate: Candidate) -> str:
    size = size_text(candidate.size, candidate.size_system, candidate.width_label)
    side = f"{candidate.side} last, mirrored" if candidate.mirrored else ""
    return ", ".join(part for part in (candidate.style, size, side) if part)


def _warning(notice: Notice) -> str:
    return f'<p class="warn"><b>Note:</b> {text(notice.message)}</p>'


# ---------------------------------------------------------------- the feet


def _foot(foot: Profiled) -> str:
    alignment, flare = foot.aligned.alignment, foot.flare
    side = alignment.side
    word = side.side or "side undecided"
    angle = f"{signed(flare.angle_deg)} ± {plain(flare.angle_sd_deg)} degrees"
    rows = [
        ("Side", f"{word} ({'given' if side.source == 'given' else side.confidence})"),
        *_measures(foot),
        ("Flare", f"{angle}: {flare.flare_class}"),
        ("Scan", f"{alignment.info.faces:,} faces, read in {alignment.info.units}"),
    ]
    facts = "".join(f"<dt>{text(name)}</dt><dd>{text(value)}</dd>" for name, value in rows)
    notes = "".join(_warning(notice) for notice in alignment.warnings)
    name = text(file_name(alignment.info.path))
    return f'<section class="foot"><h3>{name}</h3><dl>{facts}</dl>{notes}</section>'


def _measures(foot: Profiled) -> Iterable[tuple[str, str]]:
    """The foot's measures, its length first even where none was taken."""
    if not any(measure.name == "length" for measure in foot.measures):
        yield "Length", f"{plain(foot.aligned.alignment.length_mm)} mm"
    for measure in foot.measures:
        name = measure.name.replace("_", " ").capitalize()
        yield name, measured_text(measure.measured, "mm")


def _pair(match: Match) -> str:
    lengths = [foot.aligned.alignment.length_mm for foot in match.feet]
    if len(lengths) != ONLY_FEW_FEET:
        return ""
    difference = plain(abs(lengths[0] - lengths[1]))
    return f"<p>The feet differ by {difference} mm in length; the longer one governs.</p>"


# ---------------------------------------------------------------- the lasts


def _table(match: Match) -> str:
    if not match.candidates:
        return ""
    judged = any(candidate.verdict for candidate in match.candidates)
    heads = [("", "n"), ("Last", ""), ("Style, size", ""), ("Distance", "n")]
    heads += [("Flare, degrees", "n"), ("Toe room, mm", "n")]
    heads += [("Verdict", "")] * judged + [("Why", "")]
    head = "".join(f'<th scope="col" class="{kind}">{text(name)}</th>' for name, kind in heads)
    rows = "\n".join(_row(candidate, judged=judged) for candidate in match.candidates)
    return f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>"


def _row(candidate: Candidate, *, judged: bool) -> str:
    length = dict(candidate.clearance_mm).get("length", NOT_YET)
    spread = "" if length.sd is None else f" ± {plain(length.sd)}"
    room = "-" if length.value is None else f"{signed(length.value)}{spread}"
    tie = f"; {tie_words(candidate.tied_with)}" if candidate.tied_with else ""
    cells = [
        (str(candidate.rank), "n"),
        (candidate.last, "name"),
        (_labels(candidate) or "-", "label"),
        (plain(candidate.distance, 2), "n"),
        (signed(candidate.flare.delta_deg), "n"),
        (room, "n"),
        *([(candidate.verdict or "-", "")] if judged else []),
        (candidate.why + tie, "why"),
    ]
    row = "".join(f'<td class="{kind}">{text(value)}</td>' for value, kind in cells)
    kind = "first" if candidate.rank == 1 else "other"
    return f'<tr class="{kind}">{row}</tr>'


def _left_out(match: Match) -> str:
    if not match.rejected:
        return "No last was left out."
    reasons = "; ".join(f"{count} {reason.replace('_', ' ')}" for reason, count in match.rejected)
    return f"Left out: {reasons}."


def _legend(match: Match) -> str:
    reference = f" The reference last is {match.reference}." if match.reference else ""
    definition = match.feet[0].flare.definition.version
    lines = (
        "Flare is the turn of the forefoot against the rearfoot, seen from above: + is inflare "
        "(towards the big toe's side). In the table it is the last's flare minus the foot's.",
        "Toe room is the last's length minus the foot's; ± is one standard deviation.",
        f"Distance says how far two flare profiles are apart (definition {definition}); "
        "0 is the same, and lasts that are tied are not told apart by it.",
        f"Lasts of the other side are mirrored for comparing.{reference}",
    )
    return "".join(f"<p>{text(line)}</p>" for line in lines)


# ---------------------------------------------------------------- the pictures


def _pictures(match: Match, index: int, shapes: Shapes | None) -> str:
    from footfit.report.flare_figure import flare_figure
    from footfit.report.match_figure import SHOWN, match_figure

    foot = match.feet[index]
    name = file_name(foot.aligned.alignment.info.path)
    lasts = ", ".join(visible(candidate.last) for candidate in match.candidates[:SHOWN])
    against = f"{name} with the best lasts: {lasts}" if lasts else name
    angle = f"{signed(foot.flare.angle_deg)} ± {plain(foot.flare.angle_sd_deg)} degrees"
    return "\n".join(
        (
            _figure(
                match_figure(match, shapes, index),
                f"{against}. Sole from above, profile from the side, heading and plan curvature "
                "along the centre line.",
            ),
            _figure(
                flare_figure(foot),
                f"{name}: flare {angle}, {foot.flare.flare_class}. The sole from above with its "
                "centre line, the heading, and the curvature of the plan and of the bottom.",
            ),
        )
    )


def _figure(figure: Figure, words: str) -> str:
    from footfit.report.figures import svg_text

    data = base64.b64encode(svg_text(figure).encode("utf-8")).decode("ascii")
    image = f'<img alt="{text(words)}" src="data:image/svg+xml;base64,{data}">'
    return f"<figure>{image}<figcaption>{text(words)}</figcaption></figure>"
