"""What a generated last is asked to be: lengths in mm, the flare in degrees, the toe by name."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Literal

import numpy as np

from tools.last_profiles import TOES

ToeShape = Literal["round", "almond", "square", "pointed", "oblique"]
Style = Literal["shoe", "pump", "boot", "sandal", "child"]
STYLES: tuple[Style, ...] = ("shoe", "pump", "boot", "sandal", "child")


@dataclass(frozen=True, slots=True)
class LastSpec:
    """All that makes one last.

    Lengths are mm; ``None`` for a width takes the usual share of the length. ``flare_deg`` is
    the true flare angle: mean heading over stations .55-.80 minus mean heading over .08-.30,
    whatever the other fields are. ``rings`` are the sections from heel to toe, ``segments`` the
    corners of each: the mesh has about 2 x rings x segments faces.

    ``waist_cut_mm``, ``joint_bulge_mm`` and ``toe_turn_deg`` shape the planted centre line.
    ``arch_mm`` (the medial feather line's rise at the waist), ``arch_cut_mm`` (how far it goes
    in under the widest row), ``ridge_mm`` (the instep ridge's way to the medial side),
    ``fullness`` (the forepart's thickness over the usual), ``medial_wall`` (0: at the instep both
    walls lean alike, 1: the medial one stays upright), ``feather_inset`` (how far the feather line
    lies inside the widest row, over the half width) and ``sole_crown`` (the sole's bulge over the
    usual) do not.

    The side view: ``seat_pitch`` is the slope of the seat over the mean slope from seat to tread
    (0: the seat is level), ``break_station`` is where the shank meets the tread and
    ``break_length`` over which length it turns (short: a crisp break), ``spring_station`` where the
    toe spring begins. ``shaft_mm`` is the height of a boot's shaft over the seat, 0 for none;
    ``cone_width`` is the width of the cone over the width below it. With ``level_tread`` the arch
    and the hollow of the shank end before the tread, which then lies level: only so is the
    drafted stance the true one. With ``bent_standing`` the plan is bent as the last stands, so
    that seat and tread are level across there; else it is bent as the last rests.
    """

    length_mm: float = 270.0
    ball_width_mm: float | None = None
    heel_width_mm: float | None = None
    waist_width_mm: float | None = None
    heel_height_mm: float = 25.0
    toe_spring_mm: float = 12.0
    flare_deg: float = 8.0
    toe_shape: ToeShape = "round"
    toe_turn_deg: float = 5.0
    waist_cut_mm: float = 5.0
    joint_bulge_mm: float = 2.5
    mt1_station: float = 0.72
    mt5_station: float = 0.62
    arch_mm: float = 5.0
    arch_cut_mm: float = 13.0
    ridge_mm: float = 9.0
    cone_height_mm: float | None = None
    cone_length: float = 0.34
    fullness: float = 1.0
    seat_pitch: float = 0.55
    break_station: float = 0.66
    break_length: float = 0.18
    spring_station: float = 0.67
    shaft_mm: float = 0.0
    cone_width: float = 0.31
    level_tread: bool = False
    bent_standing: bool = False
    medial_wall: float = 0.0
    feather_inset: float = 0.10
    sole_crown: float = 1.0
    side: Literal["left", "right"] = "right"
    rings: int = 160
    segments: int = 110


SHARES = {  # of the length, where the spec says None
    "ball_width_mm": 0.365,
    "heel_width_mm": 0.250,
    "waist_width_mm": 0.272,
    "cone_height_mm": 0.345,
}


def plain(spec: LastSpec) -> LastSpec:
    """The same last with one smooth bend: no waist cut, no joint bulge, no turn of the toe."""
    return replace(spec, waist_cut_mm=0.0, joint_bulge_mm=0.0, toe_turn_deg=0.0)


def graded(spec: LastSpec, length_mm: float) -> LastSpec:
    """The same last in another length: every length in mm grows alike, so no ratio changes."""
    ratio = length_mm / spec.length_mm
    names = [f.name for f in fields(spec) if f.name.endswith("_mm")]
    values = {name: getattr(spec, name) for name in names}
    return replace(spec, **{name: v * ratio for name, v in values.items() if v is not None})


def varied(rng: np.random.Generator, **given: Any) -> LastSpec:
    """A plausible right last drawn at random; fields in ``given`` are taken as they are.

    Flare -8 to 18 degrees, heel 0-60 mm, all toes, with and without waist cut, joint bulge,
    ridge and arch.
    """
    length_mm = rng.uniform(225.0, 305.0)
    heel_mm = rng.uniform(0.0, 60.0)
    drawn = LastSpec(
        length_mm=length_mm,
        ball_width_mm=length_mm * rng.uniform(0.34, 0.39),
        heel_width_mm=length_mm * rng.uniform(0.235, 0.265),
        heel_height_mm=heel_mm,
        toe_spring_mm=rng.uniform(6.0, 16.0) * (1.0 - heel_mm / 120.0),
        flare_deg=rng.uniform(-8.0, 18.0),
        toe_shape=str(rng.choice(sorted(TOES))),
        toe_turn_deg=rng.uniform(0.0, 8.0),
        waist_cut_mm=rng.uniform(0.0, 8.0),
        joint_bulge_mm=rng.uniform(0.0, 3.0),
        arch_mm=rng.uniform(1.0, 9.0),
        arch_cut_mm=rng.uniform(4.0, 16.0),
        ridge_mm=rng.uniform(4.0, 13.0),
    )
    return replace(drawn, **given)


HEEL_BANDS_MM = ((0.0, 30.0), (30.0, 60.0), (60.0, 90.0), (90.0, 120.0))
_LENGTHS_MM = {  # by style: a child's from 110 mm, a man's size 48 has about 330
    "shoe": (225.0, 330.0),
    "pump": (220.0, 280.0),
    "boot": (225.0, 320.0),
    "sandal": (220.0, 310.0),
    "child": (118.0, 215.0),
}
_HEEL_PER_LENGTH = 0.44  # a higher heel than this share of the length is no last's


def wide(
    rng: np.random.Generator, style: Style, heel_mm: tuple[float, float], **given: Any
) -> LastSpec:
    """A last of one style and heel band, from a wider range than :func:`varied` draws from.

    Crisp and soft breaks, level and pitched seats, low cones, shafts, oblique toes, small
    children to men's 48. The heel is not higher than .44 of the length, and a child's not higher
    than .10.

    Parameters
    ----------
    rng : numpy.random.Generator
    style : Style
    heel_mm : (2,)
        The band that the drafted heel is drawn from.
    """
    length_mm = float(given.get("length_mm", rng.uniform(*_LENGTHS_MM[style])))
    most = (0.10 if style == "child" else _HEEL_PER_LENGTH) * length_mm
    heel = min(float(rng.uniform(*heel_mm)), most)
    steep = heel / length_mm
    toe = str(rng.choice(sorted(TOES)))
    break_station = rng.uniform(0.60, 0.67)
    drawn = LastSpec(
        length_mm=length_mm,
        ball_width_mm=length_mm * rng.uniform(0.34, 0.40) * (1.06 if style == "child" else 1.0),
        heel_width_mm=length_mm * rng.uniform(0.235, 0.265),
        heel_height_mm=heel,
        toe_spring_mm=rng.uniform(2.0, 16.0) * (1.0 - 1.2 * steep) * length_mm / 270.0,
        flare_deg=rng.uniform(-6.0, 16.0),
        toe_shape=toe,
        toe_turn_deg=rng.uniform(10.0, 16.0) if toe == "oblique" else rng.uniform(0.0, 8.0),
        waist_cut_mm=rng.uniform(0.0, 8.0) * length_mm / 270.0,
        joint_bulge_mm=rng.uniform(0.0, 3.0) * length_mm / 270.0,
        mt1_station=rng.uniform(0.66, 0.72),
        mt5_station=rng.uniform(0.60, 0.64),
        arch_mm=rng.uniform(1.0, 9.0) * length_mm / 270.0,
        arch_cut_mm=rng.uniform(4.0, 16.0) * length_mm / 270.0,
        ridge_mm=rng.uniform(4.0, 13.0) * length_mm / 270.0,
        seat_pitch=rng.uniform(0.0, 0.7) * (1.0 - steep),
        break_station=break_station,
        break_length=rng.uniform(0.05, 0.22),
        spring_station=break_station + rng.uniform(0.02, 0.11),
        cone_height_mm=length_mm
        * rng.uniform(*((0.20, 0.28) if style == "pump" else (0.29, 0.37))),
        cone_width=rng.uniform(0.26, 0.36),
        level_tread=True,
        bent_standing=True,
        shaft_mm=length_mm * rng.uniform(0.50, 0.95) if style == "boot" else 0.0,
        fullness=rng.uniform(0.85, 0.95) if style == "sandal" else rng.uniform(0.92, 1.1),
    )
    return replace(drawn, **given)


def share(spec: LastSpec, name: str) -> float:
    """The length field ``name`` over the length."""
    value = getattr(spec, name)
    return SHARES[name] if value is None else float(value) / spec.length_mm
