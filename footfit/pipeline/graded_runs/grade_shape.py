"""One step of grading: a last with a longer bottom, and then with other girths and widths."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.errors import OutOfReach
from footfit.geometry.deform.chart import CHART, Chart, chart_of
from footfit.geometry.deform.field import Field, least_determinant
from footfit.geometry.deform.probes import DIRECTIONS
from footfit.geometry.deform.solver import Knob, solution, turned_field
from footfit.geometry.deform.wishes import SOLVER, Goal
from footfit.geometry.grading.length_flow import (
    LENGTHENING,
    ahead_mm,
    ends_raised_mm,
    flowed_mm,
    lengthened_mm,
    raised_mm,
    sideways_mm,
)
from footfit.geometry.grading.steady_lines import (
    cone_top,
    cone_top_mm,
    middle_mm,
    with_top_held,
)
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.least_tape import RoughGirths
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.stance.cues import StanceLabels
from footfit.number_words import plain
from footfit.pipeline.last_making.custom.custom_reading import TAPES, tape_plane


@dataclass(frozen=True, slots=True)
class GradeSettings:
    """How a last is graded; places over the arc's length.

    Attributes
    ----------
    widths : tuple of float
        At the heel and at the ball the scale of widths has knobs; beyond them it stays as there.
    heights : tuple of float
        At the ball and the toe the scale of heights has knobs.
    instep, waist : float, float
        There it has one too, if their girths are planned. Behind the instep, the cone rises as the
        instep does.
    low : float
        Where the line of the cone's top lies lower, over its height at the instep, that is taken.
    edge, height : float
        What lies lower over the bottom keeps its height over it; heights come to their full change
        over a share of the other, as in `ChartSettings`.
    small_rise_mm : float
        If the cone rises by less, its height half-way makes no difference.
    settled_mm, rounds : float, int
        The search ends when no measure is farther from its target.
    free_bend, free_size : float, float
        What curves cost, as in `SolverSettings`: next to nothing, because there is a knob for each
        target, and grading back must find the same ones.
    met_mm : float
        A target that is missed by more cannot be reached.
    determinant : float
        The least that a change may come to: 0 would be a fold.
    """

    widths: tuple[float, float] = (0.17, 0.67)
    heights: tuple[float, float] = (0.67, 0.92)
    instep: float = 0.50
    waist: float = 0.585
    low: float = 0.4
    edge: float = 0.03
    height: float = 0.26
    small_rise_mm: float = 1.0
    settled_mm: float = 0.0005
    rounds: int = 12
    free_bend: float = 1.0
    free_size: float = 10.0
    met_mm: float = 0.05
    determinant: float = 0.3


GRADE = GradeSettings()
GRADE_SOLVER = replace(
    SOLVER,
    settled_mm=GRADE.settled_mm,
    near_mm=GRADE.settled_mm,
    rounds=GRADE.rounds,
    bend=GRADE.free_bend,
    size=GRADE.free_size,
    heights=1.0,
)
GRADE_CHART = replace(CHART, knots=43, gentle=False)
"""With so many knots that the curves meet what a length does in the shank of a high heel."""
LENGTH, HEEL_GIRTH = "bottom_length", "heel_girth_instep"
INSTEP, WAIST = "instep_girth_least", "waist_girth_least"
AT_JOINTS = ("ball_girth_least", WAIST)
"""The girths that need the joints of the ball."""
HELD = ("heel", "spring", "bottom", "toe", "top")
"""What can be held, each by itself."""
HELD_BY_DEFAULT = ("heel", "spring", "toe")
THICKNESS = "toe_height"


@dataclass(frozen=True, slots=True)
class GradeStep:
    """What one step changes: the ratio of the lengths, and the targets of measures in mm.

    ``held`` are some of `HELD`. ``labels`` say how the last stands afterwards. The heel and the tip
    are raised by ``more_mm``, because the finished last reads otherwise.
    """

    ratio: float
    targets_mm: Mapping[str, float]
    held: frozenset[str]
    labels: StanceLabels
    more_mm: tuple[float, float] = (0.0, 0.0)


def graded(shape: Shape, step: GradeStep) -> Shape:
    """A canonical right last after one step, in the frame of the last before it.

    Girths and widths are changed where the last is longer: after it was lengthened, or before it is
    shortened. So a step back is the same step.

    Raises
    ------
    OutOfReach
        Its bottom is open, a top that is held is not flat, a target cannot be reached, or the
        surface would come near to a fold.
    """
    if shape.bottom_arc is None:
        raise OutOfReach("its bottom is open at the heel or the ball: grade a whole last")
    grows = step.ratio >= 1.0
    first = _lengthened(shape, step) if grows else shape
    chart = _chart(first, step)
    top = _cone_mm(chart, first)
    names = list(step.targets_mm)

    def finished(vertices_mm: Floats) -> Shape:
        moved = Shape(vertices_mm, shape.faces, "last", first.labels)
        return moved if grows else _lengthened(moved, step)

    def read(vertices_mm: Floats) -> Floats:
        if still_mm is not None and np.array_equal(vertices_mm, first.vertices_mm):
            return still_mm
        last = finished(vertices_mm)
        return np.array([graded_mm(last, name) for name in names])

    still_mm: Floats | None = None
    still_mm = read(first.vertices_mm)
    start, rise_mm = replace(Field.still(chart), even=True), 0.0
    effect: Floats | None = None
    for _ in range(2):  # the second time at the height that the cone has half-way
        knobs = _knobs(chart, top + 0.5 * rise_mm, step)
        if effect is None:
            effect = _effect(start, knobs, first.vertices_mm, read)
        goals = [Goal(step.targets_mm[name], row) for name, row in zip(names, effect, strict=True)]
        solved = solution(start, knobs, first.vertices_mm, goals, read, settings=GRADE_SOLVER)
        effect = effect if solved.effect is None else solved.effect
        rise_mm = _rise_mm(solved.field, top + 0.5 * rise_mm)
        if abs(rise_mm) < GRADE.small_rise_mm:
            break
    refuse_missed(step, solved.values_mm)
    least = least_determinant(solved.field, first.vertices_mm)
    if least < GRADE.determinant:
        words = f"only {plain(least, 2)} of its volume would be left somewhere"
        fewer = "widths" if step.ratio == 1.0 else "sizes"
        raise OutOfReach(f"the surface would come too near to a fold ({words}): take fewer {fewer}")
    return finished(solved.vertices_mm)


def _effect(
    start: Field, knobs: Sequence[Knob], vertices_mm: Floats, read: Callable[[Floats], Floats]
) -> Floats:
    """How each measure changes with each knob of a field, (measures, knobs), as it is read.

    A probe keeps the places of a measure. Under a high heel the ends of the bottom's arc move on
    the surface, and a probe took a scale of heights for a change of length.
    """
    before = read(vertices_mm)
    columns = []
    for knob in knobs:
        by = GRADE_SOLVER.step * knob.unit
        moved = turned_field(start, [knob], np.array([by])).moved_points(vertices_mm, None)
        columns.append((read(moved) - before) / by)
    return np.nan_to_num(np.stack(columns, axis=1))


def refuse_missed(step: GradeStep, values_mm: Floats) -> None:
    """Refuse a step that misses a target by more than `GradeSettings.met_mm`.

    ``values_mm`` (n,) are what its measures came to, in the order of its targets.

    Raises
    ------
    OutOfReach
        The message names the target that is missed most, by how much, and what to ask for.
    """
    targets_mm = step.targets_mm
    miss = np.array(list(targets_mm.values())) - values_mm
    miss = np.where(np.isfinite(miss), miss, np.inf)  # a measure that is gone
    worst = int(np.argmax(np.abs(miss)))
    if abs(miss[worst]) <= GRADE.met_mm:
        return
    name, target = list(targets_mm.items())[worst]
    words = f"the {name.replace('_', ' ')} should come to {plain(target, 2)} mm"
    if np.isfinite(miss[worst]):
        how = "small" if miss[worst] > 0.0 else "large"
        words += f" and stays {plain(abs(miss[worst]), 2)} mm too {how}"
    else:
        words += " and can no longer be measured"
    fewer = "widths" if step.ratio == 1.0 else "sizes"
    hint = f"take fewer {fewer}, or another rule"
    raise OutOfReach(f"{words}: {'do not hold the top' if 'top' in step.held else hint}")


def _lengthened(shape: Shape, step: GradeStep) -> Shape:
    """A last with a longer bottom; what is held keeps its height over the ground.

    The plan keeps its headings, so the last keeps its flare. Seat and tread of a held bottom go
    straight ahead: that keeps the flare within 0.1 degrees, and leads back better.
    """
    chart = _chart(shape, step)
    arc_mm = chart.stations * chart.arc.length_mm
    x, z = chart.arc.line.at(arc_mm)
    bottom = "bottom" in step.held
    held = bottom or "heel" in step.held, bottom or "spring" in step.held
    raised = raised_mm(x, z, step.ratio, held) + ends_raised_mm(x, z, step.more_mm)
    length_mm = step.ratio * chart.arc.length_mm
    ahead = ahead_mm(x, z + raised, length_mm, shank_only=bottom)
    least = 1.0 + min(float((np.diff(curve) / np.diff(x)).min()) for curve in ahead)
    if least < GRADE.determinant:
        words = "its shank is too steep to become so much shorter"
        raise OutOfReach(f"{words}: take fewer sizes, or hold neither bottom nor heel")
    aside = sideways_mm(x, chart.middle_mm, np.zeros_like(x) if bottom else ahead[0])
    longer_mm = lengthened_mm(chart, shape.vertices_mm, ahead, aside, raised)
    return Shape(longer_mm, shape.faces, "last", step.labels)


def _chart(shape: Shape, step: GradeStep) -> Chart:
    """The chart of a last, with one edge and one height: a step back must find them again.

    The middle of its plan, and a top that is held, are read from sections for the same reason.
    """
    chart = chart_of(shape, hold_top=False, settings=GRADE_CHART)
    edge_mm, height_mm = (
        np.full(len(chart.stations), share * chart.arc.length_mm)
        for share in (GRADE.edge, GRADE.height)
    )
    middle = middle_mm(chart, shape)
    chart = replace(chart, middle_mm=middle, edge_mm=edge_mm, height_mm=height_mm)
    if "top" not in step.held:
        return chart
    top = cone_top(chart, shape)
    if top is None:
        raise OutOfReach("the top of its cone is not flat, so it cannot be held: hold other parts")
    return with_top_held(chart, shape, top)


def _curve(chart: Chart, values: Floats) -> Floats:
    """The coefficients (knots,) of the splines that come nearest to values at the stations."""
    if not values.any():
        return np.zeros(chart.settings.knots)
    return np.asarray(np.linalg.lstsq(chart.splines(chart.stations), values, rcond=None)[0])


def _knobs(chart: Chart, cone_mm: Floats, step: GradeStep) -> list[Knob]:
    """What the search may turn: the scales of widths and of heights, and the length a little."""
    places = {GRADE.instep: INSTEP, GRADE.waist: WAIST}
    planned = [at for at, name in places.items() if name in step.targets_mm]
    wide, high = _tents(chart, GRADE.widths), _tents(chart, [*planned, *GRADE.heights])
    high[0] = high[0] * _level_rise(chart, cone_mm)
    if HEEL_GIRTH in step.targets_mm:
        high = [*high, np.maximum(1.0 - chart.stations / GRADE.instep, 0.0)]
    arc_mm = chart.stations * chart.arc.length_mm
    x = chart.arc.line.at(arc_mm)[0]
    ahead = flowed_mm(x, 1.0, LENGTHENING.shank if "bottom" in step.held else None) - x
    return [
        *(Knob("wider", _curve(chart, tent)) for tent in wide),
        *(Knob("higher", _curve(chart, tent)) for tent in high),
        Knob("ahead", _curve(chart, ahead), 100.0),
    ]


def _cone_mm(chart: Chart, shape: Shape) -> Floats:
    """How high the cone's top lies over the bottom at the stations, but not less than a part."""
    top = cone_top(chart, shape)
    height_mm = chart.height_mm if top is None else cone_top_mm(chart, top)
    instep_mm = float(np.interp(GRADE.instep, chart.stations, height_mm))
    return np.maximum(height_mm, GRADE.low * instep_mm)


