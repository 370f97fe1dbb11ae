"""By how much the toe room should leave its target, so that the toe box fits better."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.fit.judging.judged_lasts import JudgedLasts, judged_lasts
from footfit.pipeline.fit.scoring import room_levels
from footfit.pipeline.fit.zones import TOE_BOX, TOES
from footfit.pipeline.last_making.custom.custom_aims import good_range

STEP_MM = 0.2
"""Toe rooms are tried so far apart."""
DOUBT_MM, DOUBT = 0.1, 0.12
"""A zone of the toe box may come out so far from what is foreseen: in mm, and at the walls for each
mm of change too."""


def toe_room_change_mm(
    last: JudgedLasts, base: JudgedLasts, within_mm: tuple[float, float]
) -> float:
    """By how much more toe room the toe box of a last needs; 0 if another one would not help.

    The toe moves ahead as a whole, so another toe room lays the foot farther back, or ahead, in the
    same toe box. The least change counts that makes it fit best. The last must stay a better match
    than its base.

    Parameters
    ----------
    last : JudgedLasts
        One last, judged for one foot.
    base : JudgedLasts
        Its base, judged likewise.
    within_mm : tuple of float
        The last can become shorter, or longer, by so much.
    """
    places = {column.rule.zone: place for place, column in enumerate(last.asked.columns)}
    toes = {zone: place for zone, place in places.items() if zone in TOE_BOX}
    length = places["length"]
    own_mm = float(last.clearances.value[0, length])
    if not np.isfinite(last.clearances.value[0, list(toes.values())]).any():
        return 0.0
    rule = last.asked.columns[length].rule
    low, high = good_range(rule.target, rule)
    more_mm = np.arange(low, high, STEP_MM) - own_mm
    possible = (more_mm >= within_mm[0]) & (more_mm <= within_mm[1])
    more_mm = np.concatenate([[0.0], more_mm[possible]])
    others = _with_rooms(last, own_mm + more_mm)
    doubts_mm = {zone: DOUBT_MM + DOUBT * (zone == TOES) * np.abs(more_mm) for zone in toes}
    faults = np.sum([_faults(others, toes[zone], doubts_mm[zone]) for zone in toes], axis=0)
    better = (others.level < base.level[0]) | (
        (others.level == base.level[0]) & (others.distance <= base.distance[0])
    )
    better[0] = True
    order = np.lexsort((np.abs(more_mm), faults, ~better))
    return float(more_mm[order[0]]) if faults[order[0]] < faults[0] else 0.0


def _with_rooms(last: JudgedLasts, rooms_mm: Floats) -> JudgedLasts:
    """The last with other toe rooms (n,), as n lasts."""
    places = {column.rule.zone: place for place, column in enumerate(last.asked.columns)}
    rows = np.zeros(len(rooms_mm), dtype=np.int64)
    room = last.clearances.taken(rows)
    room.value[:, places["length"]] = rooms_mm
    return judged_lasts(last.asked, last.lasts.taken(rows), rows, last.heels.taken(rows), room)


def _faults(lasts: JudgedLasts, place: int, doubt_mm: Floats) -> Ints:
    """How bad a zone may be, (n,): 1 if it is acceptable, 2 if it is poor. It may come out by
    ``doubt_mm`` (n,) otherwise.
    """
    room = lasts.clearances
    spreads = room.foot_sd, room.last_sd, room.heel_sd
    levels = [
        room_levels(room.value + by_mm[:, None], *spreads, lasts.asked.columns)[:, place]
        for by_mm in (-doubt_mm, doubt_mm)
    ]
    return np.asarray(np.maximum(*levels).clip(0))
