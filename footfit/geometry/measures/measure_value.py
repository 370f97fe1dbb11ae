"""What a measurement gives: a number, or the reason why there is none."""

from __future__ import annotations

from typing import NamedTuple

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.outlines import Outline

OPEN = "the scan is open at the {place}"
CUT = "the leg is cut below the {place}"
SAWN = "the last is sawn off below the {place}"


class Reading(NamedTuple):
    """A measured value in mm, or the reason why there is none."""

    value: float | None
    reason: str | None = None


def lacking(shape: Shape, section: Outline, place: str, *, over_cone: bool = False) -> str | None:
    """Why a section at a place is no whole section of the foot or last; None where it is.

    ``over_cone``: a last's section may run over the top of its cone there.
    """
    if shape.opened(section):
        return OPEN.format(place=place)
    if shape.kind == "last" and over_cone:
        return None
    if shape.topped(section):
        return (CUT if shape.kind == "foot" else SAWN).format(place=place)
    return None
