"""Lengths: along X, to the ball, to the farthest toe, along the bottom, along the ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.unrolling import SideLine
from footfit.geometry.measures.bottom_arc import bottom_arc
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import MeasureValue, no_ball
from footfit.geometry.measures.underside import BOTTOM, underside
from footfit.geometry.mesh.outermost_point import tip
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.smoothing import local_quadratic
from footfit.geometry.stance.middle_line import low_points, turned
from footfit.geometry.stance.stance import Stance

FOREPART = 0.7
TURNS = 2  # of the direction towards the farthest toe; the second changes it by under .01 mm
OPEN_BOTTOM = "the sole is open at the heel or the ball"


@dataclass(frozen=True, slots=True)
class AlongSettings:
    """How a last's bottom is measured along its arc and its ground.

    ``feather_deg`` is the angle of the line that touches the feather edge, from a direction between
    the ground and the bottom's own at its end: ``own_share`` of the latter. If a last is bent, the
    heel's back turns with the seat or stays upright; half-way, the edge stays in both cases. The
    line is turned by ``turn_deg`` both ways to find where it touches.
    Where the bottom lies less than ``tread_height`` of the standing length over the ground, it is
    tread; it is read at ``tread_points`` places from ``tread_reach``.
    """

    feather_deg: float = 45.0
    own_share: float = 0.5
    turn_deg: float = 12.0
    tread_height: float = 0.002
    tread_reach: tuple[float, float] = (0.40, 0.95)
    tread_points: int = 276
    bandwidth: float = 0.012


ALONG = AlongSettings()


def length(shape: Shape) -> MeasureValue:
    """From the pternion to the foremost point along X, without the leg (ISO 7250-1 foot length).

    Of a last it is the stick length.
    """
    return MeasureValue(shape.length_mm)


def functional_length(shape: Shape) -> MeasureValue:
    """From the pternion to the tip of the toe that lies farthest from it, in plan.

    If a shoe is too short, this toe touches it first, whichever way the shoe turns about the heel.
    """
    start = shape.pternion[:2]
    fore = shape.low[shape.vertices_mm[shape.low[:, 0], 0] > shape.x_mm(FOREPART)]
    corners = shape.vertices_mm[fore[:, 0], :2]
    end = corners[np.argmax(np.square(corners - start).sum(axis=1))]
    distance = 0.0
    for _ in range(TURNS):
        direction = (end - start) / np.hypot(*(end - start))
        toe = tip(shape.vertices_mm, fore, np.array([*direction, 0.0]), shape.length_mm)
        distance = toe.reach - float(start @ direction)
        end = toe.place[:2]
    return MeasureValue(distance)


def ball_length(shape: Shape) -> MeasureValue:
    """From the pternion to the inner joint (MT1) along X."""
    if shape.mt1 is None:
        return no_ball(shape)
    return MeasureValue(float(shape.mt1[0] - shape.x_mm(0.0)))


def tape_length(shape: Shape) -> MeasureValue:
    """Along the middle of the bottom, as a tape reads that lies along a last's bottom.

    The length along X, plus how much longer the bottom's curve is than its run along X. The curve
    is smoothed first, since 0.3 mm of ripple makes a path over it one per cent longer.
    """
    bottom = underside(shape, BOTTOM.whole, BOTTOM.middle_places)
    if bottom is None:
        return MeasureValue(None, "the sole is open along its middle")
    curve = bottom.smooth(BOTTOM.bandwidth * shape.length_mm)
    run, rise = np.diff(curve.x_mm), np.diff(curve.z_mm)
    return MeasureValue(shape.length_mm + float((np.hypot(run, rise) - run).sum()))


def stick_length(shape: Shape) -> MeasureValue:
    """From the heel to the tip along the ground that a last stands on, as a size stick reads."""
    if shape.stance is None:
        return MeasureValue(None, OPEN_BOTTOM)
    along, up = shape.stance.standing_transform[:3, :3][[0, 2]]
    low = _low_faces(shape, shape.stance)
    rear = tip(shape.vertices_mm, low, -along, shape.length_mm)
    front = tip(shape.vertices_mm, low, along, shape.length_mm)
    rise_mm = float((front.place - rear.place) @ up)
    return MeasureValue(
        rear.reach + front.reach, convention_sd=abs(rise_mm) * shape.stance.ground_sd
    )


def bottom_length(shape: Shape) -> MeasureValue:
    """Along the middle of a last's bottom from its rearmost to its foremost feather edge.

    The overhang of the heel's back and of the toe's tip do not count: this is the standard last
    length. It does not change when a last is bent to another heel.
    """
    if shape.stance is None:
        return MeasureValue(None, OPEN_BOTTOM)
    arc = bottom_arc(shape.stance)
    start, end = np.column_stack([arc.line.x_mm, arc.line.z_mm])[[1, -2]]
    run = float(arc.line.arc_mm[-2] - arc.line.arc_mm[1])
    low = _low_faces(shape, shape.stance)
    behind = _beyond(shape, low, start, start - _next_point(arc.line, 1))
    ahead = _beyond(shape, low, end, end - _next_point(arc.line, -2))
    return MeasureValue(behind + run + ahead)


def _next_point(line: SideLine, end: int) -> Floats:
    """The point of a side line that is next to one of its ends, inward, (2,)."""
    inward = end + (1 if end > 0 else -1)
    return np.array([line.x_mm[inward], line.z_mm[inward]])


def _low_faces(shape: Shape, stance: Stance) -> Ints:
    """The faces (k, 3) close over the bottom of a standing last: the toes of a last with a high
    heel lie high in its resting frame.
    """
    a, b, c = low_points(turned(shape.vertices_mm, stance.ground))[shape.faces.T]
    return np.asarray(shape.faces[a & b & c])


def _beyond(shape: Shape, low: Ints, end: Floats, outward: Floats) -> float:
    """How far the feather edge lies beyond an end (2,) of the bottom's line, along it.

    A tangent with the normal n has the distance h from the end. As it turns, h changes by h' and n
    by n': it touches at h n + h' n'. Reaches are steadier than the vertices of an edge.
    """
    assert shape.stance is not None
    stance = shape.stance
    along, up = stance.standing_transform[:3, :3][[0, 2]]
    origin = stance.standing_transform[[0, 2], 3]
    out = outward / np.linalg.norm(outward)
    level = np.array([np.sign(out[0]), 0.0])
    aim = ALONG.own_share * out + (1.0 - ALONG.own_share) * level
    aim /= np.linalg.norm(aim)
    down = np.array([aim[1], -aim[0]]) * (1.0 if aim[0] > 0.0 else -1.0)
    angle, turn = np.radians(ALONG.feather_deg), np.radians(ALONG.turn_deg)
    heights = []
    for at in (angle - turn, angle, angle + turn):
        normal = np.cos(at) * aim + np.sin(at) * down
        direction = normal[0] * along + normal[1] * up
        reach = tip(shape.vertices_mm, low, direction, shape.length_mm).reach
        heights.append(reach + float(normal @ (origin - end)))
    change = (heights[2] - heights[0]) / (2.0 * np.sin(turn))
    touch = heights[1] * (np.cos(angle) * aim + np.sin(angle) * down)
    touch += change * (np.cos(angle) * down - np.sin(angle) * aim)
    return float(touch @ out)


def tread_from(shape: Shape) -> MeasureValue:
    """Where the tread begins, along the ground from the rearmost point: the bottom comes nearer
    to the ground than .002 of the standing length.
    """
    return _tread_end(shape, 0)


def tread_to(shape: Shape) -> MeasureValue:
    """Where the tread ends, along the ground from the rearmost point: the bottom rises further
    over the ground than .002 of the standing length.
    """
    return _tread_end(shape, 1)


def _tread_end(shape: Shape, end: int) -> MeasureValue:
    stance = shape.stance
    if stance is None or not len(stance.middle_mm):
        return MeasureValue(None, OPEN_BOTTOM)
    place = np.linspace(*ALONG.tread_reach, ALONG.tread_points)
    known, height_mm = stance.middle_mm[:, 0] / stance.length_mm, stance.middle_mm[:, 1]
    over = local_quadratic(place, known, ALONG.bandwidth)[0] @ height_mm / stance.length_mm
    tilt = place - stance.touching_x_mm / stance.length_mm
    value, low, high = (
        _low_stretch(place, over - by * tilt)[end] * stance.length_mm
        for by in (0.0, -stance.ground_sd, stance.ground_sd)
    )
    return MeasureValue(value, convention_sd=0.5 * abs(high - low))


def _low_stretch(place: Floats, over: Floats) -> tuple[float, float]:
    """From where to where a curve about its lowest place is lower than the tread's height."""
    lowest = int(np.argmin(over))
    high = over - over[lowest] > ALONG.tread_height
    ends = []
    for side, step in ((np.flatnonzero(high[:lowest])[::-1], 1), (np.flatnonzero(high), -1)):
        beyond = side[side > lowest] if step < 0 else side
        if not len(beyond):
            ends.append(float(place[0] if step > 0 else place[-1]))
            continue
        pair = [int(beyond[0]), int(beyond[0]) + step]
        rise = over[pair] - over[lowest]
        share = (ALONG.tread_height - rise[1]) / (rise[0] - rise[1])
        ends.append(float(place[pair[1]] + share * (place[pair[0]] - place[pair[1]])))
    return ends[0], ends[1]
