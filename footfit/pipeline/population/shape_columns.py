"""What zones read of many feet or lasts, a column for each number, and their clearances.

`clearances_of` gives what `zones.clearances` gives, for all pairs of feet and lasts at once: a
match and the coverage of a population have one verdict. A property test holds the two together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from footfit.geometry.fit.along_the_bottom import ALONG_BOTTOM
from footfit.geometry.flare.profile_distance import DISTANCE
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.fit.heels import Heels, rule_of
from footfit.pipeline.fit.judging.bottom_gains import bottom_gain
from footfit.pipeline.fit.judging.cells import ZoneShape
from footfit.pipeline.fit.judging.clearances import PLAN_SD, ball_line_mm
from footfit.pipeline.fit.zones import HEEL_RULES, TOE_BOX
from footfit.pipeline.shelf.nearness import LENGTH_SD_MM
from footfit.results.heel import FLARE

ROOM = "functional_length"
"""The measure that the toe room compares first."""
_CODES: dict[str, int] = {}


@dataclass(frozen=True, slots=True)
class MeasureColumn:
    """One measure of n shapes, (n,) each; ``value`` is NaN where there is none.

    ``definition`` is a code for what it was measured by: two values with one code mean the same.
    """

    value: Floats
    sd: Floats
    definition: Ints


@dataclass(frozen=True, slots=True)
class ShapeColumns:
    """What zones read of n feet or lasts, (n,) each; NaN where it is not known.

    ``plan`` (n, s) are plan curvatures at the stations that a difference counts. ``gain_mm`` is how
    much longer a last is along its bottom than along its resting plane, 0 of a foot.
    """

    extent_mm: Floats
    measures: Mapping[str, MeasureColumn]
    flare_deg: Floats
    flare_sd_deg: Floats
    plan: Floats
    heel_mm: Floats
    gain_mm: Floats
    gain_sd_mm: Floats

    def __len__(self) -> int:
        return len(self.extent_mm)

    def value_of(self, measure: str) -> Floats:
        """The values of a measure; all NaN if no shape has it."""
        column = self.measures.get(measure)
        return np.full(len(self), np.nan) if column is None else column.value

    def part(self, rows: slice | Ints) -> ShapeColumns:
        """The same of some shapes."""
        measures = {
            name: MeasureColumn(*(getattr(column, f.name)[rows] for f in fields(column)))
            for name, column in self.measures.items()
        }
        others = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "measures"}
        return ShapeColumns(measures=measures, **{k: v[rows] for k, v in others.items()})


def definition_code(definition: str) -> int:
    """A number for a definition: the same for the same text, while this process runs."""
    return _CODES.setdefault(definition, len(_CODES))


def shape_columns(shapes: Sequence[ZoneShape], names: Iterable[str]) -> ShapeColumns:
    """What zones read of shapes, with the measures of these names."""
    gains = [bottom_gain(shape) for shape in shapes]
    flares = [shape.flare for shape in shapes]
    heels_mm = [shape.heel_height_mm for shape in shapes]
    return ShapeColumns(
        extent_mm=np.array([shape.extent_mm for shape in shapes]),
        measures={name: _measure_column(name, shapes) for name in names},
        flare_deg=np.array([flare.angle_deg for flare in flares]),
        flare_sd_deg=np.array([flare.angle_sd_deg for flare in flares]),
        plan=_plans(shapes),
        heel_mm=np.array([np.nan if mm is None else mm for mm in heels_mm]),
        gain_mm=np.array([gain_mm for gain_mm, _ in gains]),
        gain_sd_mm=np.array([sd_mm for _, sd_mm in gains]),
    )


def _measure_column(name: str, shapes: Sequence[ZoneShape]) -> MeasureColumn:
    value, sd = np.full(len(shapes), np.nan), np.zeros(len(shapes))
    definition = np.full(len(shapes), -1, dtype=np.int64)
    for row, shape in enumerate(shapes):
        measure = shape.measures.get(name)
        if measure is not None and measure.measured.value is not None:
            value[row], sd[row] = measure.measured.value, measure.measured.sd or 0.0
            definition[row] = definition_code(measure.definition)
    return MeasureColumn(value, sd, definition)


def _plans(shapes: Sequence[ZoneShape]) -> Floats:
    """Plan curvatures at the stations that count, NaN where there are none."""
    low, high = DISTANCE.stations
    plans = [
        None
        if (plan := shape.flare.curvature.get("plan")) is None
        else plan[(shape.flare.stations >= low) & (shape.flare.stations <= high)]
        for shape in shapes
    ]
    most = max((len(plan) for plan in plans if plan is not None), default=0)
    columns = np.full((len(shapes), most), np.nan)
    for row, plan in enumerate(plans):
        if plan is not None and len(plan) == most:
            columns[row] = plan
    return columns


@dataclass(frozen=True, slots=True)
class PairClearances:
    """The clearances (f, n, z) of f feet in n lasts, NaN where they are not measured, and the
    standard deviations of all that they come from.
    """

    value: Floats
    sd: Floats


def clearances_of(
    feet: ShapeColumns,
    lasts: ShapeColumns,
    heels: Heels,
    zones: Sequence[str],
    cavity: Floats,
    asked_room_mm: Floats,
) -> PairClearances:
    """The clearance of f feet in n lasts, in z zones; the toe box is not among what is read here.

    Parameters
    ----------
    feet, lasts : ShapeColumns
    heels : Heels
        Of the lasts.
    zones : sequence of str
        With "length" among them.
    cavity : (z,)
        What lining, insole and counter take in each zone.
    asked_room_mm : (f,)
        The target of each foot's toe room.
    """
    value = np.full((len(feet), len(lasts), len(zones)), np.nan)
    variance = np.zeros_like(value)
    order = sorted(range(len(zones)), key=lambda place: zones[place] == "ball_line")
    room_mm = np.full(value.shape[:2], np.nan)
    for place in order:  # the ball line comes last: it needs the toe room
        zone = zones[place]
        if zone in TOE_BOX:
            continue
        cell, spread = _zone_pairs(feet, lasts, zone)
        change, sd = _full_changes(heels, feet, HEEL_RULES.get(zone, zone))
        cell = cell - heels.share * change[:, None]
        spread = spread + np.square(heels.share * sd[:, None])
        if zone == "length":
            room_mm = cell
        else:
            cell = np.where(heels.length_only, np.nan, cell)
        if zone == "ball_line":
            scale = (100.0 / feet.extent_mm)[:, None]
            cell = scale * ball_line_mm(cell, room_mm, asked_room_mm[:, None])
            spread = spread * np.square(scale)
        value[:, :, place] = cell - cavity[place]
        variance[:, :, place] = spread
    return PairClearances(value, np.sqrt(variance))


def _zone_pairs(feet: ShapeColumns, lasts: ShapeColumns, zone: str) -> tuple[Floats, Floats]:
    """The clearances of a zone (f, n) as both were measured, and their variances."""
    if zone == "length":
        return _room_pairs(feet, lasts)
    if zone == "flare":
        variance = np.square(feet.flare_sd_deg)[:, None] + np.square(lasts.flare_sd_deg)
        return lasts.flare_deg - feet.flare_deg[:, None], variance
    if zone == "plan":
        return _plan_pairs(feet, lasts)
    if zone == "ball_line":
        value, variance = _measure_pairs(feet, lasts, "ball_length")
        high = [np.nan_to_num(each.heel_mm) > ALONG_BOTTOM.raised_mm for each in (feet, lasts)]
        return np.where(high[0][:, None] | high[1], np.nan, value), variance
    return _measure_pairs(feet, lasts, zone)


def _measure_pairs(feet: ShapeColumns, lasts: ShapeColumns, name: str) -> tuple[Floats, Floats]:
    """The lasts' measure minus the feet's, where both mean the same by it."""
    ours, theirs = feet.measures.get(name), lasts.measures.get(name)
    if ours is None or theirs is None:
        shape = len(feet), len(lasts)
        return np.full(shape, np.nan), np.zeros(shape)
    same = ours.definition[:, None] == theirs.definition
    value = np.where(same, theirs.value - ours.value[:, None], np.nan)
    return value, np.square(ours.sd)[:, None] + np.square(theirs.sd)


def _room_pairs(feet: ShapeColumns, lasts: ShapeColumns) -> tuple[Floats, Floats]:
    """The toe rooms: functional lengths, else lengths, along the bottoms of the lasts."""
    value, variance = _measure_pairs(feet, lasts, ROOM)
    plain = lasts.value_of("length") - feet.value_of("length")[:, None]
    other = np.isnan(value)
    value = np.where(other, plain, value)
    variance = np.where(other, 2.0 * LENGTH_SD_MM**2, variance)
    value = value + lasts.gain_mm - feet.gain_mm[:, None]
    return value, variance + np.square(lasts.gain_sd_mm) + np.square(feet.gain_sd_mm)[:, None]


def _plan_pairs(feet: ShapeColumns, lasts: ShapeColumns) -> tuple[Floats, Floats]:
    """The root mean squares of the plan curvatures' differences."""
    shape = len(feet), len(lasts)
    value = np.full(shape, np.nan)
    if feet.plan.shape[1] == lasts.plan.shape[1] > 0:
        for row in np.flatnonzero(np.isfinite(feet.plan).all(axis=1)):
            value[row] = np.sqrt(np.mean(np.square(lasts.plan - feet.plan[row]), axis=1))
    return value, np.full(shape, 2.0 * PLAN_SD**2)


def _full_changes(heels: Heels, feet: ShapeColumns, measure: str) -> tuple[Floats, Floats]:
    """How a measure of each foot changes at the model's full drop; see `full_change`."""
    rule = rule_of(heels.question.model, measure)
    size = np.ones(len(feet)) if measure == FLARE else np.nan_to_num(feet.value_of(measure))
    return rule.change * size, rule.sd * size
