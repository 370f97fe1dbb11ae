"""The two girths around the heel: from its base over the instep, and the shortest one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.measures.landmarks import AXES, LANDMARKS, Shape
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outermost_point import tip
from footfit.geometry.mesh.outlines import OUTLINES, TAPE_OUTLINES, Outline, OutlineSettings
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
    turn_deg: float = 9.0  # the plane that touches the cone's edge is turned so far both ways


HEEL = HeelSettings()
TURNS = np.array([-1.0, 0.0, 1.0])


def angle_to_deg(shape: Shape, place: Floats) -> float:
    """The rise from the heel's base to a place (3,), in degrees."""
    rise = place - shape.heel_base
    return float(np.degrees(np.arctan2(rise[2], rise[0])))


def around_heel(shape: Shape, angle_deg: float, outlines: OutlineSettings = OUTLINES) -> Outline:
    """The section by the plane across the foot through the heel's base that rises forward by an
    angle.
    """
    angle = np.radians(angle_deg)
    forward = np.cos(angle) * AXES[0] + np.sin(angle) * AXES[2]
    return shape.cut(shape.heel_base, np.stack([AXES[1], forward]), outlines)


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
        angle_deg = min(turn.angle_deg, edge_deg) if reached and turn else edge_deg
        return around_heel(shape, angle_deg, TAPE_OUTLINES)
    if turn is None or turn.steps_beyond > settings.beyond:
        return None
    section = around_heel(shape, turn.angle_deg, TAPE_OUTLINES)
    if not shape.topped(section):
        return section
    flat = turn.fall_mm <= settings.flat * shape.length_mm
    return around_heel(shape, angles[-1], TAPE_OUTLINES) if flat else None


def cone_edge(shape: Shape, settings: HeelSettings = HEEL) -> Floats:
    """A last's upper front edge, (3,): where a plane touches that leads from the cone's top (.15 L)
    down to the top of the ball.

    A plane with the normal n has the distance h. As it turns, h changes by h' and n by n': it
    touches at h n + h' n'.
    """
    start_mm, end_mm = (shape.x_mm(share) for share in (LANDMARKS.cone, settings.ball))
    tops_mm = [shape.across(share).points[:, 1].max() for share in (LANDMARKS.cone, settings.ball)]
    x = shape.vertices_mm[:, 0]
    a, b, c = ((x > start_mm) & (x < shape.x_mm(settings.cone_end)))[shape.faces.T]
    lean = np.arctan2(tops_mm[0] - tops_mm[1], end_mm - start_mm)
    turn = np.radians(settings.turn_deg)
    normals = [np.array([np.sin(at), 0.0, np.cos(at)]) for at in lean + turn * TURNS]
    before, at, after = (
        tip(shape.vertices_mm, shape.faces[a & b & c], normal, shape.length_mm)
        for normal in normals
    )
    change = (after.reach - before.reach) / (2.0 * np.sin(turn))
    onward = cross(AXES[1], normals[1])
    return np.asarray(at.reach * normals[1] + change * onward + at.place * AXES[1])


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
