"""The pictures of a page, each with the words that say what it shows."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.report.pictures.sides import own_side
from footfit.report.wording.comparison_words import comparison_names
from footfit.report.wording.text import file_name, visible

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from footfit.report.pictures.overlay_figure import Shapes
    from footfit.results import Comparison, Match, Profiled


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure as an image inside the page: a browser draws it and runs nothing in it.

    ``data`` is SVG in base64, ``words`` say what it shows, ``kind`` is how wide it is.
    """

    data: str
    words: str
    kind: str


def heat_picture(comparison: Comparison) -> Picture:
    """The clearance around the foot from four sides."""
    from footfit.report.pictures.heat_figure import heat_figure

    foot, last = comparison_names(comparison)
    words = (
        f"{foot} in {last} from four sides: blue is space, red is where the foot is larger; the "
        "dashed line is the last."
    )
    return _picture(heat_figure(comparison, titled=False), words, "wide")


def section_picture(comparison: Comparison, *, strip: bool = False) -> Picture:
    """The sections; in one strip where they are not the page's matter."""
    from footfit.report.pictures.section_figure import ACROSS, STRIP, section_figure

    foot, last = comparison_names(comparison)
    words = (
        f"{foot} (filled) and {last} (line) cut by the same planes, seen from behind; last minus "
        "foot in mm."
    )
    figure = section_figure(comparison, STRIP if strip else ACROSS, titled=False)
    return _picture(figure, words, "wide")


def flare_picture(match: Match, foot: Profiled, shapes: Shapes | None) -> Picture:
    """Sole, profile, heading and plan curvature of a foot with its best lasts, heels together."""
    from footfit.report.pictures.overlay_figure import drawn_lasts, overlay_figure

    lasts = drawn_lasts(match, foot, shapes)
    several = f"the {'best' if match.candidates else 'nearest'} lasts"
    names = ", ".join(visible(last.record.labels.name) for last in lasts)
    name = file_name(foot.aligned.alignment.info.path)
    words = f"{name} with {several}: {names}" if lasts else name
    return _picture(overlay_figure(foot, lasts, several), f"{words}. {_FLARE_WORDS}", "flare")


def compared_flare_picture(comparison: Comparison) -> Picture:
    """The same of a foot and the one last that it was compared with."""
    from footfit.report.pictures.overlay_figure import DrawnLast, overlay_figure

    foot, last = comparison_names(comparison)
    drawn = DrawnLast(1, comparison.last, own_side(comparison)[1])
    figure = overlay_figure(comparison.foot, [drawn], last)
    return _picture(figure, f"{foot} with {last}. {_FLARE_WORDS}", "flare")


_FLARE_WORDS = (
    "Sole from above, profile from the side, heading and plan curvature along the centre line."
)


def _picture(figure: Figure, words: str, kind: str) -> Picture:
    from footfit.report.pictures.figures import svg_text

    data = base64.b64encode(svg_text(figure).encode("utf-8")).decode("ascii")
    return Picture(data, words, kind)
