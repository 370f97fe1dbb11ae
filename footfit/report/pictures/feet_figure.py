"""A customer's feet from above and from the inner side, with a mark where the fit was judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.number_words import plain
from footfit.report.pictures import shading
from footfit.report.pictures.drawn_outlines import Mesh
from footfit.report.pictures.figures import (
    INK,
    QUIET,
    SKIN,
    VERDICT_COLOURS,
    arrow_style,
    new_figure,
    show_image,
    write_beside,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import SideName, Verdict

FROM_ABOVE = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""The wearer's own view: toes up, the left foot's inner side on its right."""
MARKERS = {"good": "o", "acceptable": "^", "poor": "s", "reject": "X"}
"""The shape of a verdict, as on the page."""
STATIONS = {"toes": 0.95, "ball": 0.70, "instep": 0.50, "heel": 0.12}
"""Where the marks stand, over the length from the heel."""
EDGE_VERTICES = 60
"""How many vertices near a station show where the foot's two edges are."""
LINE_MM = 5.0
"""How far under the sole the line of the length is drawn."""
SHANK = 0.42
"""How high over the sole a foot is drawn, over its length: the rest is leg."""
COLUMNS = 200
"""Pixels across a foot seen from above: 125 to an inch of paper."""
WIDE_MM, MARGIN_MM = 118.0, 14.0


@dataclass(frozen=True, slots=True)
class DrawnFoot:
    """A foot as it is drawn: its mesh on its own side, its length, and the verdicts by place."""

    mesh: Mesh
    side: SideName | None
    length_mm: float
    verdicts: Mapping[str, Verdict]

    def marks(self) -> dict[str, Verdict]:
        """The verdicts at places that a picture can show."""
        return {place: v for place, v in self.verdicts.items() if place in STATIONS}


def feet_figure(feet: Sequence[DrawnFoot]) -> Figure:
    """The feet beside each other from above, then each from its inner side, all to one scale."""
    long_mm, count = max(foot.length_mm for foot in feet) + 2.0 * MARGIN_MM, len(feet)
    with new_figure(7.6, 3.1 if count > 1 else 3.7) as figure:
        grid = figure.add_gridspec(count, count + 1, width_ratios=(*[WIDE_MM] * count, long_mm))
        for place, foot in enumerate(feet):
            _draw_from_above(figure.add_subplot(grid[:, place]), foot, long_mm, named=count > 1)
            side = figure.add_subplot(grid[place, count])
            _draw_from_the_side(side, foot, (long_mm, long_mm / count))
    return figure


def _draw_from_above(axes: Axes, foot: DrawnFoot, long_mm: float, *, named: bool) -> None:
    """The foot with its marks; its side is written under it if there are two."""
    seen = foot.mesh[0] @ FROM_ABOVE.T
    middle, low = 0.5 * float(seen[:, 0].min() + seen[:, 0].max()), float(seen[:, 1].min())
    half, bottom = 0.5 * WIDE_MM, low - MARGIN_MM
    frame = shading.Frame(middle - half, middle + half, bottom, bottom + long_mm)
    show_image(axes, _image(seen, foot.mesh[1], frame), frame)
    for place, verdict in foot.marks().items():
        _draw_mark(axes, _middle(seen, low + STATIONS[place] * foot.length_mm), verdict)
    if named and foot.side:
        write_beside(axes, foot.side, (middle, bottom), fontsize=9, color=QUIET)


def _middle(seen: Floats, y: float) -> tuple[float, float]:
    """Half-way between the two edges of a foot at a height of the picture."""
    nearest = seen[np.argsort(np.abs(seen[:, 1] - y), kind="stable")[:EDGE_VERTICES], 0]
    return 0.5 * float(nearest.min() + nearest.max()), y


def _draw_from_the_side(axes: Axes, foot: DrawnFoot, size_mm: tuple[float, float]) -> None:
    """The inner side in the middle of a frame of this width and height, with the length under it.

    What stands higher than the frame is leg.
    """
    view = shading.VIEWS["from_right" if foot.side == "left" else "from_left"]
    seen = foot.mesh[0] @ view.T
    low, base = float(seen[:, 0].min()), float(seen[:, 1].min())
    top = min(float(seen[:, 1].max()), base + SHANK * foot.length_mm)
    seen, faces = _below(seen, foot.mesh[1], top)
    bottom = 0.5 * (base - LINE_MM - MARGIN_MM + top - size_mm[1])
    left = low - MARGIN_MM
    frame = shading.Frame(left, left + size_mm[0], bottom, bottom + size_mm[1])
    show_image(axes, _image(seen, faces, frame), frame)
    line, ends = base - LINE_MM, (low, low + foot.length_mm)
    style = arrow_style(INK, 0.8, "<|-|>")
    axes.annotate("", (ends[1], line), xytext=(ends[0], line), arrowprops=style)
    words = f"{plain(foot.length_mm)} mm"
    write_beside(axes, words, (0.5 * sum(ends), line), (0, -10), fontsize=8.5, color=INK)


def _below(seen: Floats, faces: Ints, top: float) -> tuple[Floats, Ints]:
    """A surface without the faces that lie over a height of the picture."""
    return seen, faces[(seen[faces, 1] <= top).any(axis=1)]


def _image(seen: Floats, faces: Ints, frame: shading.Frame) -> Floats:
    columns = round(COLUMNS * (frame.right - frame.left) / WIDE_MM)
    return shading.shaded_image(seen, faces, frame, columns, np.array(SKIN))


def _draw_mark(axes: Axes, place: tuple[float, float], verdict: Verdict) -> None:
    shape, colour = MARKERS[verdict], VERDICT_COLOURS[verdict]
    axes.scatter(*place, marker=shape, s=52, color=colour, edgecolors="white", linewidths=1.2)
