"""Heights over the plane the shape rests on: arch, instep, toes, and how a last stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import OPEN, UNSCANNED, MeasureValue, section_value
from footfit.geometry.measures.underside import BOTTOM, underside


@dataclass(frozen=True, slots=True)
class HeightSettings:
    """Where heights are taken, over the length."""

    toe: float = 0.92
    toe_spring: float = 0.94


HEIGHTS = HeightSettings()
NO_SOLE = "the sole is open at the {place}"
NO_TREAD = "the sole is open or shows no tread"
FLAT = "measured on lasts: a foot stands flat"


def arch_height(shape: Shape) -> MeasureValue:
    """The greatest height of the underside along the inner arch, a quarter of the width from the
    medial edge.
    """
    arch = underside(shape, BOTTOM.arch, BOTTOM.arch_places)
    if arch is None:
        reason = UNSCANNED if shape.filled.any() else NO_SOLE.format(place="arch")
        return MeasureValue(None, reason)
    return MeasureValue(float(arch.smooth(BOTTOM.bandwidth * shape.length_mm).z_mm.max()))


def instep_height(shape: Shape) -> MeasureValue:
    """The top of the section at half the length, over the contact plane."""
    return section_value(shape, shape.at_instep, "instep", lambda points: points[:, 1].max())


def toe_height(shape: Shape) -> MeasureValue:
    """From the lowest to the highest point of the section at .92 of the length."""
    section = shape.across(HEIGHTS.toe)
    if shape.opened(section):
        return MeasureValue(None, OPEN.format(place="toes"))
    if shape.unscanned(section):
        return MeasureValue(None, UNSCANNED)
    return MeasureValue(float(np.ptp(section.points[:, 1])))


def toe_spring(shape: Shape) -> MeasureValue:
    """The lowest point of the section at .94 of the length, over the ground.

    A foot's ground is the contact plane; a last's is the ground that it stands on.
    """
    section = shape.across(HEIGHTS.toe_spring)
    if shape.stance is None:
        return MeasureValue(None, NO_TREAD)
    if shape.opened(section):
        return MeasureValue(None, NO_SOLE.format(place="toes or the ball"))
    middle_mm = float(section.points[:, 1].min() + 0.5 * np.ptp(section.points[:, 1]))
    if shape.unscanned(section, below_mm=middle_mm):
        return MeasureValue(None, UNSCANNED)
    x_mm, z_mm = shape.x_mm(HEIGHTS.toe_spring), float(section.points[:, 1].min())
    place_mm = shape.stance.along_ground_mm(x_mm, z_mm)
    height_mm = shape.stance.over_ground_mm(x_mm, z_mm)
    return MeasureValue(height_mm, convention_sd=shape.stance.level_sd_mm(place_mm))


def heel_height(shape: Shape) -> MeasureValue:
    """How high a last's heel stands when its tread lies level: the seat's line at the rearmost
    point along the ground.
    """
    if shape.kind == "foot":
        return MeasureValue(None, FLAT)
    if shape.stance is None:
        return MeasureValue(None, NO_TREAD)
    heel_mm = shape.stance.heel_mm()
    if heel_mm is None:
        return MeasureValue(None, NO_SOLE.format(place="heel or the ball"))
    return MeasureValue(heel_mm, convention_sd=shape.stance.level_sd_mm(0.0))


def toe_spring_tip(shape: Shape) -> MeasureValue:
    """How high the middle of a last's bottom, drawn on to the tip, lies over the ground.

    It is the toe spring of the trade; ``toe_spring`` is read further back.
    """
    if shape.stance is None:
        return MeasureValue(None, NO_TREAD)
    tip_mm = shape.stance.tip_mm()
    if tip_mm is None:
        return MeasureValue(None, NO_SOLE.format(place="toes or the ball"))
    sd_mm = shape.stance.level_sd_mm(shape.stance.length_mm)
    return MeasureValue(tip_mm, convention_sd=sd_mm)


def seat_angle_deg(shape: Shape) -> MeasureValue:
    """How steeply the line of a last's seat falls towards the toe, in degrees from the ground."""
    if shape.stance is None:
        return MeasureValue(None, NO_TREAD)
    seat = shape.stance.seat_line()
    if seat is None:
        return MeasureValue(None, NO_SOLE.format(place="heel or the ball"))
    sd_deg = float(np.degrees(shape.stance.level_sd))
    return MeasureValue(-float(np.degrees(np.arctan(seat[0]))), convention_sd=sd_deg)
