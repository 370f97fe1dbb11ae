"""The pictures of a page, each with the words that say what it shows."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from footfit.report.wording.text import file_name, visible
from footfit.results import Candidate, FlareDifference, Match

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.report.pictures.match_figure import Shapes
    from footfit.results import Comparison


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure as an image inside the page: a browser draws it and runs nothing in it.

    ``data`` is SVG in base64, ``words`` say what it shows, ``kind`` is how wide it is.
    """

    data: str
    words: str
    kind: str


def heat_picture(comparison: Comparison) -> Picture:
    """The room from four sides."""
    from footfit.report.pictures.heat_figure import heat_figure

    foot, last = comparison_names(comparison)
    words = (
        f"{foot} in {last} from four sides: blue is room, red is where the foot is larger; the "
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


def flare_picture(match: Match, index: int, shapes: Shapes | None) -> Picture:
    """Sole, profile, heading and plan curvature of one foot with its best lasts, heels together."""
    from footfit.report.pictures.match_figure import SHOWN, match_figure

    name = file_name(match.feet[index].aligned.alignment.info.path)
    lasts = ", ".join(visible(last.last) for last in (match.candidates or match.nearest)[:SHOWN])
    which = "best" if match.candidates else "nearest"
    against = f"{name} with the {which} lasts: {lasts}" if lasts else name
    return _picture(match_figure(match, shapes, index), f"{against}. {_FLARE_WORDS}", "flare")


def compared_flare_picture(comparison: Comparison) -> Picture:
    """The same of a foot and the one last that it was compared with."""
    from footfit.report.pictures.match_figure import match_figure

    foot, last = comparison_names(comparison)
    shapes = {comparison.last.labels.name: _stored_side(comparison)}
    figure = match_figure(_as_match(comparison), shapes)
    return _picture(figure, f"{foot} with {last}. {_FLARE_WORDS}", "flare")


_FLARE_WORDS = (
    "Sole from above, profile from the side, heading and plan curvature along the centre line."
)


def comparison_names(comparison: Comparison) -> tuple[str, str]:
    """What foot and last are called on a page."""
    foot = file_name(comparison.foot.aligned.alignment.info.path)
    return foot, visible(comparison.last.labels.name)


def _picture(figure: Figure, words: str, kind: str) -> Picture:
    from footfit.report.pictures.figures import svg_text

    data = base64.b64encode(svg_text(figure).encode("utf-8")).decode("ascii")
    return Picture(data, words, kind)


def _stored_side(comparison: Comparison) -> tuple[Floats, Ints]:
    """The last's mesh on its own side: the comparison holds a right shape."""
    vertices, faces = comparison.last_vertices_mm, comparison.last_faces
    if comparison.last.side.side != "left":
        return vertices, faces
    return vertices * np.array([1.0, -1.0, 1.0]), faces[:, ::-1]


def _as_match(comparison: Comparison) -> Match:
    """The comparison as the answer of a search that found this one last, for its flare plot."""
    last, labels = comparison.last, comparison.last.labels
    found = Candidate(
        rank=1,
        last=labels.name,
        style=labels.style,
        size=labels.size,
        size_system=labels.size_system,
        width_label=labels.width_label,
        side=last.side.side,
        mirrored=comparison.mirrored,
        distance=0.0,
        flare=FlareDifference(0.0, comparison.flare_delta_deg, ()),
        clearance_mm=(),
        verdict=None,
        why="",
        tied_with=(),
        record=last,
    )
    return Match((comparison.foot,), "shape", "", 1, None, (found,), (), ())
