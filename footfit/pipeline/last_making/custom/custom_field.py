"""The field that makes a custom last of its base: its knobs and its limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from footfit.errors import OutOfReach
from footfit.geometry.deform.chart import Chart, eased
from footfit.geometry.deform.field import Field, least_determinant
from footfit.geometry.deform.probes import Probe
from footfit.geometry.deform.solver import (
    Knob,
    Solution,
    solution,
    turned_field,
)
from footfit.geometry.deform.wishes import SOLVER, Goal
from footfit.geometry.numeric.arrays import Floats
from footfit.number_words import plain
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import (
    ANYWHERE,
    BALL_LENGTH,
    FOLLOWING,
    GIVES_WAY,
    HEEL_GIRTH,
    LENGTH,
    CustomAim,
)
from footfit.pipeline.last_making.custom.custom_reading import (
    Carried,
    asked_mm,
)


@dataclass(frozen=True, slots=True)
class CustomSettings:
    """What may change along the arc, and how far; places over the arc's length.

    Attributes
    ----------
    free : tuple of float
        Widths and heights have knobs between these; in front of them the toe keeps its shape.
    back : float
        Heights have none behind this: the back curve would move.
    shank, bend : tuple of float
        The length, and the flare, change between these.
    forepart, forepart_mm : tuple of float, float
        Between these the length changes only to bring the ball in line with the foot's; so much of
        it costs as much as a firm miss of .01 mm.
    ball, slope : tuple of float, float
        The joints lie between these. There a step of the widths' scale from knot to knot costs as
        much as this.
    pulled_mm, line_mm : float
        The miss of a pulled girth, and of the ball line, that costs as much as a firm one's of .01
        mm.
    met_mm, length_met_mm : float
        A girth or a width, and the length, that is missed by more cannot be reached.
    wider, higher : float
        A scale of widths, or of heights over the bottom, changes by at most this factor.
    longer, girth : float
        The last becomes longer or shorter by at most this share of the arc, and a girth or a width
        by at most this share of itself.
    edge_mm, heel_edge_mm : float
        To be so far out of the good range of a zone, and of the heel's, costs as much as a firm
        miss of .01 mm.
    determinant : float
        The least that the change may come to: 0 would be a fold.
    flare_deg : float
        The most that the flare is turned.
    """

    free: tuple[float, float] = (0.05, 0.82)
    back: float = 0.10
    shank: tuple[float, float] = (0.08, 0.60)
    bend: tuple[float, float] = (0.28, 0.54)
    forepart: tuple[float, float] = (0.66, 0.82)
    forepart_mm: float = 2.0
    ball: tuple[float, float] = (0.55, 0.77)
    slope: float = 0.012
    pulled_mm: float = 1.0
    line_mm: float = 0.1
    edge_mm: float = 0.05
    heel_edge_mm: float = 0.03
    met_mm: float = 0.5
    length_met_mm: float = 0.3
    wider: float = 1.25
    higher: float = 1.4
    longer: float = 0.08
    girth: float = 0.15
    determinant: float = 0.3
    flare_deg: float = 6.0


CUSTOM = CustomSettings()
COLD = replace(SOLVER, failing=3, shorter=0.3, ahead_mm=2.0, settled_mm=0.2)
"""A search that begins at the base."""
WARM = replace(COLD, shaping=3, rounds=8, settled_mm=0.1)
"""A search that begins where another one ended."""
FOLLOWED = replace(COLD, shaping=0, rounds=6, settled_mm=0.05)
"""A search that begins where one on a light copy ended: only firm aims are still missed."""
ENOUGH = 3000
"""The determinant and the scales are smooth, so they are taken at about so many vertices."""
FREE_MM = 100.0
"""The unit of a knob in mm whose size costs nothing."""


@dataclass(frozen=True, slots=True)
class Manner:
    """How a search goes about it.

    Attributes
    ----------
    heights : float
        What a scale of heights costs, over a scale of widths.
    softer : float
        By how much cheaper it is to leave a zone's good range.
    heel : bool
        Whether the short heel girth is kept good.
    zones : bool
        Whether zones are kept good, beside the targets.
    """

    heights: float = SOLVER.heights
    softer: float = 1.0
    heel: bool = True
    zones: bool = True

    @property
    def usual(self) -> bool:
        """Whether it is the usual one, though perhaps without the heel's zone."""
        return replace(self, heel=True) == MANNER


MANNER = Manner()


@dataclass(frozen=True)
class CustomShape:
    """A base as a field has changed it: vertices (n, 3) of the right shape in the base's frame.

    ``aims`` are those that it was made for; targets of least tapes may have moved. ``solved`` is
    without the room for single places; ``least_determinant`` is with it. ``scales`` are the largest
    factors by which widths and heights change, up or down.
    """

    aims: tuple[CustomAim, ...]
    solved: Solution
    vertices_mm: Floats
    least_determinant: float
    scales: tuple[float, float]


