"""The row-by-row answer of a match by fit: one last at a time, from its rows, in plain Python.

It shares the rules of a single number with the program (a range, a spread, a length along a
bottom), but no columns, no blocks, no gates and no order of the work: the oracle of the search.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from footfit.catalogue.store import open_catalogue
from footfit.geometry.fit import toe_walls
from footfit.geometry.fit.along_the_bottom import ALONG_BOTTOM, LastLengths, length_along_bottom
from footfit.geometry.flare.profile_distance import DISTANCE
from footfit.geometry.measures.heights import HEIGHTS
from footfit.pipeline.fit.heels import Heels, full_change, heels_of, surface_change
from footfit.pipeline.fit.judging.bottom_gains import LENGTHS
from footfit.pipeline.fit.judging.cells import OTHER_DEFINITION, ZoneShape, foot_shape, last_shape
from footfit.pipeline.fit.judging.clearances import BALL_SHARE, PLAN_SD, length_only_words
from footfit.pipeline.fit.judging.judged_lasts import Asked
from footfit.pipeline.fit.judging.toe_box import (
    HEIGHT_SHARES,
    NOT_STORED,
    TOES_SD_MM,
    plan_of_foot,
)
from footfit.pipeline.fit.scoring import SURE_SDS, scales
from footfit.pipeline.fit.zones import HEEL_RULES, NOT_READ, TOE_HEIGHT, TOES, ZONES
from footfit.pipeline.shelf.nearness import LENGTH_SD_MM
from footfit.results import LastRecord, Profiled, ShapeSections, ZoneRule
from footfit.results.values import VERDICTS

OPEN_TOES = "the last: the scan is open at the toes"
NOT_JUDGED = None


@dataclass(frozen=True, slots=True)
class Clearance:
    """The last minus the foot in one zone, with the spread that each of the two brings, and that
    of the heel model.

    ``value`` is NaN where it is not measured; ``reason`` then says why.
    """

    value: float
    foot_sd: float = 0.0
    last_sd: float = 0.0
    reason: str | None = None
    heel_sd: float = 0.0


def missing(reason: str) -> Clearance:
    """No clearance, for this reason."""
    return Clearance(math.nan, reason=reason)


def measure_difference(foot: ZoneShape, last: ZoneShape, name: str) -> Clearance:
    """The last's measure minus the foot's, if both have it and mean the same by it."""
    for kind, shape in (("foot", foot), ("last", last)):
        if name not in shape.measures:
            return missing(f"not measured on the {kind}")
        if shape.measured_mm(name) is None:
            reason = shape.measures[name].measured.reason or "not measured"
            return missing(f"the {kind}: {reason}")
    if foot.measures[name].definition != last.measures[name].definition:
        return missing(OTHER_DEFINITION)
    ours, theirs = foot.measures[name].measured, last.measures[name].measured
    assert ours.value is not None
    assert theirs.value is not None
    return Clearance(theirs.value - ours.value, ours.sd or 0.0, theirs.sd or 0.0)


def _length(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """The toe room: functional lengths where both are measured, else lengths, along the bottom of
    the last. A last in the foot's place, as in a search by shape, is measured along its bottom too.
    """
    room = measure_difference(foot, last, "functional_length")
    if room.reason is not None:  # lengths of other versions differ by tenths of a mm
        foot_mm, last_mm = foot.measured_mm("length"), last.measured_mm("length")
        if foot_mm is None or last_mm is None:
            return measure_difference(foot, last, "length")
        room = Clearance(last_mm - foot_mm, LENGTH_SD_MM, LENGTH_SD_MM)
    ours, theirs = bottom_gain(foot), bottom_gain(last)
    if ours.reason is not None or theirs.reason is not None:
        return missing(ours.reason or theirs.reason or "")
    return Clearance(
        room.value + theirs.value - ours.value,
        math.hypot(room.foot_sd, ours.last_sd),
        math.hypot(room.last_sd, theirs.last_sd),
    )


def bottom_gain(last: ZoneShape) -> Clearance:
    """How much longer a last with a heel is along its bottom than along its resting plane.

    Without the measures of its bottom the toe room of a last with a high heel is not known.
    """
    heel_mm = last.heel_height_mm
    if heel_mm is None or heel_mm <= ALONG_BOTTOM.level_mm:
        return Clearance(0.0)
    found = [last.measures.get(name) for name in LENGTHS]
    known = [row.measured.value for row in found if row is not None]
    lengths = [value for value in known if value is not None]
    level_mm = last.measured_mm("functional_length") or last.measured_mm("length")
    if level_mm is None or len(lengths) < len(LENGTHS):
        low = heel_mm < ALONG_BOTTOM.raised_mm
        return Clearance(0.0) if low else missing("the last: its bottom is not measured")
    if any(row is not None and row.definition != LENGTHS[row.name] for row in found):
        return missing(OTHER_DEFINITION)
    along_mm, sd_mm = length_along_bottom(level_mm, LastLengths(*lengths))
    return Clearance(along_mm - level_mm, last_sd=sd_mm)


def _ball_line(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """How much further forward the last's ball is, in mm along X.

    On a high heel that is not its place along the bottom: one last, bent from 0 to 80 mm of heel,
    moved it by up to 23 mm (decision 0210).
    """
    high_mm = ALONG_BOTTOM.raised_mm
    if any((shape.heel_height_mm or 0.0) > high_mm for shape in (foot, last)):
        return missing(f"over {high_mm:g} mm of heel the ball's place along the bottom is unknown")
    return measure_difference(foot, last, "ball_length")


def _flare(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """The flare angles' difference."""
    delta = last.flare.angle_deg - foot.flare.angle_deg
    return Clearance(delta, foot.flare.angle_sd_deg, last.flare.angle_sd_deg)


