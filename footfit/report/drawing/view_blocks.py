"""The views of a drawing as blocks: an outline, its marks and their names, and its title."""

from __future__ import annotations

import numpy as np

from footfit.geometry.drawing.views import SOLE_HEIGHT_MM, Mark, View, chord
from footfit.geometry.numeric.arrays import Floats
from footfit.number_words import plain
from footfit.report.drawing.measure_words import measure_words
from footfit.report.drawing.papers import TICK_MM, UNDER_CROSS_MM
from footfit.report.drawing.parts import (
    BOUNDARY,
    EDGE_MM,
    Anchor,
    Block,
    Line,
    Words,
    joined,
    paragraph,
    straight,
)
from footfit.results import Drawing, Measure

TITLE_MM, SMALL_MM = 3.5, 2.4
BESIDE_MM = 2.0
HEIGHT_MM, END_MM = 2.5, 3.7
"""How far beyond the heel and the toe a height stands, and the ground ends."""
TITLE_ABOVE_MM = 9.0
"""How far over the middle of its gap a title inside an outline begins."""
IN_SECTION = {"heel": "heel_width", "instep": "instep_girth", "ball": "ball_girth"}
"""The measures that are taken in the planes of named sections."""
TITLES = {"bottom": "bottom", "plan": "plan", "side": "side"}


def view_block(drawing: Drawing, view: View) -> Block:
    """One view with its marks and its title: inside a bottom or a plan, else beside the outline."""
    outlines = tuple(
        Line(outline, BOUNDARY, view.name, closed=True, width_mm=EDGE_MM)
        for outline in view.outlines_mm
    )
    body = joined([Block(outlines), _marks(drawing, view)])
    x, y, anchor = _title_place(view, body)
    name = TITLES.get(view.name, f"section: {view.name}")
    if view.name == "bottom" and drawing.alignment.pose.kind == "last":
        name = "bottom, laid flat"
    title = paragraph([name], (x, y), TITLE_MM, anchor=anchor, bold=True)
    below = y - 1.0 - 1.45 * TITLE_MM
    details = paragraph(_details(drawing, view), (x, below), SMALL_MM, anchor=anchor)
    return joined([body, Block(words=title + details)])


def _title_place(view: View, body: Block) -> tuple[float, float, Anchor]:
    """Where a title begins: in the widest gap between marks, over the toe, or below."""
    low, high = view.bounds_mm
    if view.name == "side":
        return float(high[0]), float(high[1]) - UNDER_CROSS_MM, "end"
    if view.name not in TITLES:
        return float(low[0]), float(body.bounds[0][1]) - 1.5, "start"
    levels = np.sort([mark.points_mm[:, 1].mean() for mark in view.marks])
    levels = np.concatenate([low[1:], levels, high[1:]])
    widest = int(np.argmax(np.diff(levels)))
    y = float(levels[widest : widest + 2].mean()) + TITLE_ABOVE_MM
    across = chord(view.outlines_mm, np.array([[low[0], y], [high[0], y]]))
    middle = low[0] + high[0] if across is None else across[:, 0].sum()
    return 0.5 * float(middle), y, "middle"


def _details(drawing: Drawing, view: View) -> list[str]:
    """What is said of a view: how it is seen, and what is measured in it."""
    kind = drawing.alignment.pose.kind
    medial = "left" if drawing.alignment.side.side == "right" else "right"
    seen = ["seen from above,", f"medial on the {medial}"]
    stands = "resting" if drawing.alignment.standing_transform is None else "standing"
    if view.name == "bottom":
        if kind == "foot":
            return [f"what lies lower than {SOLE_HEIGHT_MM:.0f} mm,", *seen]
        length = _measure_words(drawing.value_of("bottom_length"))
        return ["the feather edge,", *seen, *(part for text in length for part in text.split(": "))]
    if view.name == "plan":
        return [f"the {stands} last," if kind == "last" else "below the ankle,", *seen]
    if view.name == "side":
        lines = [f"the {stands} {kind},", "the straight line is the ground"]
        named = (drawing.value_of(name) for name in ("heel_height", "toe_spring_tip"))
        return [*lines, *(text for measure in named for text in _measure_words(measure))]
    lines = [f"{plain(view.at_mm or 0.0)} mm from the heel", f"seen from the heel, medial {medial}"]
    return [*lines, *_measure_words(drawing.value_of(IN_SECTION.get(view.name, "")))]


def _measure_words(measure: Measure | None) -> list[str]:
    if measure is None or measure.measured.value is None:
        return []
    spread = "" if measure.measured.sd is None else f" ± {plain(measure.measured.sd)}"
    name = measure_words(measure.name, "last")
    return [f"{name}: {plain(measure.measured.value)}{spread} {measure.unit}"]


def _marks(drawing: Drawing, view: View) -> Block:
    """The places of the sections; on the side view also the ground, the heel and the toe."""
    if view.name == "side":
        return joined(
            [_ground(drawing, *view.bounds_mm), *(_standing_mark(mark) for mark in view.marks)]
        )
    return joined(map(_lying_mark, view.marks))


def _lying_mark(mark: Mark) -> Block:
    """A mark across a view whose toe is up: its name stands on it."""
    points = mark.points_mm[np.argsort(mark.points_mm[:, 0])]
    line = Line(points, name=f"mark {mark.name}", dashed=True)
    x, y = points.mean(axis=0)
    return Block((line,), (Words(mark.name, (float(x), float(y) + 1.0), SMALL_MM, "middle"),))


def _standing_mark(mark: Mark) -> Block:
    """A mark up a side view: its name stands below the ground."""
    points = mark.points_mm[np.argsort(mark.points_mm[:, 1])]
    line = Line(points, name=f"mark {mark.name}", dashed=True)
    place = (float(points[0, 0]), -BESIDE_MM - 0.8 * SMALL_MM)
    return Block((line,), (Words(mark.name, place, SMALL_MM, "middle"),))


def _ground(drawing: Drawing, low: Floats, high: Floats) -> Block:
    """The ground, and how high the heel and the tip of a last stand over it."""
    rear, front = float(low[0]), float(high[0])
    lines = [straight((rear - END_MM, 0.0), (front + END_MM, 0.0), "ground")]
    for name, x in (("heel_height", rear - HEIGHT_MM), ("toe_spring_tip", front + HEIGHT_MM)):
        measure = drawing.value_of(name)
        if measure is not None and measure.measured.value is not None:
            height = measure.measured.value
            lines += [
                straight((x, 0.0), (x, height), name),
                straight((x - TICK_MM, height), (x + TICK_MM, height)),
            ]
    return Block(tuple(lines))