def custom_shape(
    base: BaseLast,
    aims: Sequence[CustomAim],
    start: Field,
    carried: Carried,
    first: Solution | None = None,
    manner: Manner = MANNER,
) -> CustomShape:
    """The base, changed so that its firm aims are met as ``carried`` reads them, or nearly so.

    Parameters
    ----------
    base : BaseLast
    aims : sequence of CustomAim
    start : Field
        The turn of the flare.
    carried : Carried
        How the changed base lies and stands.
    first : Solution
        Where the search begins, perhaps that of a lighter copy; by default at ``start``.
    manner : Manner
    """
    own = [aim for aim in aims if aim.measure not in FOLLOWING]
    solved = None
    if first and first.met and first.effect is not None:  # what the knobs do is known already
        solved = _solution(base, own, start, carried, first, manner, first.effect)
    if solved is None or not solved.met:
        solved = _solution(base, own, start, carried, solved or first, manner)
    some = base.shape.vertices_mm[:: max(1, len(base.shape.vertices_mm) // ENOUGH)]
    least = least_determinant(solved.field, some)
    wider, higher = solved.field.scales(some)
    asked_for = zip(own, solved.targets_mm.tolist(), strict=True)
    targets_mm = {aim.measure: mm for aim, mm in asked_for if aim.measure in GIVES_WAY}
    met = tuple(aim.moved_to(targets_mm.get(aim.measure, aim.target)) for aim in aims)
    scales = _largest(wider), _largest(higher)
    return CustomShape(met, solved, solved.vertices_mm, least, scales)


def _solution(
    base: BaseLast,
    aims: Sequence[CustomAim],
    start: Field,
    carried: Carried,
    first: Solution | None,
    manner: Manner,
    effect: Floats | None = None,
) -> Solution:
    """One search; without ``effect`` (aims, knobs) probes say what the knobs do."""
    settings = COLD if first is None else WARM
    if effect is not None:
        settings = replace(settings, failing=1)
    if first is not None and len(first.vertices_mm) != len(base.shape.vertices_mm):
        settings = FOLLOWED
    knobs = _knobs(start.chart, aims) if first is None else first.knobs
    if effect is None:
        turned = turned_field(start, knobs, np.array([knob.value for knob in knobs]))
        probes = carried.probes(turned.moved_points(base.shape.vertices_mm), aims)
    length_mm = carried.base_length_mm
    goals = [
        _goal(aim, probe, asked_mm(aim, length_mm))
        for aim, probe in zip(aims, probes if effect is None else effect, strict=True)
    ]
    return solution(
        start,
        knobs,
        base.shape.vertices_mm,
        _ranged(goals, aims, manner),
        partial(carried.values_mm, aims=aims),
        _costs(start.chart, knobs),
        replace(settings, heights=manner.heights),
    )


def _largest(factors: Floats) -> float:
    """The largest of factors (n,), where those below 1 count by their inverse."""
    return float(np.maximum(factors, 1.0 / factors).max())


def _knobs(chart: Chart, aims: Sequence[CustomAim]) -> list[Knob]:
    """What the search may turn: scales along the arc, and the length of shank and forepart."""
    at = chart.centres()
    inner = np.flatnonzero((at > CUSTOM.free[0]) & (at < CUSTOM.free[1]))
    knobs = [Knob("wider", np.eye(len(at))[k]) for k in inner]
    knobs += [Knob("higher", np.eye(len(at))[k]) for k in inner if at[k] > CUSTOM.back]
    knobs.append(Knob("ahead", _pattern(chart, CUSTOM.shank), FREE_MM))
    if any(aim.measure == BALL_LENGTH for aim in aims):
        knobs.append(Knob("ahead", _pattern(chart, CUSTOM.forepart), FREE_MM))
    return knobs


def first_field(chart: Chart, turn_deg: float, *, bottom_kept: bool) -> Field:
    """The field that a search begins with: the turn of the flare."""
    still = Field.still(chart, bottom_kept=bottom_kept)
    return replace(still, turned=np.radians(turn_deg) * _pattern(chart, CUSTOM.bend))


def _pattern(chart: Chart, window: tuple[float, float]) -> Floats:
    """Coefficients that rise from 0 to 1 along a window of the arc."""
    start, end = window
    return eased((chart.centres() - start) / (end - start))


def _goal(aim: CustomAim, probe: Probe | Floats, target_mm: float) -> Goal:
    """What the solver brings an aim to."""
    if aim.firm:
        return Goal(target_mm, probe)
    miss_mm = CUSTOM.line_mm if aim.measure == BALL_LENGTH else CUSTOM.pulled_mm
    return Goal(target_mm, probe, miss_mm, firm=False)


def _ranged(goals: list[Goal], aims: Sequence[CustomAim], manner: Manner) -> list[Goal]:
    """The goals of aims, with the ranges in which zones are good."""
    if not manner.zones:
        return goals
    rows = {aim.measure: row for row, aim in enumerate(aims)}
    ranged = []
    for goal, aim in zip(goals, aims, strict=True):
        edge_mm = CUSTOM.heel_edge_mm if aim.measure == HEEL_GIRTH else CUSTOM.edge_mm
        gives_way_to = rows.get(GIVES_WAY.get(aim.measure, ""))
        edge_mm *= manner.softer
        range_mm = ANYWHERE if aim.measure == HEEL_GIRTH and not manner.heel else aim.good_mm
        ranged.append(replace(goal, range_mm=range_mm, edge_mm=edge_mm, gives_way_to=gives_way_to))
    return ranged


def _costs(chart: Chart, knobs: Sequence[Knob]) -> Floats:
    """The costs (k, knobs) of a width that changes along the ball, where it would move the joints,
    and of a change of length in the forepart.
    """
    at = chart.centres()
    pairs = np.flatnonzero((at[:-1] > CUSTOM.ball[0]) & (at[1:] < CUSTOM.ball[1]))
    widths = np.array([knob.pattern * (knob.curve == "wider") for knob in knobs])
    slopes = (widths[:, pairs + 1] - widths[:, pairs]).T / CUSTOM.slope
    aheads = np.array([knob.pattern * (knob.curve == "ahead") for knob in knobs])
    before = int(np.argmin(np.abs(at - CUSTOM.forepart[0])))
    forepart = (aheads[:, -1] - aheads[:, before]) / CUSTOM.forepart_mm
    return np.vstack([slopes, forepart])


def refuse_far(aims: Sequence[CustomAim], base: BaseLast) -> None:
    """Raise OutOfReach for a measure that is too far from the base's; a length comes first."""
    if base.shape.bottom_arc is None:
        raise OutOfReach("the base's bottom is open at the heel or the ball: take another base")
    for aim in aims:
        most_mm = most_change_mm(aim, base)
        if aim.firm and abs(aim.target - aim.base) > most_mm:
            change = f"{plain(abs(aim.target - aim.base))} mm"
            words = (
                f"it must go from {plain(aim.base)} to {plain(aim.target)} mm, by {change}, and at"
                f" most {plain(most_mm)} mm is possible"
            )
            raise OutOfReach(f"the {aim.words} is out of reach of this base: {words}")


def most_change_mm(aim: CustomAim, base: BaseLast) -> float:
    """By how much a measure of a base may change at most."""
    arc = base.shape.bottom_arc
    if aim.measure != LENGTH or arc is None:
        return CUSTOM.girth * aim.base
    return CUSTOM.longer * arc.length_mm


def refuse_missed(
    aims: Sequence[CustomAim], off_mm: Floats, shape: CustomShape, turn_deg: float
) -> None:
    """Raise OutOfReach if the finished last goes beyond a limit of stretch or misses a firm aim.

    ``off_mm`` (aims,) is how far the last reads from each target, ``turn_deg`` how far the flare
    was turned.
    """
    turned = f", with the flare turned by {plain(abs(turn_deg))} deg" if turn_deg else ""
    limit = limit_words(shape)
    if limit is not None:
        raise OutOfReach(f"{_worst_words(aims)}: {limit}{turned}")
    worst = missed(aims, off_mm)
    if worst is not None:
        aim, off = aims[worst], float(off_mm[worst])
        words = f"the nearest is {plain(aim.target + off)} mm, not {plain(aim.target)} mm{turned}"
        raise OutOfReach(f"the {aim.words} is out of reach of this base: {words}")


def missed(aims: Sequence[CustomAim], off_mm: Floats) -> int | None:
    """The row of the firm aim that is missed the most, by more than is allowed; or None."""
    most_mm = [CUSTOM.length_met_mm if aim.measure == LENGTH else CUSTOM.met_mm for aim in aims]
    over = np.abs(off_mm) / most_mm * [aim.firm for aim in aims]
    worst = int(np.argmax(over))
    return worst if over[worst] > 1.0 else None


def limit_words(shape: CustomShape) -> str | None:
    """Which limit of stretch a change goes beyond, in words; None if it keeps them all."""
    limits = zip(("widths", "heights"), shape.scales, (CUSTOM.wider, CUSTOM.higher), strict=True)
    for name, scale, most in limits:
        if scale > most:
            return f"its {name} would have to change by more than {100 * (most - 1):.0f} %"
    left = shape.least_determinant
    if left < CUSTOM.determinant:
        return f"the surface would come too near to a fold ({plain(left, 2)} of its volume is left)"
    return None


def _worst_words(aims: Sequence[CustomAim]) -> str:
    """The aim that is farthest from the base, and that it is out of reach."""
    girths = [aim for aim in aims if aim.measure != LENGTH and aim.firm] or list(aims)
    worst = max(girths, key=lambda aim: abs(aim.target - aim.base))
    change = f"{plain(worst.base)} to {plain(worst.target)} mm"
    return f"the {worst.words} is out of reach of this base ({change})"