def _plan(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """The root mean square of the plan curvatures' difference over the distance's stations."""
    ours, theirs = foot.flare.curvature.get("plan"), last.flare.curvature.get("plan")
    if ours is None or theirs is None or len(ours) != len(theirs):
        return missing("the plan curve is not measurable")
    low, high = DISTANCE.stations
    inside = (foot.flare.stations >= low) & (foot.flare.stations <= high)
    rms = float(np.sqrt(np.mean(np.square(theirs[inside] - ours[inside]))))
    return Clearance(rms, PLAN_SD, PLAN_SD)


def plain_clearance(foot: ZoneShape, last: ZoneShape, zone: str) -> Clearance:
    """The clearance of a zone as both were measured; of the ball line that of the balls, in mm."""
    special = {"length": _length, "ball_line": _ball_line, "flare": _flare, "plan": _plan}
    if zone in (TOES, TOE_HEIGHT):
        return missing(NOT_READ)
    return special[zone](foot, last) if zone in special else measure_difference(foot, last, zone)


@dataclass
class OneLast:
    """One last, judged for one customer: a clearance and a verdict for each column."""

    record: LastRecord
    cells: list[Clearance]
    levels: list[int | None]
    scores: list[float | None]
    sds: list[tuple[float, float, float]]


def cells_of(asked: Asked, record: LastRecord, heels: Heels) -> list[Clearance]:
    """The clearances of one last without its toe box."""
    share, only = float(heels.share[0]), bool(heels.length_only[0])
    last, model = last_shape(record), heels.question.model
    cells, rooms = [], {}
    for column in asked.columns:
        foot, zone = asked.feet[column.foot], column.rule.zone
        change, sd = full_change(model, foot, HEEL_RULES.get(zone, zone))
        cell = plain_clearance(foot_shape(foot), last, zone)
        cell = replace(cell, value=cell.value - share * change, heel_sd=share * sd)
        if zone == "length":
            rooms[column.foot] = (cell, column.rule.target)
        cells.append(cell)
    for at, column in enumerate(asked.columns):
        cell, zone = cells[at], column.rule.zone
        if zone == "ball_line":
            cell = _off_ball_line(cell, *rooms[column.foot], foot_shape(asked.feet[column.foot]))
        if only and zone != "length" and model is not None:
            reason = cell.reason or length_only_words(model)
            cell = replace(cell, value=math.nan, reason=reason)
        cells[at] = replace(cell, value=cell.value - column.rule.cavity)
    return cells


def _off_ball_line(cell: Clearance, room: Clearance, asked_mm: float, foot: ZoneShape) -> Clearance:
    scale = 100.0 / foot.extent_mm
    carried = BALL_SHARE * (room.value - asked_mm)
    low, high = min(carried, 0.0), max(carried, 0.0)
    off = cell.value - min(max(cell.value, low), high) if not math.isnan(carried) else math.nan
    return Clearance(
        scale * off,
        scale * cell.foot_sd,
        scale * cell.last_sd,
        cell.reason or room.reason,
        scale * cell.heel_sd,
    )


def with_toes(
    asked: Asked,
    record: LastRecord,
    kept: ShapeSections | None,
    heels: Heels,
    cells: list[Clearance],
) -> list[Clearance]:
    """The clearances with the toe box of one last."""
    cells, model = list(cells), heels.question.model
    for index, foot in enumerate(asked.feet):
        places = {c.rule.zone: i for i, c in enumerate(asked.columns) if c.foot == index}
        rules = {zone: asked.columns[place].rule for zone, place in places.items()}
        room_mm = cells[places["length"]].value + rules["length"].cavity
        for zone, toe_cell in ((TOES, _toes), (TOE_HEIGHT, _toe_height)):
            if zone not in places:
                continue
            if heels.length_only[0]:
                assert model is not None
                cells[places[zone]] = missing(length_only_words(model))
                continue
            cell = toe_cell(foot, record, kept, heels, room_mm)
            cells[places[zone]] = replace(cell, value=cell.value - rules[zone].cavity)
    return cells


def _toe_height(
    foot: Profiled, record: LastRecord, kept: ShapeSections | None, _: Heels, room_mm: float
) -> Clearance:
    cell = measure_difference(foot_shape(foot), last_shape(record), TOE_HEIGHT)
    if cell.reason is not None:
        return cell
    if kept is None:
        return missing(NOT_STORED)
    section = kept.sections.get("toes")
    last_mm, foot_mm, front_mm = record.length_mm, foot.length_mm, record.value_of(TOE_HEIGHT)
    if section is None or last_mm is None or foot_mm is None:
        return missing(OPEN_TOES)
    place = 1.0 - ((1.0 - HEIGHTS.toe) * foot_mm + room_mm) / last_mm
    place = min(max(place, HEIGHT_SHARES[0]), HEIGHT_SHARES[1])
    share = (HEIGHTS.toe - place) / (HEIGHTS.toe - 0.88)
    behind_mm = float(np.ptp(section.points_mm[:, 1]))
    assert front_mm is not None
    return replace(cell, value=cell.value + share * (behind_mm - front_mm))


def _toes(
    foot: Profiled, record: LastRecord, kept: ShapeSections | None, heels: Heels, room_mm: float
) -> Clearance:
    ours = plan_of_foot(foot)
    if isinstance(ours, str):
        return missing(ours)
    if kept is None:
        return missing(NOT_STORED)
    outline = kept.toes_outline_mm
    if outline is None or len(outline) != 80:
        return missing(OPEN_TOES)
    plan = toe_walls.last_plan(outline, record.flare.centre_line * record.extent_mm)
    change = surface_change(heels, 0)
    scale = np.array([[1.0 + change.length, 1.0 + change.ball_width]])
    inside = toe_walls.toes_in_lasts(ours, toe_walls.walls([plan]), np.array([room_mm]), scale)
    width_sd = 0.5 * full_change(heels.question.model, foot, "ball_width")[1]
    heel_sd = abs(float(heels.share[0])) * width_sd
    return Clearance(float(inside.value_mm.min()), TOES_SD_MM, TOES_SD_MM, heel_sd=heel_sd)


def level_of(cell: Clearance, rule: ZoneRule) -> int | None:
    """The verdict of one clearance."""
    if math.isnan(cell.value):
        return NOT_JUDGED
    value = float(np.round(cell.value, 3))
    sd = math.sqrt(cell.foot_sd**2 + cell.last_sd**2 + cell.heel_sd**2)
    doubt = 0.0 if rule.zone == "length" else SURE_SDS * sd

    def outside(ends: tuple[float, float] | None, by: float = 0.0) -> bool:
        return ends is not None and not ends[0] - by <= value <= ends[1] + by

    if outside(rule.poor, doubt):
        return 3
    if outside(rule.poor):
        return 2
    return int(outside(rule.good)) + int(outside(rule.acceptable))


def judged_one(asked: Asked, record: LastRecord, kept: ShapeSections | None) -> OneLast:
    """One last, judged."""
    heels = heels_of(asked.heel, [record])
    cells = cells_of(asked, record, heels)
    levels = [level_of(cell, c.rule) for cell, c in zip(cells, asked.columns, strict=True)]
    rooms = [at for at, c in enumerate(asked.columns) if c.rule.zone == "length"]
    if asked.toes and all(levels[at] is not None for at in rooms) and worst(asked, levels) < 3:
        cells = with_toes(asked, record, kept, heels, cells)
        levels = [level_of(cell, c.rule) for cell, c in zip(cells, asked.columns, strict=True)]
    scores: list[float | None] = []
    sds = []
    for cell, column in zip(cells, asked.columns, strict=True):
        width = scales(column.rule)[int(cell.value >= column.rule.target)]
        known = not math.isnan(cell.value)
        scores.append((cell.value - column.rule.target) / width if known else None)
        three = (cell.foot_sd, cell.last_sd, cell.heel_sd)
        sds.append(tuple(sd / width for sd in three) if known else (0.0, 0.0, 0.0))
    return OneLast(record, cells, levels, scores, sds)


def worst(asked: Asked, levels: Sequence[int | None]) -> int:
    """The verdict of a last."""
    pairs = list(zip(levels, asked.columns, strict=True))
    counted = max((level for level, c in pairs if c.counts and level is not None), default=0)
    unknown = any(level is None and c.counts and c.rule.required for level, c in pairs)
    return max(counted, 1) if unknown else counted


def refusal(asked: Asked, last: OneLast) -> str:
    """Why a last is left out."""
    for level, score, column in zip(last.levels, last.scores, asked.columns, strict=True):
        if column.counts and level == 3:
            zone = ZONES[column.rule.zone]
            start = "too" if zone.name == "length" else zone.name
            word = zone.more if (score or 0.0) > 0 else zone.less
            return f"{start}_{word}".replace(" ", "_")
    raise AssertionError("it is not left out")


def answer(asked: Asked, path: Path, names: Sequence[str], top: int) -> dict[str, Any]:
    """The answer by fit over the lasts of these names: what is compared with the program's."""
    with open_catalogue(path) as catalogue:
        lasts = [judged_one(asked, catalogue.record(n), catalogue.sections(n)) for n in names]
    length = asked.length_column
    roomy = [last for last in lasts if last.levels[length] is not None]
    counts = Counter(refusal(asked, last) for last in roomy if worst(asked, last.levels) == 3)
    unknown = len(lasts) - len(roomy)
    counts += Counter({"length_unknown": unknown})
    weights = _weights(asked, lasts)
    kept = [last for last in roomy if worst(asked, last.levels) < 3]
    ordered = sorted(kept, key=lambda last: _key(asked, last, weights))
    if not kept:
        near = sorted(
            roomy, key=lambda last: (round(distance(last, weights), 6), last.record.labels.name)
        )
        return {"nearest": [last.record.labels.name for last in near[:3]], "rejected": dict(counts)}
    tiers = _tiers(asked, ordered, weights)
    shown = range(len(ordered))[: top or None]
    return {
        "rejected": dict(counts),
        "lasts": [ordered[at].record.labels.name for at in shown],
        "verdicts": [VERDICTS[worst(asked, ordered[at].levels)] for at in shown],
        "distances": [distance(ordered[at], weights) for at in shown],
        "tied": [
            [
                ordered[other].record.labels.name
                for other in range(len(ordered))
                if tiers[other] == tiers[at] and other != at
            ]
            for at in shown
        ],
        "cells": [ordered[at].cells for at in shown],
    }


def _weights(asked: Asked, lasts: Sequence[OneLast]) -> list[float]:
    """Each column's share; a zone that no last is judged in has none."""
    weights = [
        column.rule.weight
        if column.counts and any(x.scores[at] is not None for x in lasts)
        else 0.0
        for at, column in enumerate(asked.columns)
    ]
    total = sum(weights)
    return [weight / total if total else 0.0 for weight in weights]


def distance(last: OneLast, weights: Sequence[float]) -> float:
    """The fit distance of one last."""
    known = [1.0 if score is None else score for score in last.scores]
    return math.sqrt(sum(w * u**2 for w, u in zip(weights, known, strict=True)))


def _key(asked: Asked, last: OneLast, weights: Sequence[float]) -> tuple[Any, ...]:
    unsure = any(
        c.counts and c.rule.required and score is None
        for c, score in zip(asked.columns, last.scores, strict=True)
    )
    return (
        worst(asked, last.levels),
        unsure,
        last.levels[asked.length_column],
        round(distance(last, weights), 6),
        last.record.labels.name,
    )


def _tiers(asked: Asked, ordered: Sequence[OneLast], weights: Sequence[float]) -> list[int]:
    """The tier of each last."""
    tier: list[int] = []
    first: OneLast | None = None
    for last in ordered:
        same = (
            first is not None and _key(asked, last, weights)[:3] == _key(asked, first, weights)[:3]
        )
        if same:
            assert first is not None
            apart = distance(last, weights) - distance(first, weights)
            same = apart <= asked.tie_sds * _difference_sd(first, last, weights)
        if not same:
            first = last
        tier.append(tier[-1] + (not same) if tier else 0)
    return tier


def _slopes(last: OneLast, weights: Sequence[float]) -> tuple[list[float], float]:
    """The derivative of the distance by each score, and the variance from the last's measures."""
    scores = [1.0 if score is None else score for score in last.scores]
    foot = [sds[0] ** 2 + sds[2] ** 2 for sds in last.sds]
    own = [sds[1] ** 2 for sds in last.sds]
    base = sum(w * (u**2 + f + o) for w, u, f, o in zip(weights, scores, foot, own, strict=True))
    base = max(base, 1e-18)
    slopes = [w * u / math.sqrt(base) for w, u in zip(weights, scores, strict=True)]
    variance = sum(
        s**2 * o + w**2 / (2.0 * base) * o * (o + 2.0 * f)
        for s, w, f, o in zip(slopes, weights, foot, own, strict=True)
    )
    return slopes, variance


def _difference_sd(one: OneLast, other: OneLast, weights: Sequence[float]) -> float:
    slopes, others = _slopes(one, weights), _slopes(other, weights)
    total = slopes[1] + others[1]
    for a, b, sd, sd_other in zip(slopes[0], others[0], one.sds, other.sds, strict=True):
        total += ((a - b) * 0.5 * (sd[0] + sd_other[0])) ** 2 + (a * sd[2] - b * sd_other[2]) ** 2
    return math.sqrt(total)
