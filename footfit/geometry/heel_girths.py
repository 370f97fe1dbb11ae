"""The two girths around the heel: from its base over the instep, and the shortest one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.arrays import Floats
from footfit.geometry.girths import hull_girth
from footfit.geometry.landmarks import AXES, Shape
from footfit.geometry.outlines import Outline


@dataclass(frozen=True, slots=True)
class HeelSettings:
    """The search for the shortest girth, over planes ever steeper than the long girth's."""

    steepest_deg: float = 80.0
    step_deg: float = 5.0
    beyond: float = 1.0  # steps over the last whole section where the girth may turn


HEEL = HeelSettings()


def angle_to_deg(shape: Shape, place: Floats) -> float:
    """How steeply a place (3,) is seen from the heel's base."""
    rise = place - shape.heel_base
    return float(np.degrees(np.arctan2(rise[2], rise[0])))


def around_heel(shape: Shape, angle_deg: float) -> Outline:
    """The section around the heel by the plane across the foot through its base, which rises
    forward by an angle.
    """
    angle = np.radians(angle_deg)
    forward = np.cos(angle) * AXES[0] + np.sin(angle) * AXES[2]
    return shape.cut(shape.heel_base, np.stack([AXES[1], forward]))


def shortest_around_heel(shape: Shape, settings: HeelSettings = HEEL) -> Outline | None:
    """The section around the heel with the smallest girth.

    Of a last whose cone ends before the girth grows again, the section at the cone's front edge;
    None for a foot whose leg is cut that low.
    """
    edge_deg = settings.steepest_deg
    if shape.kind == "last":
        edge_deg = angle_to_deg(shape, shape.cone_edge)
    angles, girths = _whole_girths(shape, edge_deg, settings.step_deg)
    least = _turning_angle_deg(angles, girths, settings.beyond)
    if shape.kind == "last":
        return around_heel(shape, edge_deg if least is None else min(least, edge_deg))
    section = None if least is None else around_heel(shape, least)
    return None if section is None or shape.topped(section) else section


def _whole_girths(
    shape: Shape, steepest_deg: float, step_deg: float
) -> tuple[list[float], list[float]]:
    """Angles and girths of ever steeper sections, to one that grows or is not whole."""
    angles: list[float] = []
    girths: list[float] = []
    angle = angle_to_deg(shape, shape.instep)
    while angle <= steepest_deg:
        section = around_heel(shape, angle)
        if shape.topped(section):
            break
        angles.append(angle)
        girths.append(hull_girth(section.points))
        if len(girths) > 1 and girths[-1] > girths[-2]:
            break
        angle += step_deg
    return angles, girths


def _turning_angle_deg(angles: list[float], girths: list[float], beyond: float) -> float | None:
    """Where the parabola through the last three girths is lowest.

    None where that is more than ``beyond`` steps behind the last angle.

    Examples
    --------
    >>> _turning_angle_deg([30.0, 35.0, 40.0], [4.0, 0.0, 4.0], 1.0)
    35.0
    >>> _turning_angle_deg([30.0, 35.0, 40.0], [9.0, 7.0, 5.9], 1.0)
    43.61
    >>> _turning_angle_deg([30.0, 35.0, 40.0], [9.0, 5.0, 2.0], 1.0)
    """
    if len(girths) == 2 and girths[1] > girths[0]:
        return angles[0]
    if len(girths) < 3:
        return None
    before, middle, after = girths[-3:]
    bend = before - 2.0 * middle + after
    if bend <= 0.0:
        return None
    steps = 0.5 * (before - after) / bend
    if steps > 1.0 + beyond:
        return None
    return round(angles[-2] + steps * (angles[-1] - angles[-2]), 2)