def _level_rise(chart: Chart, cone_mm: Floats) -> Floats:
    """What the scale of heights behind the instep is times that at the instep, at the stations.

    The plane of the cone's top rises by the same everywhere, so that it stays a plane.
    """
    behind = np.interp(GRADE.instep, chart.stations, cone_mm) / cone_mm
    return np.where(chart.stations < GRADE.instep, behind, 1.0)


def _rise_mm(field: Field, cone_mm: Floats) -> float:
    """By how much a field raises the plane of the cone's top; a top that is held stays."""
    chart = field.chart
    if chart.top is not None:
        return 0.0
    scale = chart.splines(np.array([GRADE.widths[0]])) @ field.higher
    return float(scale[0] * np.interp(GRADE.widths[0], chart.stations, cone_mm))


def _tents(chart: Chart, at: Sequence[float]) -> list[Floats]:
    """For each of some shares of the arc what is 1 there, 0 at the others, and straight between."""
    return [np.interp(chart.stations, at, row) for row in np.eye(len(at))]


def graded_mm(shape: Shape, name: str) -> float:
    """What grading brings to a target: a measure of a last in its frame; NaN if it has none.

    A girth is that of its plane's own section. What `measure` takes for noise there changes by
    0.1 mm from one smooth last to the next.
    """
    if name in TAPES:
        if name in AT_JOINTS and shape.joints is None:
            return np.nan
        plane = tape_plane(shape, name)
        assert plane is not None
        girths = RoughGirths(shape, plane.origin, DIRECTIONS, plane.reach_mm)
        return girths.at(plane.axes)
    value = measure_named(name).value_of(shape).value
    return np.nan if value is None else value
