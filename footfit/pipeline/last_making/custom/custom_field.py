"""The field that makes a custom last of its base: its knobs, its limits, and room for one place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from footfit.errors import BadOption, OutOfReach
from footfit.geometry.deform.chart import Chart, chart_of, eased
from footfit.geometry.deform.field import Bump, Field, least_determinant
from footfit.geometry.deform.solver import Goal, Knob, Solution, solution
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.numeric.arrays import Floats
from footfit.number_words import plain
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import (
    BALL_LENGTH,
    FOLLOWING,
    LENGTH,
    CustomAim,
)
from footfit.pipeline.last_making.custom.custom_reading import (
    Carried,
    probe_of,
    value_mm,
    values_mm,
)
from footfit.results import CustomZone, Notice


@dataclass(frozen=True, slots=True)
class CustomSettings:
    """What may change along the arc, and how far; places over the arc's length.

    Attributes
    ----------
    free : tuple of float
        Widths and heights have knobs between these; in front of them the toe keeps its shape.
    shank, bend : tuple of float
        The length, and the flare, change between these.
    forepart, forepart_mm : tuple of float, float
        Between these the length changes only to bring the ball in line with the foot's; so much of
        it costs as much as a firm miss of .01 mm.
    ball, slope : tuple of float, float
        The joints lie between these. There a step of the widths' scale from knot to knot costs as
        much as this.
    pulled_mm, line_mm, following_mm : float
        The miss of a pulled girth, of the ball line, and of the heel's girth, that costs as much as
        a firm one's of .01 mm.
    met_mm : float
        A firm aim that is missed by more cannot be reached.
    wider, higher : float
        A scale of widths, or of heights over the bottom, changes by at most this factor.
    longer, girth : float
        The last becomes longer or shorter by at most this share of the arc, and a girth or a width
        by at most this share of itself.
    determinant : float
        The least that the change may come to: 0 would be a fold.
    flare_deg : float
        The most that the flare is turned.
    room_mm, room_radius : float, float
        The most room that is given to one place, and how far it reaches, over the arc.
    """

    free: tuple[float, float] = (0.1, 0.82)
    shank: tuple[float, float] = (0.20, 0.54)
    bend: tuple[float, float] = (0.28, 0.54)
    forepart: tuple[float, float] = (0.66, 0.82)
    forepart_mm: float = 2.0
    ball: tuple[float, float] = (0.55, 0.77)
    slope: float = 0.003
    pulled_mm: float = 2.0
    line_mm: float = 0.4
    following_mm: float = 8.0
    met_mm: float = 0.3
    wider: float = 1.25
    higher: float = 1.4
    longer: float = 0.08
    girth: float = 0.15
    determinant: float = 0.3
    flare_deg: float = 6.0
    room_mm: float = 12.0
    room_radius: float = 0.10


CUSTOM = CustomSettings()
FREE_MM = 100.0
"""The unit of a knob in mm whose size costs nothing."""
MEDIAL, LATERAL, UP = AXES[1], -AXES[1], AXES[2]
ROOM_PLACES: dict[str, tuple[float, Floats]] = {
    "ball-medial": (0.70, MEDIAL),
    "ball-lateral": (0.63, LATERAL),
    "ball-top": (0.68, UP),
    "toe-top": (0.86, UP),
    "toe-medial": (0.86, MEDIAL),
    "toe-lateral": (0.80, LATERAL),
    "instep-top": (0.52, UP),
    "waist-medial": (0.42, MEDIAL),
    "waist-lateral": (0.45, LATERAL),
    "heel-medial": (0.12, MEDIAL),
    "heel-lateral": (0.12, LATERAL),
}
"""Where room can be given: about where along the arc, and towards which side."""


def room_bumps(base: Shape, chart: Chart, rooms_mm: Mapping[str, float]) -> tuple[Bump, ...]:
    """The swellings of the places that are given room.

    Raises
    ------
    BadOption
        There is no such place, or the room is too large.
    """
    bumps = []
    standing = chart.standing(base.vertices_mm)
    along, over = chart.arc.shares(base.vertices_mm)
    for name, size_mm in rooms_mm.items():
        if name not in ROOM_PLACES:
            raise BadOption(f"no place is named {name!r}; --room takes {', '.join(ROOM_PLACES)}")
        if not 0.0 < size_mm <= CUSTOM.room_mm:
            raise BadOption(f"--room {name} takes up to {CUSTOM.room_mm:g} mm, not {size_mm:g}")
        share, outward = ROOM_PLACES[name]
        near = np.flatnonzero((np.abs(along - share) < 0.04) & ((over < 0.16) | (outward[2] > 0)))
        centre = standing[near[np.argmax(standing[near] @ outward)]]
        bumps.append(Bump(centre, outward, CUSTOM.room_radius * chart.arc.length_mm, size_mm))
    return tuple(bumps)


@dataclass(frozen=True)
class CustomShape:
    """A base as a field has changed it: vertices (n, 3) of the right shape in the base's frame.

    ``solved`` is without the room for single places; ``least_determinant`` is with it.
    """

    solved: Solution
    vertices_mm: Floats
    least_determinant: float


def custom_shape(
    base: BaseLast,
    aims: Sequence[CustomAim],
    start: Field,
    shifts_mm: Floats,
) -> CustomShape:
    """The base, changed so that its firm aims are met.

    Parameters
    ----------
    base : BaseLast
    aims : sequence of CustomAim
    start : Field
        The turn of the flare.
    shifts_mm : (aims,)
        What is added to the targets, because the finished last reads otherwise.

    Raises
    ------
    OutOfReach
        A target lies beyond the limits of stretch, or the last would fold.
    """
    chart, shape = start.chart, base.shape
    _refuse_far(aims, chart)
    lengthen = _pattern(chart, CUSTOM.shank)
    at = chart.centres()
    inner = np.flatnonzero((at > CUSTOM.free[0]) & (at < CUSTOM.free[1]))
    knobs = [Knob(name, np.eye(len(at))[k]) for name in ("wider", "higher") for k in inner]
    knobs.append(Knob("ahead", lengthen, FREE_MM))
    knobs.append(Knob("ahead", _pattern(chart, CUSTOM.forepart), FREE_MM))
    carried = Carried(shape)
    read = partial(values_mm, carried=carried, aims=aims, base=base)
    turned = carried.shape(start.moved_points(shape.vertices_mm))
    goals = [
        _goal(aim, turned, value_mm(shape, aim.measure, base), shift)
        for aim, shift in zip(aims, shifts_mm.tolist(), strict=True)
    ]
    solved = solution(start, knobs, shape.vertices_mm, goals, read, _costs(chart, knobs))
    _refuse_missed(aims, np.array([goal.target_mm for goal in goals]), solved.values_mm)
    _refuse_stretched(aims, solved.field)
    return CustomShape(solved, solved.vertices_mm, _volume_left(base, aims, solved.field))


def with_room(
    base: BaseLast, aims: Sequence[CustomAim], shape: CustomShape, bumps: Sequence[Bump]
) -> CustomShape:
    """A changed base, with room for single places on top.

    Raises
    ------
    OutOfReach
        The last would fold.
    """
    field = replace(shape.solved.field, bumps=tuple(bumps))
    moved = field.moved_points(base.shape.vertices_mm)
    return CustomShape(shape.solved, moved, _volume_left(base, aims, field))


def _volume_left(base: BaseLast, aims: Sequence[CustomAim], field: Field) -> float:
    """The least determinant of a field; OutOfReach if it comes too near to a fold."""
    least = least_determinant(field, base.shape.vertices_mm)
    if least < CUSTOM.determinant:
        words = (
            f"the surface would come too near to a fold ({plain(least, 2)} of its volume is left)"
        )
        raise OutOfReach(f"{_worst_words(aims)}: {words}")
    return least


def first_field(base: BaseLast, turn_deg: float, *, bottom_kept: bool) -> Field:
    """The field that a search begins with: the turn of the flare.

    Raises
    ------
    OutOfReach
        The base's bottom is open, so nothing is known of how it stands.
    """
    if base.shape.bottom_arc is None:
        raise OutOfReach("the base's bottom is open at the heel or the ball: take another base")
    chart = chart_of(base.shape)
    still = Field.still(chart, bottom_kept=bottom_kept)
    turned = np.radians(turn_deg) * _pattern(chart, CUSTOM.bend)
    return replace(still, turned=turned)


def _pattern(chart: Chart, window: tuple[float, float]) -> Floats:
    """Coefficients that rise from 0 to 1 along a window of the arc."""
    start, end = window
    return eased((chart.centres() - start) / (end - start))


def _goal(aim: CustomAim, start: Shape, own_mm: float, shift_mm: float) -> Goal:
    """What the solver brings an aim to; a length goes by the toe room.

    ``start`` is the shape that the search begins with, ``own_mm`` the measure of the base.
    """
    target_mm = aim.target - aim.base + own_mm + shift_mm
    probe = probe_of(start, aim.measure)
    if aim.firm:
        return Goal(target_mm, probe)
    miss_mm = CUSTOM.following_mm if aim.measure in FOLLOWING else CUSTOM.pulled_mm
    miss_mm = CUSTOM.line_mm if aim.measure == BALL_LENGTH else miss_mm
    return Goal(target_mm, probe, miss_mm, firm=False)


def _costs(chart: Chart, knobs: Sequence[Knob]) -> Floats:
    """The costs (k, knobs) of a width that changes along the ball, where it would move the joints,
    and of the last knob: the forepart's length.
    """
    at = chart.centres()
    pairs = np.flatnonzero((at[:-1] > CUSTOM.ball[0]) & (at[1:] < CUSTOM.ball[1]))
    widths = np.array([knob.pattern * (knob.curve == "wider") for knob in knobs])
    slopes = (widths[:, pairs + 1] - widths[:, pairs]).T / CUSTOM.slope
    forepart = np.zeros(len(knobs))
    forepart[-1] = 1.0 / CUSTOM.forepart_mm
    return np.vstack([slopes, forepart])


def _refuse_far(aims: Sequence[CustomAim], chart: Chart) -> None:
    """Raise OutOfReach for a measure that is too far from the base's; a length comes first."""
    for aim in aims:
        of_length = aim.measure == LENGTH
        most_mm = CUSTOM.longer * chart.arc.length_mm if of_length else CUSTOM.girth * aim.base
        if aim.firm and abs(aim.target - aim.base) > most_mm:
            change = f"{plain(aim.base)} mm to {plain(aim.target)} mm"
            words = f"from {change} is more than {plain(most_mm)} mm"
            raise OutOfReach(f"the {aim.words} is out of reach of this base: {words}")


