"""The two girths around the heel: from its base over the instep, and the shortest one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.measures.landmarks import AXES, LANDMARKS, Shape
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outermost_point import Tip, tip
from footfit.geometry.mesh.outlines import Outline
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class HeelSettings:
    """The search for the shortest girth: planes through the heel's base, steeper step by step."""

    steepest_deg: float = 80.0
    step_deg: float = 3.0
    beyond: float = 2.0  # the girth may turn so many steps after the last whole section
    flat: float = 0.003  # of the length: the last whole girth serves if the girth falls less
    ball: float = 0.70  # over the length: the line from the cone's top to here passes any cone
    cone_end: float = 0.55  # a cone's front edge lies behind this place; a boot has none
    turn_deg: float = 6.0  # the plane that touches a low cone's edge is turned so far both ways
    apart: tuple[float, float] = (0.015, 0.035)  # of the length: a cone is low, see cone_edge


HEEL = HeelSettings()


def angle_to_deg(shape: Shape, place: Floats) -> float:
    """The rise from the heel's base to a place (3,), in degrees."""
    rise = place - shape.heel_base
    return float(np.degrees(np.arctan2(rise[2], rise[0])))


def around_heel(shape: Shape, angle_deg: float) -> Outline:
    """The section by the plane across the foot through the heel's base that rises forward by an
    angle.
    """
    angle = np.radians(angle_deg)
    forward = np.cos(angle) * AXES[0] + np.sin(angle) * AXES[2]
    return shape.cut(shape.heel_base, np.stack([AXES[1], forward]))


def shortest_around_heel(shape: Shape, settings: HeelSettings = HEEL) -> Outline | None:
    """The section around the heel with the smallest girth.

    If a last's cone ends before the girth grows again, it is the section at the cone's front edge.
    None for a foot if its leg is cut too low.
    """
    edge_deg = settings.steepest_deg
    if shape.kind == "last":
        edge_deg = angle_to_deg(shape, cone_edge(shape))
    angles, girths = _whole_girths(shape, edge_deg, settings.step_deg)
    turn = _turn(angles, girths)
    if shape.kind == "last":
        reached = turn is not None and turn.steps_beyond <= settings.beyond
        return around_heel(shape, min(turn.angle_deg, edge_deg) if reached and turn else edge_deg)
    if turn is None or turn.steps_beyond > settings.beyond:
        return None
    section = around_heel(shape, turn.angle_deg)
    if not shape.topped(section):
        return section
    flat = turn.fall_mm <= settings.flat * shape.length_mm
    return around_heel(shape, angles[-1]) if flat else None


def cone_edge(shape: Shape, settings: HeelSettings = HEEL) -> Floats:
    """A last's upper front edge, (3,): what is farthest over a line down from the cone's top.

    It is the middle of what lies near a plane along the line to the instep. On a low cone that is
    the middle of its top, which is nearly parallel to the line. There the edge is where a plane
    along the line to the ball touches. If that plane's normal is n and its distance h, it touches
    at h n + h' n', as it turns. Between ``apart`` the edge goes from one to the other.
    """
    usual = _over_cone(shape, LANDMARKS.instep, LANDMARKS.instep)[1].place
    turns = np.radians(settings.turn_deg) * np.array([-1.0, 0.0, 1.0])
    planes = [_over_cone(shape, settings.ball, settings.cone_end, turn) for turn in turns]
    (_, before), (normal, at), (_, after) = planes
    change = (after.reach - before.reach) / (2.0 * np.sin(turns[2]))
    touched = at.reach * normal + change * cross(AXES[1], normal) + at.place * AXES[1]
    low, lower = (share * shape.length_mm for share in settings.apart)
    share = np.clip((abs(touched[0] - usual[0]) - low) / (lower - low), 0.0, 1.0)
    return np.asarray(usual + share * (touched - usual))


def _over_cone(
    shape: Shape, end: float, window_end: float, turn: float = 0.0
) -> tuple[Floats, Tip]:
    """The normal (3,) of the plane along the line from the cone's top to the top of the section at
    ``end``, turned forward by an angle, and what lies farthest over it.
    """
    start_mm, end_mm = shape.x_mm(LANDMARKS.cone), shape.x_mm(end)
    tops_mm = [shape.across(share).points[:, 1].max() for share in (LANDMARKS.cone, end)]
    lean = np.arctan2(tops_mm[0] - tops_mm[1], end_mm - start_mm) + turn
    normal = np.array([np.sin(lean), 0.0, np.cos(lean)])
    x = shape.vertices_mm[:, 0]
    a, b, c = ((x > start_mm) & (x < shape.x_mm(window_end)))[shape.faces.T]
    return normal, tip(shape.vertices_mm, shape.faces[a & b & c], normal, shape.length_mm)


def _whole_girths(
    shape: Shape, steepest_deg: float, step_deg: float
) -> tuple[list[float], list[float]]:
    """Angles and girths of steeper and steeper sections, until one grows or is not whole."""
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


class Turn(NamedTuple):
    """Where girths stop falling and grow: the angle, how many steps that is after the last girth
    that was taken, and how far the girth falls between the two.
    """

    angle_deg: float
    steps_beyond: float
    fall_mm: float


def _turn(angles: list[float], girths: list[float]) -> Turn | None:
    """The least of the parabola through the last three girths; None if they only fall.

    Examples
    --------
    >>> _turn([30.0, 35.0, 40.0], [4.0, 0.0, 4.0])
    Turn(angle_deg=35.0, steps_beyond=-1.0, fall_mm=4.0)
    >>> _turn([30.0, 35.0, 40.0], [9.0, 4.0, 1.0])
    Turn(angle_deg=45.0, steps_beyond=1.0, fall_mm=1.0)
    >>> _turn([30.0, 35.0, 40.0], [9.0, 6.0, 3.0])
    """
    if len(girths) == 2 and girths[1] > girths[0]:
        return Turn(angles[0], -1.0, girths[1] - girths[0])
    if len(girths) < 3:
        return None
    before, middle, after = girths[-3:]
    bend = before - 2.0 * middle + after
    if bend <= 0.0:
        return None
    beyond = 0.5 * (before - after) / bend - 1.0
    step_deg = angles[-1] - angles[-2]
    return Turn(angles[-1] + beyond * step_deg, beyond, 0.5 * bend * beyond**2)
