"""The zones of a fit: where a foot and a last are compared, and how their clearance is taken.

A clearance is last minus foot. Most zones compare the measure of their own name; the others have
a function of their own. A new zone is a row of ``ZONES`` and, if it compares no measure, a function
in ``_SPECIAL``. Fit profiles may then name it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from footfit.geometry.fit.along_the_bottom import (
    ALONG_BOTTOM,
    LastLengths,
    length_along_bottom,
)
from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.flare.profile_distance import DISTANCE
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.fit.heels import Heels, full_change
from footfit.pipeline.fit.scoring import Column
from footfit.results import HeelModel, LastRecord, Measure, Measured, Profiled, ZoneRule
from footfit.results.fit import ZONE_LABELS
from footfit.results.heel import FLARE

LENGTH_SD_MM = 0.5
"""Repeatability of an aligned length between two scans of one shape (docs/alignment.md)."""
PLAN_SD = DISTANCE.sd[CHANNELS.index("plan")]
BALL_SHARE = 0.72
"""Where the ball lies, over the length, if it was not measured."""
OTHER_DEFINITION = "measured by another definition; type: footfit upgrade-catalogue"
LENGTHS = {field.name: measure_named(field.name).definition_id for field in fields(LastLengths)}
"""The measures that say how long a last is along its bottom, with their definitions."""

TOE_HEIGHT, TOES = "toe_height", "toes"
TOE_BOX = frozenset({TOE_HEIGHT, TOES})
"""Zones that are read from kept sections, once no other zone rejects the last."""
NOT_READ = "not looked at: another zone rejects the last"

HEEL_RULES = {"ball_line": "ball_length", "flare": FLARE}
"""Zones whose rule of the heel model has another name than the zone."""


@dataclass(frozen=True, slots=True)
class Zone:
    """One place of comparison; ``less`` and ``more`` are the words for what is off the target."""

    name: str
    unit: str
    less: str
    more: str

    @property
    def label(self) -> str:
        """The name as people read it."""
        return ZONE_LABELS[self.name]


NO_RULE = (0.0, (0.0, 0.0), (0.0, 0.0), None, 0.0, False, 0.0)
"""A rule that asks for nothing: no fit is judged."""
UNIT_KEYS = {"mm": "_mm", "deg": "_deg", "percent": "_percent", "ratio": ""}
"""What a profile's key ends in, by the zone's unit."""

ZONES: dict[str, Zone] = {
    zone.name: zone
    for zone in (
        Zone("length", "mm", "short", "long"),
        Zone("ball_line", "percent", "too far back", "too far forward"),
        Zone("ball_girth", "mm", "tighter", "looser"),
        Zone("ball_width", "mm", "narrower", "wider"),
        Zone("ball_width_orthogonal", "mm", "narrower", "wider"),
        Zone("waist_girth", "mm", "tighter", "looser"),
        Zone("instep_girth", "mm", "tighter", "looser"),
        Zone("short_heel_girth", "mm", "tighter", "looser"),
        Zone("long_heel_girth", "mm", "tighter", "looser"),
        Zone("heel_width", "mm", "narrower", "wider"),
        Zone(TOE_HEIGHT, "mm", "lower", "higher"),
        Zone(TOES, "mm", "tighter", "looser"),
        Zone("instep_height", "mm", "lower", "higher"),
        Zone("flare", "deg", "less inward", "more inward"),
        Zone("plan", "ratio", "nearer", "further"),
    )
}


Reasons = tuple[tuple[str | None, ...], ...]
"""Why clearances are not measured, or None where they are: a row for each last."""


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


@dataclass(frozen=True, slots=True)
class Clearances:
    """The clearances of n lasts in z columns: the last minus the foot as it is in the last's heel.

    ``value`` (n, z) is NaN where it is not measured; ``reasons`` (n rows) then say why. The spreads
    (n, z) are of the foot's scan, of the last, and of the heel model. The model's is - where the
    model is applied backwards: one error of the model moves all lasts at once.
    """

    value: Floats
    foot_sd: Floats
    last_sd: Floats
    heel_sd: Floats
    reasons: Reasons

    def measured(self, row: int, place: int) -> Measured:
        """One clearance as a result."""
        reason = self.reasons[row][place]
        if reason is not None:
            return Measured(None, reason=reason)
        spreads = (self.foot_sd, self.last_sd, self.heel_sd)
        sd = math.hypot(*(float(spread[row, place]) for spread in spreads))
        return Measured(float(self.value[row, place]), sd)

    def with_cells(self, cells: Mapping[tuple[int, int], Clearance]) -> Clearances:
        """The same with other clearances at some rows and columns."""
        names = ("value", "foot_sd", "last_sd", "heel_sd")
        arrays = {name: getattr(self, name).copy() for name in names}
        reasons = [list(row) for row in self.reasons]
        for (row, place), cell in cells.items():
            for name in names:
                arrays[name][row, place] = getattr(cell, name)
            reasons[row][place] = cell.reason
        return Clearances(**arrays, reasons=tuple(map(tuple, reasons)))


def clearances(
    feet: Sequence[Profiled], lasts: Sequence[LastRecord], columns: Sequence[Column], heels: Heels
) -> Clearances:
    """The clearance of each foot in each last: a row for each last, a column for each zone.

    The shapes are compared as they were measured. Then each column gets what the heels of the lasts
    change of the foot.
    """
    ours, theirs = [foot_shape(foot) for foot in feet], [last_shape(last) for last in lasts]
    zones = [(ours[column.foot], column.rule.zone) for column in columns]
    rows = [[_clearance(foot, last, zone) for foot, zone in zones] for last in theirs]
    numbers = np.array([[(c.value, c.foot_sd, c.last_sd) for c in row] for row in rows])
    value, foot_sd, last_sd = np.moveaxis(numbers.reshape(len(rows), len(columns), 3), 2, 0)
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
        if not is_length(column):
            value[heels.length_only, place] = np.nan
    value -= np.array([column.rule.cavity for column in columns])
    needed = [lengths[c.foot] if c.rule.zone == "ball_line" else i for i, c in enumerate(columns)]
    reasons = tuple(
        tuple(row[i].reason or row[j].reason for i, j in enumerate(needed)) for row in rows
    )
    return Clearances(value, foot_sd, last_sd, heel_sd, _with_length_only(reasons, columns, heels))


def toe_room(foot: Profiled, last: LastRecord, heels: Heels) -> Measured:
    """The toe room of one foot in one last, whose heel is the first of ``heels``: the zone "length"
    without a cavity.
    """
    room = _length(foot_shape(foot), last_shape(last))
    if room.reason is not None:
        return Measured(None, reason=room.reason)
    share = float(heels.share[0])
    change, sd = full_change(heels.question.model, foot, "length")
    spread = math.hypot(room.foot_sd, room.last_sd, share * sd)
    return Measured(room.value - share * change, spread)


def measured_clearances(
    foot: Profiled, last: LastRecord, heels: Heels
) -> tuple[tuple[str, Measured], ...]:
    """The clearance of one foot in every measure of a last, as a match gives it without a cavity;
    the last's heel is the first of ``heels``.
    """
    named = [zone.name for zone in ZONES.values() if zone.unit == "mm" and zone.name != "length"]
    names = [name for name in named if name not in TOE_BOX]
    columns = [Column(0, ZoneRule(name, *NO_RULE), counts=False) for name in names]
    room = clearances([foot], [last], columns, heels)
    return tuple((name, room.measured(0, place)) for place, name in enumerate(names))


def is_length(column: Column) -> bool:
    """Is this the column of a toe room?"""
    return column.rule.zone == "length"


def length_only_words(model: HeelModel) -> str:
    """Why girths are not judged in a heel that is higher than the heel model knows."""
    return f"over {model.largest_drop_mm:g} mm of drop only the length is judged"


def _with_length_only(reasons: Reasons, columns: Sequence[Column], heels: Heels) -> Reasons:
    """The reasons, with those of lasts whose heel is higher than the heel model knows."""
    model = heels.question.model
    if model is None or not heels.length_only.any():
        return reasons
    words = length_only_words(model)
    only = tuple(None if is_length(column) else words for column in columns)
    return tuple(
        tuple(first or second for first, second in zip(row, only, strict=True)) if over else row
        for row, over in zip(reasons, heels.length_only.tolist(), strict=True)
    )


@dataclass(frozen=True, slots=True)
class ZoneShape:
    """What zones read of a foot or a last; shares of the length are of ``extent_mm``."""

    extent_mm: float
    flare: FlareProfile
    measures: Mapping[str, Measure]
    labelled_heel_mm: float | None = None

    def measured_mm(self, name: str) -> float | None:
        """The value of a measure, by whichever definition; None where there is none."""
        return self.measures[name].measured.value if name in self.measures else None

    @property
    def heel_height_mm(self) -> float | None:
        """The heel height as measured, else as labelled; a foot has none."""
        measured_mm = self.measured_mm("heel_height")
        return self.labelled_heel_mm if measured_mm is None else measured_mm


def foot_shape(foot: Profiled) -> ZoneShape:
    """What zones read of a foot."""
    measures = {measure.name: measure for measure in foot.measures}
    return ZoneShape(foot.aligned.alignment.extent_mm, foot.flare, measures)


def last_shape(last: LastRecord) -> ZoneShape:
    """What zones read of a last."""
    measures = {measure.name: measure for measure in last.measures}
    return ZoneShape(last.extent_mm, last.flare, measures, last.labels.heel_height_mm)


def _clearance(foot: ZoneShape, last: ZoneShape, zone: str) -> Clearance:
    """The clearance in a zone, as both were measured; of the ball line that of the balls, in mm."""
    if zone in _SPECIAL:
        return _SPECIAL[zone](foot, last)
    return measure_difference(foot, last, zone)


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


_SPECIAL: dict[str, Callable[[ZoneShape, ZoneShape], Clearance]] = {
    "length": _length,
    "ball_line": _ball_line,
    "flare": _flare,
    "plan": _plan,
    TOE_HEIGHT: lambda _foot, _last: missing(NOT_READ),
    TOES: lambda _foot, _last: missing(NOT_READ),
}