def _refuse_missed(aims: Sequence[CustomAim], asked_mm: Floats, values_mm: Floats) -> None:
    """Raise OutOfReach for the firm aim that is missed most, if one is; both are (aims,)."""
    firm = np.array([aim.firm for aim in aims])
    miss = np.where(firm, np.abs(asked_mm - values_mm), 0.0)
    worst = int(np.argmax(miss))
    if miss[worst] <= CUSTOM.met_mm:
        return
    words = (
        f"it comes to {plain(float(values_mm[worst]))} mm, not {plain(float(asked_mm[worst]))} mm"
    )
    raise OutOfReach(f"the {aims[worst].words} is out of reach of this base: {words}")


def missed(zones: Sequence[CustomZone]) -> tuple[Notice, ...]:
    """A warning for each target that the finished last, which is read again, misses."""
    return tuple(
        Notice(
            "target_missed",
            f"the {zone.name.replace('_', ' ')} comes to {plain(zone.reached)} mm, not"
            f" {plain(zone.target)} mm: choose a lower --flare-follow, or another base",
        )
        for zone in zones
        if abs(zone.reached - zone.target) > CUSTOM.met_mm
    )


def _refuse_stretched(aims: Sequence[CustomAim], field: Field) -> None:
    """Raise OutOfReach for a change beyond the stated limits of stretch."""
    scales = {"widths": (field.wider, CUSTOM.wider), "heights": (field.higher, CUSTOM.higher)}
    for name, (curve, most) in scales.items():
        if np.abs(curve).max() > np.log(most):
            words = f"its {name} would have to change by more than {100 * (most - 1):.0f} %"
            raise OutOfReach(f"{_worst_words(aims)}: {words}")


def _worst_words(aims: Sequence[CustomAim]) -> str:
    """The aim that is farthest from the base, and that it is out of reach."""
    girths = [aim for aim in aims if aim.measure != LENGTH and aim.firm] or list(aims)
    worst = max(girths, key=lambda aim: abs(aim.target - aim.base))
    change = f"{plain(worst.base)} to {plain(worst.target)} mm"
    return f"the {worst.words} is out of reach of this base ({change})"
