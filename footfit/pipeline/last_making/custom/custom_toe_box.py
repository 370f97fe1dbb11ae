"""How the toe box of a custom last becomes better: another toe room, wider walls, a higher top.

The toe in front of ``TOE_FROM`` keeps its shape. Behind it, up to the ball, the walls may move out
and the top may rise. What that gives is read once on the light copy; less of it gives less.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.catalogue.blocks.record_columns import TOES_SECTION
from footfit.geometry.deform.chart import Chart
from footfit.geometry.deform.field import Field
from footfit.geometry.deform.hump import Hump
from footfit.geometry.fit.named_sections import toes_outline_mm
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.fit.judging.judged_lasts import JudgedLasts, judged_lasts
from footfit.pipeline.fit.judging.toe_box import behind_share, toes_of_foot
from footfit.pipeline.fit.scoring import room_levels
from footfit.pipeline.fit.zones import TOE_BOX, TOE_HEIGHT, TOES
from footfit.pipeline.last_making.custom.custom_aims import (
    LENGTH,
    CustomAim,
    CustomQuestion,
    good_range,
    judged_in,
)
from footfit.pipeline.last_making.custom.custom_field import most_change_mm
from footfit.pipeline.last_making.custom.custom_tries import Attempt, Given
from footfit.results import Profiled, ToeBoxChange

TOE_FROM = 0.93
STEP_MM = 0.2
"""Toe rooms are tried so far apart."""
DOUBT_MM = {TOES: (0.2, 0.16), TOE_HEIGHT: (0.1, 0.0)}
"""A zone of the toe box may come out so far from what is foreseen: in mm, and for each mm of
another toe room."""
SURE = 0.9
"""So much of what humps should give is counted on."""
LACK = 2.0
"""What a zone still lacks counts so much more than a change."""
BACK = 0.70
PEAKS = {"outer": 0.80, "inner": 0.86, "higher": 0.85}
"""Over the bottom's arc: the walls and the top change in front of ``BACK``, and most at these
places; in front of ``TOE_FROM`` they do not."""
STEEP, STEEPEST = 0.4, 1.875
"""The slope of such a change along the last is at most so much. That of a quintic that rises from 0
to 1 over a length of 1 is the second number."""
CROWN = 0.825
"""The top of a section rises by so much of its height over the bottom times its change."""
NEAR_MM = np.array([-4.0, 0.0, 4.0])
"""What moves least so near along the wall counts: the nearest place of the wall becomes another
one."""
NEAR = 0.015
"""What lies so near to a place along the arc says how wide the last is there."""
SHARES = np.linspace(0.0, 1.0, 21)
HALVINGS = 4
"""If humps would bend the surface too far, less is tried: found by so many halvings."""
SPARE_DEG = 0.2
"""The surface must stay so much below its bar: another toe room bends it too."""
HELPS_MM = 0.5
"""A change of walls or top that changes no verdict must help by so much."""


@dataclass(frozen=True, slots=True)
class ToeBoxPlan:
    """What makes a toe box better: toe room that changes by ``room_mm``, and humps of the field."""

    room_mm: float
    humps: tuple[Hump, ...] = ()

    def aims(self, aims: Sequence[CustomAim]) -> list[CustomAim]:
        """The aims, the length first, with the other toe room."""
        length, *others = aims
        return [length.moved_to(length.target + self.room_mm) if self.room_mm else length, *others]


def toe_box_plans(
    foot: Profiled, given: Given, attempt: Attempt, question: CustomQuestion, before: JudgedLasts
) -> Iterator[ToeBoxPlan]:
    """What would make the toe box of a try better, the best first; none if nothing would.

    The least change counts that makes the toe box fit best. The last must stay a better match than
    its base, which is judged in ``before``.
    """
    made, length = attempt.made, attempt.aims[0]
    if length.measure != LENGTH or not attempt.manner.usual:  # it is hard enough to make
        return
    most_mm, longer_mm = most_change_mm(length, made.base), length.target - length.base
    last = judged_in(foot, made.record, made.with_sections, question)
    within_mm = -most_mm - longer_mm, most_mm - longer_mm
    choice = _choice(given, attempt, last, before, within_mm)
    if choice is None:
        return
    plans = choice.best(0.0), _most_humps(given, attempt, choice)
    for plan in plans[::-1]:
        if plan is not None:
            yield plan


def _most_humps(given: Given, attempt: Attempt, choice: _Choice) -> ToeBoxPlan | None:
    """The best plan with humps that does not bend the surface too far; None if none helps."""
    found, low, high = None, 0.0, 2.0
    for _ in range(HALVINGS + 1):
        less = 0.5 * (low + high)  # all of it at first
        plan = choice.best(less)
        if plan is None or not plan.humps:
            low = less
        elif (
            given.bent_more_deg(replace(attempt.shape.solved.field, humps=plan.humps)) > -SPARE_DEG
        ):
            high = less
        else:
            found, low = plan, less
        if low == 1.0:
            break
    return found


def toe_humps(given: Given, sizes_mm: Floats) -> tuple[Hump, ...]:
    """The humps that move the outer wall, the inner wall and the top out by so much, (3,)."""
    chart = given.chart
    places = chart.places(chart.standing(given.base.shape.vertices_mm))
    humps = []
    for (name, peak), size_mm in zip(PEAKS.items(), sizes_mm.tolist(), strict=True):
        at = BACK, peak, TOE_FROM
        if size_mm == 0.0:
            continue
        if name == "higher":
            humps.append(Hump("higher", float(np.log1p(size_mm / _crown_mm(chart))), *at))
            continue
        half_mm = 0.5 * float(np.ptp(places.across_mm[np.abs(places.share - peak) < NEAR]))
        medial = 1.0 if name == "inner" else -1.0
        humps.append(Hump("wider", float(np.log1p(0.5 * size_mm / half_mm)), *at))
        humps.append(Hump("aside", 0.5 * medial * size_mm, *at))
    return tuple(humps)


def toe_box_change(field: Field) -> ToeBoxChange:
    """What the humps of a field change."""
    outer_mm = inner_mm = higher_mm = 0.0
    for hump in field.humps:
        if hump.curve == "higher":
            higher_mm = float(np.expm1(hump.size)) * _crown_mm(field.chart)
        elif hump.curve == "aside":
            outer_mm, inner_mm = max(outer_mm, -2.0 * hump.size), max(inner_mm, 2.0 * hump.size)
    return ToeBoxChange(outer_mm, inner_mm, higher_mm)


def _crown_mm(chart: Chart) -> float:
    """By how much the top rises where that is most, over the change of the scale of heights."""
    return CROWN * float(np.interp(PEAKS["higher"], chart.stations, chart.height_mm))


@dataclass(frozen=True)
class _Choice:
    """What toe rooms and humps do to the toe box, as far as it is foreseen.

    ``lasts`` is the last with n toe rooms, which are ``more_mm`` (n,) more; the first is its own.
    ``better`` (n,) says whether it is a better match than its base. The outer wall, the inner wall
    and the top can move by ``most_mm`` (3,), and ``gains`` is what that gives.
    """

    given: Given
    lasts: JudgedLasts
    more_mm: Floats
    better: Bools
    most_mm: Floats
    gains: _Gains

    def best(self, less: float) -> ToeBoxPlan | None:
        """The best plan with at most so much of what walls and top can move; None if none helps."""
        places = _places(self.lasts)
        values = self.lasts.clearances.value
        sizes_mm = np.zeros((3, len(values)))
        faults, lack_mm = np.zeros((2, len(values)))
        for zone in TOE_BOX:
            if zone not in places:
                continue
            place = places[zone]
            low_mm = self.lasts.asked.columns[place].rule.good[0]
            least_mm, each = DOUBT_MM[zone]
            doubt_mm = least_mm + each * np.abs(self.more_mm)
            own_mm, wanted_mm = values[:, place], low_mm + doubt_mm
            if zone == TOES:
                shares, mm = self._walls(place, wanted_mm, less)
                moved = sizes_mm[:2]
            else:
                shares, mm = self._height(own_mm, wanted_mm, less)
                moved = sizes_mm[2:]
            before, after = (_faults(self.lasts, place, v, doubt_mm) for v in (own_mm, mm))
            helps = (after < before) | ((mm - own_mm > HELPS_MM) & (own_mm < low_mm))
            moved += np.where(helps, shares, 0.0)
            faults += np.where(helps, after, before)
            lack_mm += np.nan_to_num(low_mm - np.where(helps, mm, own_mm)).clip(0.0)
        sizes_mm *= self.most_mm[:, None]
        changed_mm = np.abs(self.more_mm) + sizes_mm.sum(axis=0)
        best = int(np.lexsort((changed_mm + LACK * lack_mm, faults, ~self.better))[0])
        if not changed_mm[best]:
            return None
        return ToeBoxPlan(float(self.more_mm[best]), toe_humps(self.given, sizes_mm[:, best]))

    def _walls(self, place: int, wanted_mm: Floats, less: float) -> tuple[Floats, Floats]:
        """Which shares of the most the walls must move, (2, n), and the toes' clearance then, (n,):
        as much as is wanted, or as far as it goes.
        """
        gains = self.gains
        if not gains.off_mm.shape[1]:
            return np.zeros((2, len(wanted_mm))), self.lasts.clearances.value[:, place]
        off_mm = gains.off_mm - self.lasts.asked.columns[place].rule.cavity
        tried_mm = off_mm[:, None] + less * SHARES[:, None] * SURE * gains.wider_mm[:, None]
        sides = gains.heading > 0.0, gains.heading < 0.0
        outer_mm, inner_mm = (
            np.where(side[:, None], tried_mm, np.inf).min(axis=2) for side in sides
        )
        front_mm = np.where(gains.heading == 0.0, off_mm, np.inf).min(axis=1)
        reached_mm = np.minimum.reduce([wanted_mm, outer_mm[:, -1], inner_mm[:, -1], front_mm])
        steps = [np.argmax(mm >= reached_mm[:, None], axis=1) for mm in (outer_mm, inner_mm)]
        rows = np.arange(len(wanted_mm))
        after_mm = np.minimum.reduce([outer_mm[rows, steps[0]], inner_mm[rows, steps[1]], front_mm])
        return less * SHARES[np.array(steps)], after_mm

    def _height(self, own_mm: Floats, wanted_mm: Floats, less: float) -> tuple[Floats, Floats]:
        """Which share of the most the top must rise, (n,), and the toe height's clearance then."""
        tried_mm = own_mm[:, None] + less * SHARES * SURE * self.gains.higher_mm[:, None]
        reached_mm = np.minimum(wanted_mm, tried_mm.max(axis=1))
        step = np.argmax(tried_mm >= reached_mm[:, None], axis=1)
        return less * SHARES[step], tried_mm[np.arange(len(step)), step]


