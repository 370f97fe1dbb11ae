"""How socks, insoles, load and time of day shift what is asked of a clearance.

They never rewrite the foot's measures. A sock of the thickness t needs 2 pi t of girth, exactly for
a convex section, and 2 t of width, length and height. An insole needs 1.75 t of girth (between 2
for upright walls and 1.5 for walls that lean outward from the sole) and t of height. Load and time
of day are shares of the foot's own measure; they bring it to a foot that stands on both feet in the
evening.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace

from footfit.errors import BadOption
from footfit.results import FitProfile, Measure, Measured, Profiled, Worn, ZoneRule
from footfit.results.worn import BAREFOOT, Load

GIRTHS = ("ball_girth", "waist_girth", "instep_girth", "short_heel_girth", "long_heel_girth")
KINDS = {
    "length": "length",
    **dict.fromkeys(GIRTHS, "girth"),
    **dict.fromkeys(("ball_width", "ball_width_orthogonal"), "width"),
    "heel_width": "heel_width",
    **dict.fromkeys(("toe_height", "instep_height"), "height"),
    "toes": "wall",
}
"""What each zone measures, where something that is worn or a load changes it."""
INSOLE_GIRTH = (1.75, 0.25 / math.sqrt(3.0))
"""How much girth an insole takes over its thickness, and its standard deviation: 1.5 to 2."""
LARGEST_MM = {"sock_mm": 10.0, "insole_mm": 15.0, "heel_lift_mm": 40.0, "scanned_in_sock_mm": 10.0}


@dataclass(frozen=True, slots=True)
class LoadChange:
    """How much larger a measure is at half load, as a share, and the standard deviation of that."""

    length: tuple[float, float]
    width: tuple[float, float]
    heel_width: tuple[float, float]
    girth: tuple[float, float]


TO_HALF_LOAD: dict[Load, LoadChange] = {
    "air": LoadChange((0.015, 0.007), (0.03, 0.02), (0.06, 0.04), (0.02, 0.015)),
    "sitting": LoadChange((0.0075, 0.014), (0.015, 0.04), (0.03, 0.08), (0.01, 0.03)),
    "half": LoadChange((0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)),
    "full": LoadChange((-0.003, 0.003), (-0.02, 0.02), (-0.02, 0.02), (-0.005, 0.01)),
}
"""Changes to half load by the load of the scan: an opinion (grade C), as studies differ."""
MORNING_GIRTH = (0.01, 0.01)
"""How much a morning foot's girths grow until the evening, and the standard deviation of that."""


@dataclass(frozen=True, slots=True)
class Shift:
    """By how much more is asked of a zone in its unit, and the standard deviation of that."""

    more: float = 0.0
    sd: float = 0.0


def check_worn(worn: Worn) -> None:
    """Refuse a thickness that nobody wears.

    Raises
    ------
    BadOption
        A thickness is negative or too large.
    """
    for name, most in LARGEST_MM.items():
        value = getattr(worn, name)
        if value is not None and not 0.0 <= value <= most:
            option = "--" + name.removesuffix("_mm").replace("_", "-")
            raise BadOption(f"{option} takes 0 to {most:g} mm, not {value:g}")


def zone_shift(zone: str, foot_mm: float | None, worn: Worn) -> Shift:
    """How the clearance that is asked of a zone shifts, for a foot with this measure there.

    Examples
    --------
    >>> round(zone_shift("ball_girth", 240.0, Worn(sock_mm=1.0, load="half")).more, 2)
    6.28
    """
    sock, insole = worn.more_sock_mm, worn.insole_mm or 0.0
    thickness_mm = {
        **dict.fromkeys(("length", "width", "heel_width"), 2.0 * sock),
        "height": 2.0 * sock + insole,
        "girth": 2.0 * math.pi * sock + INSOLE_GIRTH[0] * insole,
        "wall": sock,
    }
    kind = KINDS.get(zone, "")
    thickness = thickness_mm.get(kind, 0.0)
    insole_sd = INSOLE_GIRTH[1] * insole if kind == "girth" else 0.0
    if foot_mm is None:
        return Shift(thickness, insole_sd)
    loaded = _load_change(kind, worn.load)
    day = MORNING_GIRTH if kind == "girth" and worn.time != "evening" else (0.0, 0.0)
    grown = day[0] if worn.time == "morning" else 0.0
    sd = math.hypot(foot_mm * math.hypot(loaded[1], day[1]), insole_sd)
    return Shift(thickness + foot_mm * (loaded[0] + grown), sd)


def _load_change(kind: str, load: Load | None) -> tuple[float, float]:
    """The share by which the foot's measure grows until half load; unknown load is only unsure."""
    share, sd = getattr(TO_HALF_LOAD[load or "sitting"], kind, (0.0, 0.0))
    return (0.0 if load is None else share), sd


def shifted_rule(rule: ZoneRule, shift: Shift) -> ZoneRule:
    """A rule that asks for so much more, in tenths: people read these numbers."""
    more = round(shift.more, 1)
    if more == 0.0:
        return rule

    def moved(ends: tuple[float, float]) -> tuple[float, float]:
        return round(ends[0] + more, 1), round(ends[1] + more, 1)

    return replace(
        rule,
        target=round(rule.target + more, 1),
        good=moved(rule.good),
        acceptable=moved(rule.acceptable),
        poor=None if rule.poor is None else moved(rule.poor),
    )


def measure_of(zone: str) -> str:
    """The measure that a zone compares: the toe room is that of the functional length."""
    return "functional_length" if zone == "length" else zone


def with_total(
    clearance: Measured, zone: str, measures: Iterable[Sequence[Measure]], more_sd: float
) -> Measured:
    """A clearance whose ``total_sd`` holds the trueness of both measures, and ``more_sd``.

    It has none where the zone compares no measure of its own name.
    """
    name = measure_of(zone)
    parts = [m.measured for of_shape in measures for m in of_shape if m.name == name]
    totals = [part.total_sd for part in parts]
    if clearance.sd is None or not parts or None in totals:
        return clearance
    trueness = sum((p.total_sd or 0.0) ** 2 - (p.sd or 0.0) ** 2 for p in parts)
    total = math.sqrt(clearance.sd**2 + max(trueness, 0.0) + more_sd**2)
    return replace(clearance, total_sd=total)


def with_unknown_load(
    clearance: Measured, zone: str, measures: tuple[Sequence[Measure], Sequence[Measure]]
) -> Measured:
    """A clearance with its ``total_sd``, if nobody says how the foot was loaded, and when."""
    name = measure_of(zone)
    own = next((m.measured.value for m in measures[0] if m.name == name), None)
    return with_total(clearance, zone, measures, zone_shift(zone, own, BAREFOOT).sd)


def shifts_of(foot: Profiled, profile: FitProfile, worn: Worn) -> dict[str, Shift]:
    """The shift of each zone of a profile for one foot."""
    measures = {measure.name: measure.measured.value for measure in foot.measures}
    measures["length"] = measures.get(measure_of("length")) or measures.get("length")
    return {r.zone: zone_shift(r.zone, measures.get(r.zone), worn) for r in profile.zones}


def worn_with(profile: FitProfile, asked: Worn = BAREFOOT) -> Worn:
    """What is worn: as asked, else as the profile has it."""
    own = profile.worn
    said = {known.name: getattr(asked, known.name) for known in fields(Worn)}
    return Worn(**{n: getattr(own, n) if value is None else value for n, value in said.items()})
