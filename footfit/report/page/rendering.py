"""Pages from templates: one file, a strict policy, every outside string escaped."""

from __future__ import annotations

import base64
import hashlib
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

from footfit import number_words
from footfit.report.wording import (
    comparison_words,
    coverage_words,
    fit_words,
    sheet_words,
    text,
    width_words,
    zone_words,
)
from footfit.version import __version__

if TYPE_CHECKING:
    from jinja2 import Environment, Template
    from matplotlib.figure import Figure

    from footfit.report.page.scene import Scene

FILTERS = (
    text.difference_text,
    text.file_name,
    text.measured_text,
    number_words.plain,
    text.side_doubts,
    text.class_words,
    number_words.signed,
    fit_words.left_out_words,
    fit_words.toe_room_text,
    fit_words.zone_number,
    fit_words.zone_label,
    text.tie_words,
    text.turn_words,
    comparison_words.change_words,
    comparison_words.lengths_words,
    comparison_words.measures_words,
    comparison_words.surfaces_words,
    comparison_words.swing_words,
    coverage_words.feet_words,
    coverage_words.next_words,
    coverage_words.percent_words,
    coverage_words.share_words,
    sheet_words.fit_words,
    sheet_words.shoe_labels,
    width_words.fittings_words,
    width_words.shares_words,
)
"""The words and numbers that a template asks for by the function's name."""


def html_page(
    template: str | Template,
    *,
    scene: Scene | None = None,
    style: str = "style.css",
    **values: object,
) -> str:
    """A whole page; with the viewer's script, and the policy that lets it run, for a ``scene``.

    Parameters
    ----------
    template : str or Template
        The name of a template of this package, or one that ``templates`` made.
    scene : Scene, optional
        The page's 3D view.
    style : str
        The name of a style sheet of this package.
    **values
        What the template shows.

    Raises
    ------
    jinja2.UndefinedError
        The template uses a value that is not there.
    """
    from markupsafe import Markup

    look, script = page_file(style), page_file("scene.js") if scene else ""
    own = {
        "version": __version__,
        "policy": policy(look, script),
        "style": Markup(look),
        "script": Markup(script),
    }
    return templates().get_template(template).render(values, scene=scene, **own)


@cache
def templates() -> Environment:
    """The page's templates: those of this package and no others.

    Every value is escaped, and no character of a string can hide.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    def shown(value: Any) -> Any:
        outside = isinstance(value, str) and not hasattr(value, "__html__")
        return text.visible(value) if outside else value

    environment = Environment(
        loader=PackageLoader(__package__),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=shown,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.globals["spreads"] = text.SPREADS
    environment.globals["marks"] = zone_words.MARKS
    environment.filters |= {function.__name__: function for function in FILTERS}
    return environment


def picture_data(figure: Figure) -> str:
    """A figure as SVG in base64, for the address of an image inside the page."""
    from footfit.report.pictures.figures import svg_text

    return base64.b64encode(svg_text(figure).encode("utf-8")).decode("ascii")


@cache
def page_file(name: str) -> str:
    """The style sheet or the viewer's script, as it stands in the page."""
    return resources.files(__package__).joinpath(name).read_text(encoding="utf-8")


def policy(style: str, script: str = "") -> str:
    """The content-security policy: this style, this script if there is one, pictures inside the
    page, nothing from outside and nothing to outside.
    """
    runs = f"script-src '{content_hash(script)}'; " if script else ""
    return (
        f"default-src 'none'; {runs}style-src '{content_hash(style)}'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )


def content_hash(content: str) -> str:
    """A style's or script's hash as a content-security policy names it."""
    digest = hashlib.sha256(content.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"