def _faults(lasts: JudgedLasts, place: int, value_mm: Floats, doubt_mm: Floats | float) -> Ints:
    """How bad a zone with these values (n,) may be, (n,): 1 if it is acceptable, 2 if it is poor.

    It may come out by ``doubt_mm`` otherwise.
    """
    room = lasts.clearances
    spreads = room.foot_sd, room.last_sd, room.heel_sd
    levels = []
    for by_mm in (-doubt_mm, doubt_mm):
        value = room.value.copy()
        value[:, place] = value_mm + by_mm
        levels.append(room_levels(value, *spreads, lasts.asked.columns)[:, place])
    return np.asarray(np.maximum(*levels).clip(0))


def _choice(
    given: Given,
    attempt: Attempt,
    last: JudgedLasts,
    base: JudgedLasts,
    within_mm: tuple[float, float],
) -> _Choice | None:
    """What there is to choose for a try; None if its toe box is not known.

    Its length can become so much less, or more: ``within_mm``.
    """
    places = _places(last)
    own_mm = float(last.clearances.value[0, places[LENGTH]])
    faults = [
        _faults(last, place, last.clearances.value[:, place], DOUBT_MM[zone][0])[0]
        for zone, place in places.items()
        if zone in TOE_BOX
    ]
    if last.lasts.toes is None or not any(faults):
        return None
    rule = last.asked.columns[places[LENGTH]].rule
    low, high = good_range(rule.target, rule)
    more_mm = np.arange(low, high, STEP_MM) - own_mm
    possible = (more_mm >= within_mm[0]) & (more_mm <= within_mm[1])
    more_mm = np.concatenate([[0.0], more_mm[possible]])
    lasts = _with_rooms(last, own_mm + more_mm)
    better = (lasts.level < base.level[0]) | (
        (lasts.level == base.level[0]) & (lasts.distance <= base.distance[0])
    )
    better[0] = True
    arc_mm = given.chart.arc.length_mm
    most_mm = STEEP / STEEPEST * arc_mm * (TOE_FROM - np.array(list(PEAKS.values())))
    if given.bottom_kept:
        most_mm[:2] = 0.0
    rooms_mm = own_mm + more_mm + rule.cavity
    gains = _gains(given, attempt, lasts, rooms_mm, toe_humps(given, most_mm))
    return _Choice(given, lasts, more_mm, better, most_mm, gains)


