"""What a measurement gives: a number, or the reason why there is none."""

from __future__ import annotations

from typing import NamedTuple

from footfit.geometry.landmarks import Shape
from footfit.geometry.outlines import Outline

OPEN = "the scan is open at the {place}"
CUT = "the leg is cut below the {place}"


class Reading(NamedTuple):
    """A measured value in mm, or the reason why there is none."""

    value: float | None
    reason: str | None = None


def lacking(shape: Shape, section: Outline, place: str) -> str | None:
    """Why a section at a place is no whole section of the foot or last; None where it is."""
    if shape.opened(section):
        return OPEN.format(place=place)
    if shape.kind == "foot" and shape.topped(section):
        return CUT.format(place=place)
    return None
