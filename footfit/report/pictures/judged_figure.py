"""What was judged of a foot in a last: each zone at its place on the foot, in its verdict's colour.

A verdict is a colour, a shape and a line's width, so that a grey print says the same.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.number_words import signed
from footfit.report.pictures.drawn_outlines import is_left, side_outline
from footfit.report.pictures.figures import (
    FILL,
    INK,
    QUIET,
    VERDICT_COLOURS,
    Point,
    draw_scale_bar,
    hide_axes,
    new_figure,
)
from footfit.report.wording.zone_words import mark, zone_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from footfit.results import FootFit, Profiled, ToeBox, ZoneFit

WIDTHS = {"good": 1.8, "acceptable": 3.0, "poor": 4.4, "reject": 5.6}
SHOWN_HEIGHT = 0.40
"""How much of a leg is drawn, over the length."""
WIDE_INCHES, SIDE_INCHES, TOES_INCHES = 5.3, 3.1, 2.3
LINE = 0.062
"""From one line of words to the next in the side view, over the length."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a zone is drawn in the side view, over the length.

    ``start`` and ``end`` are along the foot, and ``words`` is where its words are, along and up.
    """

    start: float
    end: float
    words: tuple[float, float]


GIRTHS = {
    "short_heel_girth": Place(0.03, 0.34, (0.16, SHOWN_HEIGHT + LINE)),
    "ball_girth": Place(0.66, 0.71, (0.80, SHOWN_HEIGHT + LINE)),
    "instep_girth": Place(0.50, 0.50, (0.50, SHOWN_HEIGHT + 2.0 * LINE)),
    "waist_girth": Place(0.58, 0.58, (0.80, SHOWN_HEIGHT + 3.0 * LINE)),
    "long_heel_girth": Place(0.03, 0.48, (0.16, SHOWN_HEIGHT + 3.0 * LINE)),
    "instep_height": Place(0.50, 0.50, (0.50, SHOWN_HEIGHT + 4.0 * LINE)),
    "toe_height": Place(0.92, 0.92, (0.99, 0.225)),
}
"""Zones over the foot: a line from its sole to its top."""
WIDTH_PLACES = {
    "heel_width": Place(0.06, 0.27, (0.16, -1.4 * LINE)),
    "ball_width": Place(0.61, 0.77, (0.69, -1.4 * LINE)),
    "ball_line": Place(0.65, 0.73, (0.69, -2.9 * LINE)),
    "ball_width_orthogonal": Place(0.61, 0.77, (0.16, -2.9 * LINE)),
}
"""Zones under the foot: a line along it."""
WORDS_MM, WORDS_HALF_MM, TOES_HALF_MM = 4.0, 4.0, 105.0
"""How far behind a toe's front its words end, half of their height, and half of the picture."""


