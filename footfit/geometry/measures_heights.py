"""Heights over the plane the shape rests on: arch, instep, toes, and how a last stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.bottoms import BOTTOM, underside
from footfit.geometry.landmarks import Shape
from footfit.geometry.readings import OPEN, Reading, lacking


@dataclass(frozen=True, slots=True)
class HeightSettings:
    """Where heights are taken, over the length."""

    toe: float = 0.92
    toe_spring: float = 0.94


HEIGHTS = HeightSettings()
NO_SOLE = "the sole is open at the {place}"
FLAT = "measured on lasts: a foot stands flat"


def arch_height(shape: Shape) -> Reading:
    """The greatest height of the underside along the inner arch, a quarter of the width from the
    medial edge.
    """
    arch = underside(shape, BOTTOM.arch, BOTTOM.arch_places)
    if arch is None:
        return Reading(None, NO_SOLE.format(place="arch"))
    return Reading(float(arch.smooth(BOTTOM.bandwidth * shape.length_mm).z_mm.max()))


def instep_height(shape: Shape) -> Reading:
    """The top of the section at half the length, over the contact plane."""
    missing = lacking(shape, shape.at_instep, "instep")
    if missing is not None:
        return Reading(None, missing)
    return Reading(float(shape.instep[2]))


def toe_height(shape: Shape) -> Reading:
    """From the lowest to the highest point of the section at .92 of the length."""
    section = shape.across(HEIGHTS.toe)
    if shape.opened(section):
        return Reading(None, OPEN.format(place="toes"))
    return Reading(float(np.ptp(section.points[:, 1])))


def toe_spring(shape: Shape) -> Reading:
    """The lowest point of the section at .94 of the length, over the ground.

    A foot's ground is the contact plane, a last's the plane that its tread stands on.
    """
    ground, section = _tread(shape), shape.across(HEIGHTS.toe_spring)
    if ground is None or shape.opened(section):
        return Reading(None, NO_SOLE.format(place="toes or the ball"))
    return Reading(_over(ground, shape.x_mm(HEIGHTS.toe_spring), section.points[:, 1].min()))


def heel_height(shape: Shape) -> Reading:
    """How high a last's heel stands as its tread lies level: the seat's line at the pternion."""
    if shape.kind == "foot":
        return Reading(None, FLAT)
    ground, seat = _tread(shape), underside(shape, BOTTOM.seat, BOTTOM.middle_places)
    if ground is None or seat is None:
        return Reading(None, NO_SOLE.format(place="heel or the ball"))
    rear_mm, (slope, height_mm) = shape.x_mm(0.0), seat.line()
    return Reading(_over(ground, rear_mm, slope * rear_mm + height_mm))


def _tread(shape: Shape) -> tuple[float, float] | None:
    """The line of the ground under the tread: slope, and height at x = 0."""
    if shape.kind == "foot":
        return 0.0, 0.0
    tread = underside(shape, BOTTOM.tread, BOTTOM.middle_places)
    return None if tread is None else tread.line()


def _over(ground: tuple[float, float], x_mm: float, z_mm: float) -> float:
    """How far a point lies over the ground, square to the ground."""
    slope, height_mm = ground
    return float((z_mm - slope * x_mm - height_mm) / np.hypot(1.0, slope))
