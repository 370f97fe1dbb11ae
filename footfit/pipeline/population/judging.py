"""Every foot in every last, in chunks: the verdict that a match gives, for many feet at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from footfit.catalogue.blocks.record_columns import TOES_SECTION
from footfit.geometry.fit import toe_walls
from footfit.geometry.fit.toe_walls import Walls
from footfit.geometry.measures.heights import HEIGHTS
from footfit.geometry.numeric.arrays import Bools, Bytes, Floats, Ints
from footfit.number_words import KEPT
from footfit.pipeline.fit.heels import Heels, heels_at, rule_of
from footfit.pipeline.fit.judging.toe_box import HEIGHT_SHARES, TOES_SD_MM
from footfit.pipeline.fit.scoring import (
    ACCEPTABLE,
    GOOD,
    NOT_JUDGED,
    REJECT,
    Asked,
    Column,
    asked,
    clearance_levels,
    judged_numbers,
    score_distance,
    score_scale,
    worst_level,
)
from footfit.pipeline.fit.worn_shifts import shifted_rule, zone_shift
from footfit.pipeline.fit.zones import TOE_BOX, TOE_HEIGHT, TOES
from footfit.pipeline.population.shape_columns import ROOM, PairClearances, clearances_of
from footfit.pipeline.population.tables import FootTable, LastTable
from footfit.results import FitProfile, HeelQuestion, Worn
from footfit.results.values import VERDICTS

CELLS = 400_000
"""Feet times lasts times zones that are judged at once: some 30 arrays of 3 MB."""
SERVED = (GOOD, ACCEPTABLE)
FAR = 1e6
"""More than any group of a ranking."""


@dataclass(frozen=True, slots=True)
class Asking:
    """What is asked of each foot in each last."""

    profile: FitProfile
    heel: HeelQuestion
    worn: Worn

    @property
    def zones(self) -> tuple[str, ...]:
        """The zones in the profile's order."""
        return tuple(rule.zone for rule in self.profile.zones)

    @property
    def counts(self) -> Bools:
        """Which zones count, (z,)."""
        return np.array([rule.weight > 0 for rule in self.profile.zones], dtype=bool)


@dataclass(frozen=True, slots=True)
class Judged:
    """n feet, each in all lasts.

    Attributes
    ----------
    level : (n,)
        The verdict of the first last of a match as an index of VERDICTS: REJECT if no last fits,
        NOT_JUDGED if the first last was not judged in a required zone.
    last : (n,)
        The place of that last, or of the nearest one if none fits; -1 if there is none.
    zone_level, clearance : (n, z)
        Verdicts and clearances in that last.
    margin, margin_zone : (n,)
        How far inside acceptable the tightest zone that counts is, in the unit of the zone; - is
        outside. NaN and -1 if nothing was judged.
    known : (n, z)
        Whether any last could be judged in a zone.
    alone, with_length : (n, z, 2)
        Whether any last is good, or at least acceptable, in a zone alone; in it and in length.
    served : (2, lasts, n / 8)
        The feet for which a last is good, or at least acceptable, as bits.
    """

    level: Ints
    last: Ints
    zone_level: Ints
    clearance: Floats
    margin: Floats
    margin_zone: Ints
    known: Bools
    alone: Bools
    with_length: Bools
    served: Bytes


