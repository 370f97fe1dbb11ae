"""The clearances of feet in lasts: last minus foot, for many lasts at once.

The lasts are columns, so one last is a column of one. Each zone's function compares one foot with
all lasts, as both were measured.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from footfit.catalogue.blocks.record_columns import columns_of
from footfit.geometry.fit.along_the_bottom import ALONG_BOTTOM
from footfit.geometry.flare.definition import CHANNELS
from footfit.geometry.flare.profile_distance import DISTANCE, inside
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.fit.heels import Heels, full_change
from footfit.pipeline.fit.judging.bottom_gains import last_gain, shape_gain
from footfit.pipeline.fit.judging.cells import (
    Cells,
    ZoneShape,
    foot_shape,
    known_cells,
    measure_difference,
    missing,
)
from footfit.pipeline.fit.scoring import Column
from footfit.pipeline.fit.zones import (
    HEEL_RULES,
    NO_RULE,
    NOT_READ,
    TOE_BOX,
    TOE_HEIGHT,
    TOES,
    ZONES,
)
from footfit.pipeline.shelf.nearness import LENGTH_SD_MM
from footfit.results import HeelModel, LastRecord, Measured, Profiled, ZoneRule
from footfit.results.columns.last_columns import NOT_KEPT, LastColumns
from footfit.results.columns.vocabulary import NO_WORD, Vocabulary, Words

PLAN_SD = DISTANCE.sd[CHANNELS.index("plan")]
BALL_SHARE = 0.72
"""Where the ball lies, over the length, if it was not measured."""


@dataclass(frozen=True, slots=True)
class Clearances:
    """The clearances of n lasts in z columns: the last minus the foot as it is in the last's heel.

    ``value`` (n, z) is NaN where it is not measured; ``reason`` (n, z) then is the number of a
    sentence of ``sentences``, else NO_WORD. The spreads (n, z) are of the foot's scan, of the last,
    and of the heel model. The model's is - where the model is applied backwards: one error of the
    model moves all lasts at once.
    """

    value: Floats
    foot_sd: Floats
    last_sd: Floats
    heel_sd: Floats
    reason: Ints
    sentences: Words

    def measured(self, row: int, place: int) -> Measured:
        """One clearance as a result."""
        reason = self.reason[row, place]
        if reason != NO_WORD:
            return Measured(None, reason=self.sentences.values[reason])
        spreads = (self.foot_sd, self.last_sd, self.heel_sd)
        sd = math.hypot(*(float(spread[row, place]) for spread in spreads))
        return Measured(float(self.value[row, place]), sd)

    def taken(self, rows: Ints) -> Clearances:
        """Those of some lasts."""
        return replace(self, **{name: getattr(self, name)[rows] for name in TABLES})

    def copied(self) -> Clearances:
        """The same, to be written to."""
        return replace(self, **{name: getattr(self, name).copy() for name in TABLES})

    def put(self, rows: Ints, place: int, cells: Cells, heel_sd: Floats | float = 0.0) -> None:
        """Write the clearances of some lasts into one column."""
        for known in fields(cells):
            getattr(self, known.name)[rows, place] = getattr(cells, known.name)
        self.heel_sd[rows, place] = heel_sd


TABLES = ("value", "foot_sd", "last_sd", "heel_sd", "reason")


def joined_clearances(parts: Sequence[Clearances]) -> Clearances:
    """The clearances of lasts one after the other; all parts share their sentences."""
    arrays: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in parts]) for name in TABLES
    }
    return replace(parts[0], **arrays)


def clearances(
    feet: Sequence[Profiled],
    lasts: LastColumns,
    columns: Sequence[Column],
    heels: Heels,
    sentences: Words,
) -> Clearances:
    """The clearance of each foot in each last: a row for each last, a column for each zone.

    The shapes are compared as they were measured. Then each column gets what the heels of the lasts
    change of the foot.
    """
    ours = [foot_shape(foot) for foot in feet]
    cells = [_cells(ours[column.foot], lasts, column.rule.zone, sentences) for column in columns]
    value, foot_sd, last_sd, reason = (
        np.stack([getattr(cell, known.name) for cell in cells], axis=1) for known in fields(Cells)
    )
    heel_sd = np.zeros_like(value)
    for place, column in enumerate(columns):
        measure = HEEL_RULES.get(column.rule.zone, column.rule.zone)
        change, sd = full_change(heels.question.model, feet[column.foot], measure)
        value[:, place] -= heels.share * change
        heel_sd[:, place] = heels.share * sd
    lengths = {column.foot: i for i, column in enumerate(columns) if is_length(column)}
    rooms_mm = {foot: value[:, place].copy() for foot, place in lengths.items()}
    for place, column in enumerate(columns):
        if column.rule.zone == "ball_line":
            asked_mm = columns[lengths[column.foot]].rule.target
            scale = 100.0 / ours[column.foot].extent_mm
            off_mm = ball_line_mm(value[:, place], rooms_mm[column.foot], asked_mm)
            value[:, place] = scale * off_mm
            for spread in (foot_sd, last_sd, heel_sd):
                spread[:, place] *= scale
            room = reason[:, lengths[column.foot]]
            reason[:, place] = np.where(reason[:, place] == NO_WORD, room, reason[:, place])
        if not is_length(column):
            value[heels.length_only, place] = np.nan
    value -= np.array([column.rule.cavity for column in columns])
    model = heels.question.model
    if model is not None and heels.length_only.any():
        others = np.array([not is_length(column) for column in columns])
        only = (reason == NO_WORD) & heels.length_only[:, None] & others
        reason[only] = sentences.number(length_only_words(model))
    return Clearances(value, foot_sd, last_sd, heel_sd, reason, sentences)


def columns_of_last(last: LastRecord) -> LastColumns:
    """One last as a column of one, without its toes."""
    return columns_of([last], [NOT_KEPT], Vocabulary())


def toe_room(foot: Profiled, last: LastRecord, heels: Heels) -> Measured:
    """The toe room of one foot in one last, whose heel is the first of ``heels``: the zone "length"
    without a cavity.
    """
    sentences = Words()
    room = _length(foot_shape(foot), columns_of_last(last), sentences)
    if room.reason[0] != NO_WORD:
        return Measured(None, reason=sentences.values[room.reason[0]])
    share = float(heels.share[0])
    change, sd = full_change(heels.question.model, foot, "length")
    spread = math.hypot(float(room.foot_sd[0]), float(room.last_sd[0]), share * sd)
    return Measured(float(room.value[0]) - share * change, spread)


def measured_clearances(
    foot: Profiled, last: LastRecord, heels: Heels
) -> tuple[tuple[str, Measured], ...]:
    """The clearance of one foot in every measure of a last, as a match gives it without a cavity;
    the last's heel is the first of ``heels``.
    """
    named = [zone.name for zone in ZONES.values() if zone.unit == "mm" and zone.name != "length"]
    names = [name for name in named if name not in TOE_BOX]
    columns = [Column(0, ZoneRule(name, *NO_RULE), counts=False) for name in names]
    room = clearances([foot], columns_of_last(last), columns, heels, Words())
    return tuple((name, room.measured(0, place)) for place, name in enumerate(names))


def is_length(column: Column) -> bool:
    """Is this the column of a toe room?"""
    return column.rule.zone == "length"


def length_only_words(model: HeelModel) -> str:
    """Why girths are not judged in a heel that is higher than the heel model knows."""
    return f"over {model.largest_drop_mm:g} mm of drop only the length is judged"


# ---------------------------------------------------------------- one zone


def _cells(foot: ZoneShape, lasts: LastColumns, zone: str, sentences: Words) -> Cells:
    """The clearance in a zone, as both were measured; of the ball line that of the balls, in mm."""
    if zone in SPECIAL:
        return SPECIAL[zone](foot, lasts, sentences)
    return measure_difference(foot, lasts, zone, sentences)


def _length(foot: ZoneShape, lasts: LastColumns, sentences: Words) -> Cells:
    """The toe room: functional lengths where both are measured, else lengths, along the bottom of
    the last. A last in the foot's place, as in a search by shape, is measured along its bottom too.
    """
    room = measure_difference(foot, lasts, "functional_length", sentences)
    lacking = room.reason != NO_WORD
    if lacking.any():  # lengths of other versions differ by tenths of a mm
        foot_mm, last_mm = foot.measured_mm("length"), lasts.measure("length").value
        both = np.isfinite(last_mm) & (foot_mm is not None)
        usual = known_cells(last_mm - (foot_mm or 0.0), LENGTH_SD_MM, LENGTH_SD_MM)
        room = room.where(lacking & both, usual)
        if not both[lacking].all():
            why = measure_difference(foot, lasts, "length", sentences)
            room = room.where(lacking & ~both, why)
    ours, theirs = shape_gain(foot, sentences), last_gain(lasts, sentences)
    gained = Cells(
        room.value + theirs.value - ours.value,
        np.hypot(room.foot_sd, ours.last_sd),
        np.hypot(room.last_sd, theirs.last_sd),
        room.reason,
    )
    gain = np.where(ours.reason == NO_WORD, theirs.reason, ours.reason)
    unknown = (room.reason == NO_WORD) & (gain != NO_WORD)
    gained = gained.where(unknown, replace(missing(len(lasts), NO_WORD), reason=gain))
    return gained.where(room.reason != NO_WORD, room)


def _ball_line(foot: ZoneShape, lasts: LastColumns, sentences: Words) -> Cells:
    """How much further forward the last's ball is, in mm along X.

    On a high heel that is not its place along the bottom: one last, bent from 0 to 80 mm of heel,
    moved it by up to 23 mm (decision 0210).
    """
    high_mm = ALONG_BOTTOM.raised_mm
    cells = measure_difference(foot, lasts, "ball_length", sentences)
    high = lasts.heel_height_mm > high_mm
    high |= (foot.measured_mm("heel_height") or 0.0) > high_mm
    if not high.any():
        return cells
    words = f"over {high_mm:g} mm of heel the ball's place along the bottom is unknown"
    return cells.where(high, missing(len(lasts), sentences.number(words)))


def ball_line_mm(ball_mm: Floats, room_mm: Floats, asked_mm: float | Floats) -> Floats:
    """How much further forward the last's ball is than the foot's, as far as the length does not
    explain it.

    A last that is longer than the toe room asked for has its ball further forward in proportion,
    and that is judged as length. A long toe with the ball in place is in place.
    """
    carried_mm = BALL_SHARE * (room_mm - asked_mm)
    explained_mm = np.clip(ball_mm, np.minimum(carried_mm, 0.0), np.maximum(carried_mm, 0.0))
    off_mm: Floats = ball_mm - explained_mm
    return off_mm


def _flare(foot: ZoneShape, lasts: LastColumns, _: Words) -> Cells:
    """The flare angles' difference."""
    delta = lasts.angle_deg - foot.flare.angle_deg
    return known_cells(delta, foot.flare.angle_sd_deg, lasts.angle_sd_deg)


def _plan(foot: ZoneShape, lasts: LastColumns, sentences: Words) -> Cells:
    """The root mean square of the plan curvatures' difference over the distance's stations."""
    ours, flare = foot.flare.curvature.get("plan"), lasts.flare
    assert flare is not None
    assert flare.plan is not None
    unknown = missing(len(lasts), sentences.number("the plan curve is not measurable"))
    if ours is None:
        return unknown
    there = flare.known[:, CHANNELS.index("plan")] & (lasts.stations == len(ours))
    if not there.any():
        return unknown
    part = inside(foot.flare.stations)
    rms = np.sqrt(np.square(flare.plan[:, part] - ours[part]).mean(axis=1))
    return unknown.where(there, known_cells(rms, PLAN_SD, PLAN_SD))


def _not_read(_: ZoneShape, lasts: LastColumns, sentences: Words) -> Cells:
    return missing(len(lasts), sentences.number(NOT_READ))


SPECIAL: dict[str, Callable[[ZoneShape, LastColumns, Words], Cells]] = {
    "length": _length,
    "ball_line": _ball_line,
    "flare": _flare,
    "plan": _plan,
    TOE_HEIGHT: _not_read,
    TOES: _not_read,
}
