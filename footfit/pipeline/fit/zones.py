"""The zones of a fit: where a foot and a last are compared, and how their clearance is taken.

A clearance is last minus foot. Most zones compare the measure of their own name; the others have
a function of their own. A new zone is a row of ``ZONES`` and, if it compares no measure, a function
in ``_SPECIAL``. Fit profiles may then name it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.flare.profile_distance import DISTANCE
from footfit.pipeline.fit.scoring import Column
from footfit.results import LastRecord, Measure, Measured, Profiled, ZoneRule

LENGTH_SD_MM = 0.5
"""Repeatability of an aligned length between two scans of one shape (docs/alignment.md)."""
PLAN_SD = DISTANCE.sd[CHANNELS.index("plan")]
HEEL_FROM_MM = 5.0
"""From this heel height on a last is pitched; below, the correction is under 0.05 mm."""
BALL_SHARE = 0.72
"""Where the ball lies, over the length, if it was not measured."""
STEEPEST = 0.6
"""The sine of the steepest pitch that counts: a heel of 110 mm."""


@dataclass(frozen=True, slots=True)
class Zone:
    """One place of comparison; ``less`` and ``more`` are the words for what is off the target."""

    name: str
    label: str
    unit: str
    less: str
    more: str


UNIT_KEYS = {"mm": "_mm", "deg": "_deg", "percent": "_percent", "ratio": ""}
"""What a profile's key ends in, by the zone's unit."""

ZONES: dict[str, Zone] = {
    zone.name: zone
    for zone in (
        Zone("length", "toe room", "mm", "short", "long"),
        Zone("ball_line", "ball line", "percent", "too far back", "too far forward"),
        Zone("ball_girth", "ball girth", "mm", "tighter", "looser"),
        Zone("ball_width", "ball width", "mm", "narrower", "wider"),
        Zone("ball_width_orthogonal", "ball width across", "mm", "narrower", "wider"),
        Zone("waist_girth", "waist girth", "mm", "tighter", "looser"),
        Zone("instep_girth", "instep girth", "mm", "tighter", "looser"),
        Zone("short_heel_girth", "short heel girth", "mm", "tighter", "looser"),
        Zone("long_heel_girth", "long heel girth", "mm", "tighter", "looser"),
        Zone("heel_width", "heel width", "mm", "narrower", "wider"),
        Zone("toe_height", "toe height", "mm", "lower", "higher"),
        Zone("instep_height", "instep height", "mm", "lower", "higher"),
        Zone("flare", "flare", "deg", "less inward", "more inward"),
        Zone("plan", "plan curve", "ratio", "nearer", "further"),
    )
}


@dataclass(frozen=True, slots=True)
class Clearance:
    """The last minus the foot in one zone, with the spread that each of the two brings.

    ``value`` is NaN where it is not measured; ``reason`` then says why.
    """

    value: float
    foot_sd: float = 0.0
    last_sd: float = 0.0
    reason: str | None = None

    @property
    def measured(self) -> Measured:
        """The clearance as a result."""
        if self.reason is not None:
            return Measured(None, reason=self.reason)
        return Measured(self.value, math.hypot(self.foot_sd, self.last_sd))


def clearances(
    feet: Sequence[Profiled], lasts: Sequence[LastRecord], columns: Sequence[Column]
) -> tuple[tuple[Clearance, ...], ...]:
    """The clearance of each foot in each last: a row for each last, a clearance for each column."""
    ours, theirs = [foot_shape(foot) for foot in feet], [last_shape(last) for last in lasts]
    asked_mm = next((c.rule.target for c in columns if c.rule.zone == "length"), 0.0)
    return tuple(
        tuple(_clearance(ours[c.foot], last, c.rule, asked_mm) for c in columns) for last in theirs
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


def _clearance(foot: ZoneShape, last: ZoneShape, rule: ZoneRule, asked_mm: float) -> Clearance:
    """The clearance in the zone of a rule, without what the rule's cavity takes."""
    if rule.zone == "ball_line":
        clearance = ball_line(foot, last, asked_mm)
    elif rule.zone in _SPECIAL:
        clearance = _SPECIAL[rule.zone](foot, last)
    else:
        clearance = _difference(foot, last, rule.zone)
    return replace(clearance, value=clearance.value - rule.cavity) if rule.cavity else clearance


