"""The zones of a fit: where a foot and a last are compared, and how their clearance is taken.

A clearance is last minus foot. Most zones compare the measure of their own name; the others have
a function of their own. A new zone is a row of ``ZONES`` (and, where it compares no measure, a
function in ``_SPECIAL``); profile files may then name it. The directional clearance of the two
surfaces belongs here too, as zones that need both meshes: `clearances` is where they join.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.flare.flare_profile import DISTANCE
from footfit.geometry.numeric.arrays import Floats
from footfit.results import LastRecord, Measured, Profiled, ZoneRule

LENGTH_SD_MM = 0.5
"""Repeatability of an aligned length between two scans of one shape (docs/alignment.md)."""
PLAN_SD = DISTANCE.sd[CHANNELS.index("plan")]
HEEL_FROM_MM = 5.0
"""A heel height that says that a last is pitched; below, the correction is under 0.05 mm."""


@dataclass(frozen=True, slots=True)
class Zone:
    """One place of comparison: ``less`` and ``more`` say a clearance under and over the asked."""

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
class Taken:
    """One clearance with the spread that each side brings, or the reason why there is none."""

    value: float
    foot_sd: float = 0.0
    last_sd: float = 0.0
    reason: str | None = None

    @property
    def measured(self) -> Measured:
        """As a result."""
        if self.reason is not None:
            return Measured(None, reason=self.reason)
        return Measured(self.value, math.hypot(self.foot_sd, self.last_sd))


@dataclass(frozen=True, slots=True)
class Clearances:
    """The clearances of n lasts in z zones: ``values`` and ``last_sd`` (n, z), ``foot_sd`` (n, z).

    NaN where a clearance is not measured; ``reasons[i][j]`` then says why.
    """

    values: Floats
    foot_sd: Floats
    last_sd: Floats
    reasons: tuple[tuple[str | None, ...], ...]

    def measured(self, last: int, zone: int) -> Measured:
        """One clearance as a result."""
        taken = Taken(
            float(self.values[last, zone]),
            float(self.foot_sd[last, zone]),
            float(self.last_sd[last, zone]),
            self.reasons[last][zone],
        )
        return taken.measured


def clearances(
    foot: Profiled, lasts: Sequence[LastRecord], rules: Sequence[ZoneRule]
) -> Clearances:
    """The clearance of a foot in each of n lasts, in the zones of the rules."""
    measures = _by_name(foot.measures)
    one = ZoneShape(foot.aligned.alignment.extent_mm, foot.flare, measures, _heel_mm(measures))
    shapes = [zone_shape(last) for last in lasts]
    asked_mm = next((rule.target for rule in rules if rule.zone == "length"), 0.0)
    table = [[_taken(one, shape, rule, asked_mm) for rule in rules] for shape in shapes]
    values = np.array([[(t.value, t.foot_sd, t.last_sd) for t in row] for row in table])
    values = values.reshape(len(lasts), len(rules), 3)
    reasons = tuple(tuple(taken.reason for taken in row) for row in table)
    return Clearances(values[:, :, 0], values[:, :, 1], values[:, :, 2], reasons)


@dataclass(frozen=True, slots=True)
class ZoneShape:
    """What zones read of a foot or a last; shares of the length are of ``extent_mm``."""

    extent_mm: float
    flare: FlareProfile
    measures: Mapping[str, tuple[Measured, str]]
    heel_height_mm: float | None

    def measured_mm(self, name: str) -> float | None:
        """The value of a measure, by whichever definition; None where there is none."""
        return self.measures[name][0].value if name in self.measures else None


def zone_shape(last: LastRecord) -> ZoneShape:
    """What zones read of a last."""
    measures = _by_name(last.measures)
    heel = _heel_mm(measures)
    heel = last.labels.heel_height_mm if heel is None else heel
    return ZoneShape(last.extent_mm, last.flare, measures, heel)


def _heel_mm(measures: Mapping[str, tuple[Measured, str]]) -> float | None:
    """The measured heel height; a foot has none."""
    return measures["heel_height"][0].value if "heel_height" in measures else None


def _by_name(measures: Sequence[object]) -> dict[str, tuple[Measured, str]]:
    return {m.name: (m.measured, m.definition) for m in measures}  # type: ignore[attr-defined]


def _taken(foot: ZoneShape, last: ZoneShape, rule: ZoneRule, asked_mm: float) -> Taken:
    special = _SPECIAL.get(rule.zone)
    if rule.zone == "ball_line":
        taken = ball_line(foot, last, asked_mm)
    else:
        taken = special(foot, last) if special else _difference(foot, last, rule.zone)
    if taken.reason is not None:
        return taken
    return Taken(taken.value - rule.cavity, taken.foot_sd, taken.last_sd)


def _missing(reason: str) -> Taken:
    return Taken(float("nan"), reason=reason)


def _difference(foot: ZoneShape, last: ZoneShape, name: str) -> Taken:
    """The last's measure minus the foot's, if both have it and mean the same by it."""
    for who, shape in (("foot", foot), ("last", last)):
        if name not in shape.measures:
            return _missing(f"not measured on the {who}")
        if shape.measures[name][0].value is None:
            words = shape.measures[name][0].reason or "not measured"
            return _missing(f"the {who}: {words}")
    (one, meant), (other, also) = foot.measures[name], last.measures[name]
    if meant != also:
        return _missing("measured by another definition; type: footfit upgrade-catalogue")
    assert one.value is not None
    assert other.value is not None
    return Taken(other.value - one.value, one.sd or 0.0, other.sd or 0.0)


def _length(foot: ZoneShape, last: ZoneShape) -> Taken:
    """The toe room: functional lengths where both are measured, else lengths, along the bottom of
    the last. A last in the foot's place, as in a search by shape, is measured along its bottom too.
    """
    taken = _difference(foot, last, "functional_length")
    if taken.reason is not None:  # lengths of other versions differ by tenths of a mm
        foot_mm, last_mm = foot.measured_mm("length"), last.measured_mm("length")
        if foot_mm is None or last_mm is None:
            return _difference(foot, last, "length")
        taken = Taken(last_mm - foot_mm, LENGTH_SD_MM, LENGTH_SD_MM)
    gain = pitch_gain_mm(last) - pitch_gain_mm(foot)
    return Taken(taken.value + gain, taken.foot_sd, taken.last_sd)


def pitch_gain_mm(last: ZoneShape) -> float:
    """How much longer a pitched last is along its bottom than along X.

    The frame rests a last on its seat and its ball, so X is their chord; the forepart, which
    stands on the ground, rises from it by the pitch, whose sine is heel height over that chord.
    A foot of flat scan lies along the bottom: the forepart counts with its own length.
    """
    heel = last.heel_height_mm
    if heel is None or heel < HEEL_FROM_MM:
        return 0.0
    ball = last.measured_mm("ball_length")
    chord = BALL_SHARE * last.extent_mm if ball is None else ball
    sine = min(heel / chord, STEEPEST)
    return (last.extent_mm - chord) * (1.0 / math.sqrt(1.0 - sine * sine) - 1.0)


BALL_SHARE = 0.72
"""Where the ball lies over the length where it was not measured."""
STEEPEST = 0.6
"""The sine of the steepest pitch that is believed: a heel of 110 mm."""


def ball_line(foot: ZoneShape, last: ZoneShape, asked_mm: float) -> Taken:
    """How much further forward the last's ball is than the foot's, in % of the foot's length,
    beyond what its length explains.

    A last that is longer than the toe room asked for carries its ball forward in proportion; that
    is judged as length and not once more here. A long toe with the ball in place is in place.
    """
    taken, room = _difference(foot, last, "ball_length"), _length(foot, last)
    if taken.reason is not None or room.reason is not None:
        return taken if taken.reason is not None else room
    carried = BALL_SHARE * (room.value - asked_mm)
    explained = min(max(taken.value, min(carried, 0.0)), max(carried, 0.0))
    scale = 100.0 / foot.extent_mm
    return Taken((taken.value - explained) * scale, taken.foot_sd * scale, taken.last_sd * scale)


def _flare(foot: ZoneShape, last: ZoneShape) -> Taken:
    """The flare angles' difference."""
    delta = last.flare.angle_deg - foot.flare.angle_deg
    return Taken(delta, foot.flare.angle_sd_deg, last.flare.angle_sd_deg)


def _plan(foot: ZoneShape, last: ZoneShape) -> Taken:
    """The root mean square of the plan curvatures' difference over the distance's stations."""
    ours, theirs = foot.flare.curvature.get("plan"), last.flare.curvature.get("plan")
    if ours is None or theirs is None or len(ours) != len(theirs):
        return _missing("the plan curve is not measurable")
    low, high = DISTANCE.stations
    inside = (foot.flare.stations >= low) & (foot.flare.stations <= high)
    rms = float(np.sqrt(np.mean(np.square(theirs[inside] - ours[inside]))))
    return Taken(rms, PLAN_SD, PLAN_SD)


_SPECIAL: dict[str, Callable[[ZoneShape, ZoneShape], Taken]] = {
    "length": _length,
    "flare": _flare,
    "plan": _plan,
}