def _places(last: JudgedLasts) -> dict[str, int]:
    """The column of each zone."""
    return {column.rule.zone: place for place, column in enumerate(last.asked.columns)}


def _with_rooms(last: JudgedLasts, rooms_mm: Floats) -> JudgedLasts:
    """The last with other toe rooms (n,), as n lasts."""
    rows = np.zeros(len(rooms_mm), dtype=np.int64)
    room = last.clearances.taken(rows)
    room.value[:, _places(last)[LENGTH]] = rooms_mm
    return judged_lasts(last.asked, last.lasts.taken(rows), rows, last.heels.taken(rows), room)


@dataclass(frozen=True, slots=True)
class _Gains:
    """How a foot lies in one last with n toe rooms, and what the largest humps would add.

    Attributes
    ----------
    off_mm : (n, m)
        How far points of the foot's outline are from the walls, + is inside; m is 0 if the toes are
        not known.
    heading : (n, m)
        + for points that are nearest to the outer wall, - for the inner one, 0 for the front.
    wider_mm : (n, m)
        By how much farther they would be.
    higher_mm : (n,)
        By how much the toe box would be higher over the toe.
    """

    off_mm: Floats
    heading: Floats
    wider_mm: Floats
    higher_mm: Floats


def _gains(
    given: Given, attempt: Attempt, lasts: JudgedLasts, rooms_mm: Floats, humps: Sequence[Hump]
) -> _Gains:
    """What humps would add to a try, for one foot.

    Parameters
    ----------
    given : Given
        What ``attempt`` was made of.
    attempt : Attempt
    lasts : JudgedLasts
        The last with n toe rooms, its toes known.
    rooms_mm : (n,)
        The toe rooms, with the cavity.
    humps : sequence of Hump
    """
    carried, field = attempt.carried(given), replace(attempt.shape.solved.field, humps=tuple(humps))
    changed = carried.shape(field.moved_points(given.base.shape.vertices_mm))
    every, foot = np.arange(len(rooms_mm)), lasts.asked.toes[0]
    toes, heels = lasts.lasts.toes, lasts.heels
    assert toes is not None
    off_mm = heading = gains_mm = np.zeros((len(rooms_mm), 0))
    if not isinstance(foot.plan, str) and toes.whole.all():
        near = toes_of_foot(foot, toes, every, heels, heels.share, rooms_mm).near
        off_mm, heading = near.off_mm, near.heading
        outline_mm = attempt.made.with_sections.sections.toes_outline_mm
        wider = _wider_mm(outline_mm, toes_outline_mm(changed), near.along_mm)
        gains_mm = np.where(heading > 0.0, wider[0], wider[1]) * np.abs(heading)
    front_mm, behind_mm = _heights_mm(changed) - _heights_mm(attempt.made.shape)
    last_mm = lasts.lasts.measure("length").value
    share = behind_share(foot.foot.length_mm or np.nan, last_mm, rooms_mm)
    higher_mm = (1.0 - share) * front_mm + share * behind_mm
    return _Gains(off_mm, heading, gains_mm, np.nan_to_num(higher_mm))


def _wider_mm(
    before: Floats | None, after: Floats | None, along_mm: Floats
) -> tuple[Floats, Floats]:
    """How far the outer and the inner edge of an outline (k, 3) moved out at places (n, m)."""
    if before is None or after is None:
        return np.zeros_like(along_mm), np.zeros_like(along_mm)
    x = before[:, 0]
    outer, inner = (np.interp(x, after[:, 0], after[:, k]) - before[:, k] for k in (1, 2))
    near_mm = along_mm + NEAR_MM[:, None, None]
    return np.interp(near_mm, x, -outer).min(axis=0), np.interp(near_mm, x, inner).min(axis=0)


def _heights_mm(shape: Shape) -> Floats:
    """The toe height of a last, and the height of its section at the toes, (2,)."""
    front_mm = measure_named(TOE_HEIGHT).taken_of(shape).value
    behind = shape.across(TOES_SECTION.share).points[:, 1]
    return np.array([np.nan if front_mm is None else front_mm, np.ptp(behind)])