def _missing(reason: str) -> Clearance:
    return Clearance(math.nan, reason=reason)


def _difference(foot: ZoneShape, last: ZoneShape, name: str) -> Clearance:
    """The last's measure minus the foot's, if both have it and mean the same by it."""
    for kind, shape in (("foot", foot), ("last", last)):
        if name not in shape.measures:
            return _missing(f"not measured on the {kind}")
        if shape.measured_mm(name) is None:
            reason = shape.measures[name].measured.reason or "not measured"
            return _missing(f"the {kind}: {reason}")
    if foot.measures[name].definition != last.measures[name].definition:
        return _missing("measured by another definition; type: footfit upgrade-catalogue")
    ours, theirs = foot.measures[name].measured, last.measures[name].measured
    assert ours.value is not None
    assert theirs.value is not None
    return Clearance(theirs.value - ours.value, ours.sd or 0.0, theirs.sd or 0.0)


def _length(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """The toe room: functional lengths where both are measured, else lengths, along the bottom of
    the last. A last in the foot's place, as in a search by shape, is measured along its bottom too.
    """
    room = _difference(foot, last, "functional_length")
    if room.reason is not None:  # lengths of other versions differ by tenths of a mm
        foot_mm, last_mm = foot.measured_mm("length"), last.measured_mm("length")
        if foot_mm is None or last_mm is None:
            return _difference(foot, last, "length")
        room = Clearance(last_mm - foot_mm, LENGTH_SD_MM, LENGTH_SD_MM)
    return replace(room, value=room.value + pitch_gain_mm(last) - pitch_gain_mm(foot))


def pitch_gain_mm(last: ZoneShape) -> float:
    """How much longer a pitched last is along its bottom than along X.

    The frame rests a last on its seat and its ball, so X lies along their chord. The forepart
    stands on the ground and rises from that chord by the pitch, whose sine is the heel height over
    the chord. A foot that was scanned flat lies along the bottom, so the forepart counts with its
    own length.
    """
    heel = last.heel_height_mm
    if heel is None or heel < HEEL_FROM_MM:
        return 0.0
    ball = last.measured_mm("ball_length")
    chord = BALL_SHARE * last.extent_mm if ball is None else ball
    sine = min(heel / chord, STEEPEST)
    return (last.extent_mm - chord) * (1.0 / math.sqrt(1.0 - sine * sine) - 1.0)


def ball_line(foot: ZoneShape, last: ZoneShape, asked_mm: float) -> Clearance:
    """How much further forward the last's ball is than the foot's, in % of the foot's length.

    What the length explains is left out: a last that is longer than the toe room asked for has its
    ball further forward in proportion, and that is judged as length. A long toe with the ball in
    place is in place.
    """
    ball, room = _difference(foot, last, "ball_length"), _length(foot, last)
    if ball.reason is not None or room.reason is not None:
        return ball if ball.reason is not None else room
    carried = BALL_SHARE * (room.value - asked_mm)
    explained = min(max(ball.value, min(carried, 0.0)), max(carried, 0.0))
    scale = 100.0 / foot.extent_mm
    return Clearance((ball.value - explained) * scale, ball.foot_sd * scale, ball.last_sd * scale)


def _flare(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """The flare angles' difference."""
    delta = last.flare.angle_deg - foot.flare.angle_deg
    return Clearance(delta, foot.flare.angle_sd_deg, last.flare.angle_sd_deg)


def _plan(foot: ZoneShape, last: ZoneShape) -> Clearance:
    """The root mean square of the plan curvatures' difference over the distance's stations."""
    ours, theirs = foot.flare.curvature.get("plan"), last.flare.curvature.get("plan")
    if ours is None or theirs is None or len(ours) != len(theirs):
        return _missing("the plan curve is not measurable")
    low, high = DISTANCE.stations
    inside = (foot.flare.stations >= low) & (foot.flare.stations <= high)
    rms = float(np.sqrt(np.mean(np.square(theirs[inside] - ours[inside]))))
    return Clearance(rms, PLAN_SD, PLAN_SD)


_SPECIAL: dict[str, Callable[[ZoneShape, ZoneShape], Clearance]] = {
    "length": _length,
    "flare": _flare,
    "plan": _plan,
}
