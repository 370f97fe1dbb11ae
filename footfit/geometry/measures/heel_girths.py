"""The two girths around the heel: from its base over the instep, and the shortest one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.measures.landmarks import AXES, LANDMARKS, Shape
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outermost_point import tip
from footfit.geometry.mesh.outlines import Outline
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class HeelSettings:
    """The search for the shortest girth: planes through the heel's base, steeper step by step."""

    steepest_deg: float = 80.0
    step_deg: float = 3.0
    beyond: float = 2.0  # the girth may turn so many steps after the last whole section
    flat: float = 0.003  # of the length: the last whole girth serves if the girth falls less
    top: float = 0.25  # over the length: a cone's top reaches to here at least
    steeper_deg: float = 14.0  # the line down from the cone's top is so much steeper than the top
    ball: float = 0.70  # over the length: the line from the cone's top to here passes any cone
    cone_end: float = 0.55  # a cone's front edge lies behind this place; a boot has none


HEEL = HeelSettings()


def angle_to_deg(shape: Shape, place: Floats) -> float:
    """The rise from the heel's base to a place (3,), in degrees."""
    rise = place - shape.heel_base
    return float(np.degrees(np.arctan2(rise[2], rise[0])))


def around_heel(shape: Shape, angle_deg: float) -> Outline:
    """The section by the plane across the foot through the heel's base that rises forward by an
    angle.
    """
    return shape.cut(shape.heel_base, heel_axes(angle_deg))


def heel_axes(angle_deg: float) -> Floats:
    """The axes (2, 3) of a plane around the heel that rises forward by an angle: across, forward.

    Examples
    --------
    >>> heel_axes(90.0).round(9).tolist()
    [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    angle = np.radians(angle_deg)
    return np.stack([AXES[1], np.cos(angle) * AXES[0] + np.sin(angle) * AXES[2]])


def shortest_around_heel(shape: Shape, settings: HeelSettings = HEEL) -> Outline | None:
    """The section around the heel with the smallest girth.

    If a last's cone ends before the girth grows again, it is the section at the cone's front edge.
    None for a foot if its leg is cut too low, and for a last if that edge was cut away.
    """
    edge_deg = settings.steepest_deg
    if shape.kind == "last":
        edge = cone_edge(shape)
        edge_deg = angle_to_deg(shape, edge)
    angles, girths = _whole_girths(shape, edge_deg, settings.step_deg)
    turn = _turn(angles, girths)
    if shape.kind == "last":
        if turn is not None and turn.steps_beyond <= settings.beyond and turn.angle_deg < edge_deg:
            return around_heel(shape, turn.angle_deg)
        cut = shape.cone_cut
        lost = cut is not None and cut.takes(edge, shape.length_mm)
        return None if lost else around_heel(shape, edge_deg)
    if turn is None or turn.steps_beyond > settings.beyond:
        return None
    section = around_heel(shape, turn.angle_deg)
    if not shape.topped(section):
        return section
    flat = turn.fall_mm <= settings.flat * shape.length_mm
    return around_heel(shape, angles[-1]) if flat else None


def cone_edge(shape: Shape, settings: HeelSettings = HEEL) -> Floats:
    """A last's upper front edge, (3,): the middle of the cap that lies farthest over the line from
    the cone's top (.15 L) to the instep point.

    The top of a low cone is nearly parallel to that line, and a boot's shaft hides its edge from
    it. So the line is 14 degrees steeper than the cone's top at least, but not steeper than the
    line to the top of the section at .70 L.
    """
    start_mm = shape.x_mm(LANDMARKS.cone)
    top_mm = shape.across(LANDMARKS.cone).points[:, 1].max()

    def fall(share: float) -> float:
        """How steeply the line from the cone's top to the top of a section falls, in radians."""
        fall_mm = top_mm - shape.across(share).points[:, 1].max()
        return float(np.arctan2(fall_mm, shape.x_mm(share) - start_mm))

    steep = max(fall(LANDMARKS.instep), fall(settings.top) + np.radians(settings.steeper_deg))
    lean = min(steep, fall(settings.ball))
    normal = np.array([np.sin(lean), 0.0, np.cos(lean)])
    x = shape.vertices_mm[:, 0]
    # A flat top may be a few large facets: one that begins behind the line is not left out.
    ahead, behind = (x > start_mm)[shape.faces], (x < shape.x_mm(settings.cone_end))[shape.faces]
    faces = shape.faces[ahead.any(axis=1) & behind.all(axis=1)]
    return tip(shape.vertices_mm, faces, normal, shape.length_mm).place


def _whole_girths(
    shape: Shape, steepest_deg: float, step_deg: float
) -> tuple[list[float], list[float]]:
    """Angles and girths of steeper and steeper sections, until one grows or is not whole.

    A last's section may run over its cone.
    """
    angles: list[float] = []
    girths: list[float] = []
    angle = angle_to_deg(shape, shape.instep)
    while angle <= steepest_deg:
        section = around_heel(shape, angle)
        if shape.opened(section) if shape.kind == "last" else shape.topped(section):
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
