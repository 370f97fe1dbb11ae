"""What a measurement gives: a number, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.tape import CUTS
from footfit.geometry.mesh.outlines import Outline
from footfit.geometry.numeric.arrays import Floats

NO_BALL = "the scan shows no joint at the ball"
OPEN = "the scan is open at the {place}"
CUT = "the leg is cut below the {place}"
BLOCKED = "the forepart is in the tape's way"
UNSCANNED = "this part was not scanned"
CUT_OUT = "a cut took away what the tape would touch"
SAWN = "the last is sawn off below the {place}"


class MeasureValue(NamedTuple):
    """A value in mm, or the reason why there is none.

    ``convention_sd`` is how much the value would vary with what this very shape leaves open, such
    as the ground that a last stands on. It is no repeatability. ``sd`` is the repeatability, where
    it depends on the shape: where a flat tread ends is less sure than where a crisp one does.
    ``tilt_mm`` is how much the value changes if a last lies on seat and tread instead of on its
    sole plane.
    """

    value: float | None
    reason: str | None = None
    convention_sd: float = 0.0
    sd: float | None = None
    tilt_mm: float = 0.0


def no_ball(shape: Shape) -> MeasureValue:
    """What is said of a shape on which a joint of the ball is not found."""
    return MeasureValue(None, UNSCANNED if shape.filled.any() else NO_BALL)


def lacking(shape: Shape, section: Outline, place: str, *, over_cone: bool = False) -> str | None:
    """Why a section at a place is not a whole section of the foot or last; None if it is whole.

    ``over_cone``: a last's section may run over the top of its cone there.
    """
    if shape.opened(section):
        return OPEN.format(place=place)
    if shape.unscanned(section):
        return UNSCANNED
    if section.bridged_mm > CUTS.far * shape.length_mm:
        return CUT_OUT
    if shape.kind == "last" and over_cone:
        return None
    if shape.topped(section):
        return (CUT if shape.kind == "foot" else SAWN).format(place=place)
    return None


def section_value(
    shape: Shape,
    section: Outline,
    place: str,
    size: Callable[[Floats], float],
    *,
    over_cone: bool = False,
) -> MeasureValue:
    """A size (mm) of a whole section's points (n, 2), or what the section lacks."""
    reason = lacking(shape, section, place, over_cone=over_cone)
    if reason is not None:
        return MeasureValue(None, reason)
    return MeasureValue(float(size(section.points)))
