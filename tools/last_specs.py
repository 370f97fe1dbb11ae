"""What a generated last is asked to be: lengths in mm, the flare in degrees, the toe by name."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Literal

import numpy as np

from tools.last_profiles import TOES

ToeShape = Literal["round", "almond", "square", "pointed"]


@dataclass(frozen=True, slots=True)
class LastSpec:
    """All that makes one last.

    Lengths are mm; ``None`` for a width takes the usual share of the length. ``flare_deg`` is
    the true flare angle: mean heading over stations .55-.80 minus mean heading over .08-.30,
    whatever the other fields are. ``rings`` are the sections from heel to toe, ``segments`` the
    corners of each: the mesh has about 2 x rings x segments faces.

    ``waist_cut_mm``, ``joint_bulge_mm`` and ``toe_turn_deg`` shape the planted centre line.
    ``arch_mm`` (the medial feather line's rise at the waist), ``arch_cut_mm`` (how far it goes
    in under the widest row), ``ridge_mm`` (the instep ridge's way to the medial side) and
    ``fullness`` (the forepart's thickness over the usual) do not.
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
        toe_shape=str(rng.choice(sorted(TOES))),  # type: ignore[arg-type]
        toe_turn_deg=rng.uniform(0.0, 8.0),
        waist_cut_mm=rng.uniform(0.0, 8.0),
        joint_bulge_mm=rng.uniform(0.0, 3.0),
        arch_mm=rng.uniform(1.0, 9.0),
        arch_cut_mm=rng.uniform(4.0, 16.0),
        ridge_mm=rng.uniform(4.0, 13.0),
    )
    return replace(drawn, **given)


def share(spec: LastSpec, name: str) -> float:
    """The length field ``name`` over the length."""
    value = getattr(spec, name)
    return SHARES[name] if value is None else float(value) / spec.length_mm
