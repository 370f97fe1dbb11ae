"""How a last stands: its heel height and its toe spring as a pair, and what each cue says."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.results.values import Part


@dataclass(frozen=True, slots=True)
class GroundCue(Part):
    """The ground by one cue, from the resting plane, in degrees; + raises the heel.

    ``name`` is "tread", "bottom", "seat", "shape" or "label", of two labels also "heel_label" and
    "spring_label"; see ``docs/stance.md``.
    """

    name: str
    ground_deg: float
    sd_deg: float


@dataclass(frozen=True, slots=True)
class LastStance(Part):
    """How a last stands.

    Heel height and toe spring (mm) are the measures of that name, each with its total standard
    deviation. They are known as a pair only: a last that rocks about its tread gains
    ``spring_per_heel`` of toe spring for each mm of heel. ``decided_by`` is "label" or "shape". A
    height is None where the bottom is open.
    """

    decided_by: str
    ground_deg: float
    ground_sd_deg: float
    length_mm: float
    heel_height_mm: float | None
    heel_height_sd_mm: float | None
    toe_spring_mm: float | None
    toe_spring_sd_mm: float | None
    toe_spring_tip_mm: float | None
    toe_spring_tip_sd_mm: float | None
    spring_per_heel: float
    cues: tuple[GroundCue, ...]
