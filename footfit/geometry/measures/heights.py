"""Heights over the plane the shape rests on: arch, instep, toes, and how a last stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import OPEN, Reading, lacking
from footfit.geometry.measures.stance import Ground, stance
from footfit.geometry.measures.underside import BOTTOM, underside


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

    A foot's ground is the contact plane, a last's the ground that it stands on.
    """
    ground, section = _ground(shape), shape.across(HEIGHTS.toe_spring)
    if ground is None or shape.opened(section):
        return Reading(None, NO_SOLE.format(place="toes or the ball"))
    return Reading(ground.under_mm(shape.x_mm(HEIGHTS.toe_spring), section.points[:, 1].min()))


def heel_height(shape: Shape) -> Reading:
    """How high a last's heel stands as its tread lies level: the seat's line at the pternion."""
    if shape.kind == "foot":
        return Reading(None, FLAT)
    standing = stance(shape)
    if standing is None:
        return Reading(None, NO_SOLE.format(place="heel or the ball"))
    return Reading(standing.heel_mm)


def _ground(shape: Shape) -> Ground | None:
    """What a shape stands on; None for a last whose bottom is open."""
    if shape.kind == "foot":
        return Ground()
    standing = stance(shape)
    return None if standing is None else standing.ground