def judged_feet(feet: FootTable, lasts: LastTable, asking: Asking) -> Judged:
    """Every foot in every last. The time is that of feet times lasts, the memory of a chunk."""
    cells = max(1, len(lasts) * len(asking.profile.zones))
    step = max(8, CELLS // cells // 8 * 8)  # whole bytes of bits
    starts = range(0, max(1, len(feet)), step)
    lifted = replace(asking.heel, heel_lift_mm=asking.worn.heel_lift_mm or 0.0)
    heels = heels_at(lifted, lasts.drop_mm)
    parts = [_judged(feet.part(at, at + step), lasts, asking, heels) for at in starts]
    axes = {"served": 2}
    return Judged(
        **{
            f.name: np.concatenate([getattr(part, f.name) for part in parts], axes.get(f.name, 0))
            for f in fields(Judged)
        }
    )


def asked_of(feet: FootTable, asking: Asking) -> Asked:
    """What is asked of each foot, (f, 1, z): what is worn may shift it by its own measure."""
    columns = [_asked_column(feet, place, asking) for place in range(len(asking.profile.zones))]
    return Asked(**{f.name: _beside([getattr(c, f.name) for c in columns]) for f in fields(Asked)})


def _beside(parts: Sequence[Any]) -> Any:
    """Columns (f,) as one array (f, 1, z); pairs of them as a pair."""
    if isinstance(parts[0], tuple):
        return tuple(_beside(ends) for ends in zip(*parts, strict=True))
    return np.stack(parts, axis=-1)[:, None]


def _asked_column(feet: FootTable, place: int, asking: Asking) -> Asked:
    """What is asked of one zone, (f,)."""
    rule, worn = asking.profile.zones[place], asking.worn
    zone = rule.zone
    mm = np.full(len(feet), np.nan)
    if worn.load is not None or worn.time == "morning":  # shares of the foot's own measure
        mm = feet.shapes.value_of(zone)
        if zone == "length":
            whole = feet.shapes.value_of(ROOM)
            mm = np.where(np.isnan(whole), mm, whole)
    values, of_foot = np.unique(mm, return_inverse=True)
    shifts = [zone_shift(zone, None if np.isnan(v) else float(v), worn) for v in values]
    rules = [Column(0, shifted_rule(rule, shift), rule.weight > 0) for shift in shifts]
    arrays = asked(rules)

    return Asked(**{f.name: _rows(getattr(arrays, f.name), of_foot) for f in fields(Asked)})


def _rows(part: Any, rows: Ints) -> Any:
    """Some rows of an array, or of each of a pair."""
    return tuple(_rows(end, rows) for end in part) if isinstance(part, tuple) else part[rows]


def _judged(feet: FootTable, lasts: LastTable, asking: Asking, heels: Heels) -> Judged:
    """A chunk of feet in all lasts."""
    zones, rules = asking.zones, asked_of(feet, asking)
    length = zones.index("length")
    cavity = np.array([rule.cavity for rule in asking.profile.zones])
    room = clearances_of(
        feet.shapes, lasts.shapes, heels, zones, cavity, rules.target[:, 0, length]
    )
    others = np.array([lasts.own_side[side] for side in feet.sides]).reshape(room.value.shape[:2])
    room.value[~others] = np.nan
    level = clearance_levels(room.value, rules, room.sd)
    if _fill_toe_boxes(room, level, feet, lasts, asking, heels, rules):
        level = clearance_levels(room.value, rules, room.sd)
    whole = worst_level(level, rules)
    sound = ~(rules.required & (level == NOT_JUDGED)).any(axis=2)
    fits = (level[:, :, length] != NOT_JUDGED) & (whole < REJECT)
    score = (room.value - rules.target) / score_scale(room.value, rules)
    distance = np.round(score_distance(score, rules.weight[:, 0]), 6)
    group = len(VERDICTS) * (2 * whole + ~sound) + level[:, :, length]
    last = _first(np.where(fits, group, FAR), distance, level[:, :, length] != NOT_JUDGED)
    zone_level = _of_last(level, last, NOT_JUDGED)
    clearance = np.round(_of_last(room.value, last, np.nan), KEPT)
    margin, margin_zone = _margins(judged_numbers(clearance), rules)
    served = np.stack([fits & sound & (whole <= least) for least in SERVED])
    return Judged(
        level=_verdicts(whole, sound, fits, last),
        last=last,
        zone_level=zone_level.astype(np.int8),
        clearance=clearance,
        margin=margin,
        margin_zone=margin_zone,
        known=(level != NOT_JUDGED).any(axis=1),
        alone=_any_last(level, level),
        with_length=_any_last(level, np.maximum(level, level[:, :, length, None])),
        served=np.packbits(np.swapaxes(served, 1, 2), axis=2),
    )


def _first(group: Floats, distance: Floats, known: Bools) -> Ints:
    """The first last by group, distance and name; if none fits, the nearest; -1 for none."""
    if not group.shape[1]:
        return np.full(len(group), -1)
    best = group.min(axis=1, keepdims=True)
    among = np.where(best < FAR, group == best, known)
    first = np.where(among, distance, np.inf).argmin(axis=1)
    return np.where(among.any(axis=1), first, -1)


def _verdicts(whole: Ints, sound: Bools, fits: Bools, last: Ints) -> Ints:
    """The verdict (f,) of each foot's first last."""
    if not whole.shape[1]:
        return np.full(len(whole), REJECT)
    at = np.arange(len(whole)), np.maximum(last, 0)
    level = np.where(sound[at], whole[at], NOT_JUDGED)
    return np.where(fits[at] & (last >= 0), level, REJECT)


def _of_last(values: Any, last: Ints, nothing: float) -> Any:
    """The values (f, z) of the last that is shown; ``nothing`` if there is none."""
    if not values.shape[1]:
        return np.full((values.shape[0], values.shape[2]), nothing, dtype=values.dtype)
    of_last = values[np.arange(len(last)), np.maximum(last, 0)]
    return np.where(last[:, None] >= 0, of_last, nothing).astype(values.dtype)


def _margins(clearance: Floats, rules: Asked) -> tuple[Floats, Ints]:
    """The margin (f,) of the zone that is nearest to the edge of acceptable, and the zone.

    Zones of different units are compared in their scales, as scores are.
    """
    low, high = (end[:, 0] for end in rules.acceptable)
    inside = np.minimum(clearance - low, high - clearance)
    scale = np.where(clearance >= rules.target[:, 0], rules.above[:, 0], rules.below[:, 0])
    judged = rules.counts[:, 0] & np.isfinite(inside)
    nearest = np.where(judged, inside / scale, np.inf).argmin(axis=1)
    known = judged.any(axis=1)
    margin = inside[np.arange(len(inside)), nearest]
    return np.where(known, margin, np.nan), np.where(known, nearest, -1)


def _any_last(zone_level: Ints, level: Ints) -> Bools:
    """Whether any last (f, z, 2) is good, or at least acceptable, by a level (f, n, z)."""
    known = (zone_level != NOT_JUDGED) & (level != NOT_JUDGED)
    return np.stack([(known & (level <= least)).any(axis=1) for least in SERVED], axis=-1)


# ---------------------------------------------------------------- the toe box


def _fill_toe_boxes(
    room: PairClearances,
    level: Ints,
    feet: FootTable,
    lasts: LastTable,
    asking: Asking,
    heels: Heels,
    rules: Asked,
) -> bool:
    """Write the clearances of the toe box where no other zone rejects; was there anything?"""
    boxes, zones = lasts.toe_boxes, asking.zones
    if boxes is None or not TOE_BOX & set(zones):
        return False
    length = zones.index("length")
    passing = (level[:, :, length] != NOT_JUDGED) & (worst_level(level, rules) < REJECT)
    passing &= ~heels.length_only
    rooms_mm = room.value[:, :, length] + asking.profile.zones[length].cavity
    for place, rule in enumerate(asking.profile.zones):
        if rule.zone == TOE_HEIGHT:
            cell, variance = _toe_heights(feet, lasts, rooms_mm)
        elif rule.zone == TOES:
            cell, variance = _tightest_toes(feet, lasts, rooms_mm, passing, heels)
        else:
            continue
        room.value[:, :, place] = np.where(passing, cell - rule.cavity, np.nan)
        room.sd[:, :, place] = np.sqrt(variance)
    return True


def _toe_heights(feet: FootTable, lasts: LastTable, rooms_mm: Floats) -> tuple[Floats, Floats]:
    """The heights of lasts over the feet's toes (f, n), and their variances; see `toe_height`."""
    ours, theirs = feet.shapes.measures.get(TOE_HEIGHT), lasts.shapes.measures[TOE_HEIGHT]
    if ours is None or lasts.toe_boxes is None:
        return np.full(rooms_mm.shape, np.nan), np.zeros(rooms_mm.shape)
    same = ours.definition[:, None] == theirs.definition
    foot_mm, last_mm = feet.length_mm[:, None], lasts.shapes.value_of("length")
    place = 1.0 - ((1.0 - HEIGHTS.toe) * foot_mm + rooms_mm) / last_mm
    share = (HEIGHTS.toe - np.clip(place, *HEIGHT_SHARES)) / (HEIGHTS.toe - TOES_SECTION.share)
    off = theirs.value - ours.value[:, None]
    value = np.where(same, off + share * (lasts.toe_boxes.behind_mm - theirs.value), np.nan)
    return value, np.square(ours.sd)[:, None] + np.square(theirs.sd)


def _tightest_toes(
    feet: FootTable, lasts: LastTable, rooms_mm: Floats, passing: Bools, heels: Heels
) -> tuple[Floats, Floats]:
    """The tightest toe of each foot in the lasts that pass (f, n), and the variances."""
    value, variance = np.full(rooms_mm.shape, np.nan), np.zeros(rooms_mm.shape)
    boxes, model = lasts.toe_boxes, heels.question.model
    if boxes is None or boxes.walls is None or feet.toes is None:
        return value, variance
    change = [rule_of(model, name).change for name in ("length", "ball_width")]
    width_sd = (
        0.5 * rule_of(model, "ball_width").sd * np.nan_to_num(feet.shapes.value_of("ball_width"))
    )
    for foot, plan in enumerate(feet.toes):
        rows = np.flatnonzero(passing[foot] & (boxes.row >= 0))
        if plan is None or not len(rows):
            continue
        at = boxes.row[rows]
        walls = Walls(boxes.walls.edges_mm[at], boxes.walls.seat_mm[at])
        scale = 1.0 + heels.share[rows, None] * np.array(change)
        inside = toe_walls.toes_in_lasts(plan, walls, rooms_mm[foot, rows], scale)
        value[foot, rows] = inside.value_mm.min(axis=1)
        variance[foot, rows] = 2.0 * TOES_SD_MM**2 + np.square(heels.share[rows] * width_sd[foot])
    return value, variance