def judged_figure(foot: Profiled, fit: FootFit) -> Figure:
    """The foot from the side with its girths, and its toes in the last from above."""
    zones = {zone.zone: zone for zone in fit.zones}
    box = fit.toe_box if "toes" in zones else None
    heights = (SIDE_INCHES,) if box is None else (SIDE_INCHES, TOES_INCHES)
    with new_figure(WIDE_INCHES, sum(heights)) as figure:
        axes = figure.subplots(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
        _draw_side(axes[0], foot, zones)
        shown = {*GIRTHS, *WIDTH_PLACES, "length"}
        if box is not None:
            _draw_toes(axes[1], box, zones["toes"], mirror=-1.0 if is_left(foot) else 1.0)
            shown.add("toes")
        rest = [zone_text(zone) for zone in fit.zones if zone.zone not in shown]
        if rest:
            figure.supxlabel("    ".join(rest), fontsize=9, color=INK)
    return figure


def zone_style(zone: ZoneFit) -> dict[str, Any]:
    """The colour and width of the line that a zone is drawn with; thin and grey if it judges
    nothing.
    """
    verdict = (zone.verdict or "") if zone.counts else ""
    return {"color": VERDICT_COLOURS.get(verdict, QUIET), "linewidth": WIDTHS.get(verdict, 1.0)}


def _draw_side(axes: Axes, foot: Profiled, zones: Mapping[str, ZoneFit]) -> None:
    """The foot from the side, toe to the right: girths over it, widths and ball line under it."""
    prepared = foot.aligned.prepared
    outline = side_outline(prepared.vertices_mm, prepared.faces)
    length = float(np.ptp(outline.x_mm))
    x, top = (outline.x_mm - outline.x_mm[0]) / length, outline.second_mm / length
    low, top = np.minimum(outline.first_mm / length, SHOWN_HEIGHT), np.minimum(top, SHOWN_HEIGHT)
    axes.fill_between(x, low, top, facecolor=FILL, edgecolor=INK, linewidth=1.2)
    for name, place in GIRTHS.items():
        if name in zones:
            ends = [(place.start, 0.0), (place.end, float(np.interp(place.end, x, top)))]
            _draw_zone(axes, zones[name], ends, place.words)
    for name, place in WIDTH_PLACES.items():
        if name in zones:
            height = place.words[1] + 0.6 * LINE
            _draw_zone(axes, zones[name], [(place.start, height), (place.end, height)], place.words)
    room = zones.get("length")
    if room is not None and room.clearance.value is not None:
        front = 1.0 + room.clearance.value / length
        axes.plot([front, front], [0.0, 0.10], color=INK, linestyle=(0, (5, 2)), linewidth=1.2)
        _draw_zone(axes, room, [(1.0, 0.04), (front, 0.04)], (1.10, 0.145))
    axes.set_title("Judged: girths, widths, toe room")
    axes.set_xlim(-0.08, 1.30)
    axes.set_ylim(-3.6 * LINE, SHOWN_HEIGHT + 2.9 * LINE)
    hide_axes(axes)


def _draw_zone(axes: Axes, zone: ZoneFit, ends: Sequence[Point], words: Point) -> None:
    """A zone's line, its words, and a thin line between them."""
    style = zone_style(zone)
    axes.plot(*np.transpose(ends), solid_capstyle="butt", **style)
    middle = (0.5 * (ends[0][0] + ends[1][0]), ends[1][1])
    near = ends[1] if words[1] > ends[1][1] else middle
    axes.plot(*np.transpose([near, words]), color=style["color"], linewidth=0.5, zorder=0)
    _write(axes, zone_text(zone), words, zone)


def _write(axes: Axes, words: str, place: Point, zone: ZoneFit) -> None:
    """Write a zone's words, centred, on a white ground."""
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.85}
    colour = zone_style(zone)["color"]
    axes.text(*place, words, ha="center", va="center", fontsize=9, color=colour, bbox=box)


def _draw_toes(axes: Axes, box: ToeBox, zone: ZoneFit, mirror: float) -> None:
    """The toes at toe height in the last's wall, from above; the number of each beside it."""
    axes.set_title("Judged: toes, in mm from the wall")
    hide_axes(axes)
    flip = np.array([1.0, mirror])
    x, lateral, medial = box.wall_mm.T
    wall = np.concatenate([np.column_stack([x, lateral]), np.column_stack([x, medial])[::-1]])
    foot = box.outline_mm * flip
    axes.fill(*foot.T, facecolor=FILL)
    axes.plot(*(wall * flip).T, color=INK, linewidth=1.4, linestyle=(0, (5, 2)))
    for number, toe in enumerate(box.toes):
        own, tightest = foot[box.toe == number], toe == box.tightest
        style = zone_style(zone) if tightest else {"color": INK, "linewidth": 1.2}
        axes.plot(*own.T, solid_capstyle="butt", **style)
        number_mm = "-" if toe.clearance.value is None else signed(toe.clearance.value)
        words = f"{mark(zone)} {toe.toe} {number_mm}" if tightest else f"{toe.toe} {number_mm}"
        height = 0.5 * float(own[:, 1].min() + own[:, 1].max())
        off = np.abs(own[:, 1] - height)
        front = own[off <= max(WORDS_HALF_MM, float(off.min())), 0]
        axes.text(
            float(front.min()) - WORDS_MM,
            height,
            words,
            ha="right",
            va="center",
            fontsize=9,
            color=style["color"],
        )
    middle = 0.5 * float(x[0] + x[-1])
    axes.set_xlim(middle - TOES_HALF_MM, middle + TOES_HALF_MM)
    draw_scale_bar(axes, 20.0, place=(0.0, 0.02))
