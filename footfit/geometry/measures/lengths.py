"""Lengths: along X, to the ball, to the farthest toe, along the bottom, along the ground."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.unrolling import SideLine
from footfit.geometry.measures.bottom_arc import bottom_arc
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import MeasureValue, no_ball
from footfit.geometry.measures.underside import BOTTOM, underside
from footfit.geometry.mesh.outermost_point import tip
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.smoothing import local_quadratic
from footfit.geometry.stance.middle_line import low_points, turned
from footfit.geometry.stance.stance import Stance

FOREPART = 0.7
TURNS = 2  # of the direction towards the farthest toe; the second changes it by under .01 mm
AHEAD = np.array([1.0, 0.0])
OPEN_BOTTOM = "the sole is open at the heel or the ball, or shows no tread"


@dataclass(frozen=True, slots=True)
class AlongSettings:
    """How a last's bottom is measured along its arc and its ground.

    The line along the bottom is read in ``line_window``, a share of the standing length: nearer to
    its ends the edges round off. A feather edge is looked for within ``near_end`` of the standing
    length from the line's end: the ball of a last with a high heel lies lower than its heel. The
    line that touches the edge is turned by ``turn_deg`` both ways to find where.
    The wall of the heel's back is read at heights over the bottom (``wall``) up to ``wall_deep``
    from the rearmost place, over the length; its faces look back by ``wall_back`` in plan.
    Where the bottom lies less than ``tread_height`` of the standing length over the ground, it is
    tread; it is read at ``tread_points`` places from ``tread_reach``. A second scan of a last
    moves such a height by ``tread_noise``, and the tread's ends by what this makes of it. Of what
    the ground's own doubt moves an end by, ``tread_open`` counts: a flat tread ends nowhere sure,
    and an end that moves far one way moves less the other way.
    """

    line_window: tuple[float, float] = (0.06, 0.965)
    near_end: float = 0.15
    turn_deg: float = 12.0
    wall: tuple[float, float] = (0.02, 0.07)
    wall_deep: float = 0.12
    wall_back: float = 0.7
    tread_height: float = 0.002
    tread_noise: float = 0.0003
    tread_open: float = 0.7
    tread_least_sd_mm: float = 0.3
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
    fore = shape.toes[shape.vertices_mm[shape.toes[:, 0], 0] > shape.x_mm(FOREPART)]
    corners = shape.vertices_mm[fore[:, 0], :2]
    end = corners[np.argmax(np.square(corners - start).sum(axis=1))]
    distance = 0.0
    for _ in range(TURNS):
        direction = (end - start) / np.hypot(*(end - start))
        outward = np.array([*direction, 0.0])
        toe = tip(shape.vertices_mm, fore, outward, shape.length_mm, shape.tips)
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
    curve = bottom.smooth(BOTTOM.tape_bandwidth * shape.length_mm)
    run, rise = np.diff(curve.x_mm), np.diff(curve.z_mm)
    return MeasureValue(shape.length_mm + float((np.hypot(run, rise) - run).sum()))


def stick_length(shape: Shape) -> MeasureValue:
    """From the heel to the tip along the ground that a last stands on, as a size stick reads."""
    if shape.stance is None:
        return MeasureValue(None, OPEN_BOTTOM)
    along, up = shape.stance.standing_transform[:3, :3][[0, 2]]
    low = _low_faces(shape, shape.stance)
    rear = tip(shape.vertices_mm, low, -along, shape.length_mm, shape.tips)
    front = tip(shape.vertices_mm, low, along, shape.length_mm, shape.tips)
    rise_mm = float((front.place - rear.place) @ up)
    return MeasureValue(
        rear.reach + front.reach, convention_sd=abs(rise_mm) * shape.stance.level_sd
    )


def bottom_length(shape: Shape) -> MeasureValue:
    """Along the middle of a last's bottom from its rearmost to its foremost feather edge.

    The overhang of the heel's back and of the toe's tip do not count: this is the standard last
    length. It does not change when a last is bent to another heel.
    """
    ends = feather_ends(shape)
    return MeasureValue(None, OPEN_BOTTOM) if ends is None else MeasureValue(ends.length_mm)


@dataclass(frozen=True, slots=True)
class FeatherEnds:
    """Where a last's bottom begins and ends: at its rearmost and its foremost feather edge.

    Attributes
    ----------
    line : SideLine
        The bottom's line, drawn on straight at both ends.
    rear_mm, front_mm : float
        The two edges, along the line.
    heel_wall : (2,)
        Where the wall of the heel's back looks, along the ground and up.
    """

    line: SideLine
    rear_mm: float
    front_mm: float
    heel_wall: Floats

    @property
    def length_mm(self) -> float:
        """The length of the bottom along its line."""
        return self.front_mm - self.rear_mm


def feather_ends(shape: Shape) -> FeatherEnds | None:
    """The ends of a last's bottom; None if it is open, and of a foot."""
    if shape.kind == "foot" or shape.stance is None:
        return None
    definition = replace(FlareDefinition(), line_window=ALONG.line_window)
    line = bottom_arc(shape.stance, definition).line
    wall = _heel_wall(shape, line)
    rear_mm = float(line.arc_mm[1]) - _beyond(shape, line, 1, wall)
    front_mm = float(line.arc_mm[-2]) + _beyond(shape, line, -2, AHEAD)
    return FeatherEnds(line, rear_mm, front_mm, wall)


def _low_faces(shape: Shape, stance: Stance) -> Ints:
    """The faces (k, 3) close over the bottom of a standing last: the toes of a last with a high
    heel lie high in its resting frame.
    """
    a, b, c = low_points(turned(shape.vertices_mm, stance.ground))[shape.faces.T]
    return np.asarray(shape.faces[a & b & c])


def _heel_wall(shape: Shape, line: SideLine) -> Floats:
    """Where the wall of the heel's back looks, along the ground and up, (2,)."""
    assert shape.stance is not None
    stands = shape.stance.standing_transform
    standing = shape.vertices_mm @ stands[:3, :3].T + stands[:3, 3]
    along, _, over = line.unrolled(standing)[shape.faces].mean(axis=1).T / shape.length_mm
    looks = area_vectors(standing, shape.faces)
    low, high = ALONG.wall
    wall = (over > low) & (over < high) & (np.abs(along) < ALONG.wall_deep)
    wall &= -looks[:, 0] > ALONG.wall_back * np.hypot(looks[:, 0], looks[:, 1])
    total = looks[wall].sum(axis=0)[[0, 2]]
    return np.asarray(total / np.linalg.norm(total) if total.any() else -AHEAD)


def _beyond(shape: Shape, line: SideLine, end: int, wall: Floats) -> float:
    """How far the feather edge lies beyond an end (1 or -2) of the bottom's line, along it.

    The edge is where a line touches that is half-way between the bottom and the wall, which looks
    towards ``wall`` (2,). So it is the same place whether a last's wall turns with its bottom or
    stays upright when it is bent. A tangent with the normal n has the distance h from the end. As
    it turns, h changes by h' and n by n': it touches at h n + h' n'. Reaches are steadier than the
    vertices of an edge.
    """
    assert shape.stance is not None
    stance, forward = shape.stance, float(np.sign(end)) * -1.0
    stands = stance.standing_transform
    ends = np.column_stack([line.x_mm, line.z_mm])[[end, end - int(forward)]]
    out = (ends[0] - ends[1]) / np.linalg.norm(ends[0] - ends[1])
    half = wall + forward * np.array([out[1], -out[0]])
    half /= np.linalg.norm(half)
    down = forward * np.array([half[1], -half[0]])
    low = _low_faces(shape, stance)
    middle = shape.vertices_mm[low].mean(axis=1) @ stands[0, :3] + stands[0, 3]
    near = low[np.abs(middle - ends[0, 0]) < ALONG.near_end * stance.length_mm]
    turn = np.radians(ALONG.turn_deg)
    heights = []
    for at in (-turn, 0.0, turn):
        normal = np.cos(at) * half + np.sin(at) * down
        reach = tip(shape.vertices_mm, near, normal @ stands[[0, 2], :3], shape.length_mm).reach
        heights.append(reach + float(normal @ (stands[[0, 2], 3] - ends[0])))
    change = (heights[2] - heights[0]) / (2.0 * np.sin(turn))
    touching = heights[1] * half + change * down
    return float((touching @ wall) / (out @ wall))  # along the wall down to the bottom's line


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
    height = ALONG.tread_height
    value, low, high = (
        _low_stretch(place, over - by * tilt, height)[end] * stance.length_mm
        for by in (0.0, -stance.level_sd, stance.level_sd)
    )
    under, above = (
        _low_stretch(place, over, height + by)[end] * stance.length_mm
        for by in (-ALONG.tread_noise, ALONG.tread_noise)
    )
    sd = max(0.5 * abs(above - under), ALONG.tread_least_sd_mm)
    return MeasureValue(value, convention_sd=ALONG.tread_open * 0.5 * abs(high - low), sd=sd)


def _low_stretch(place: Floats, over: Floats, height: float) -> tuple[float, float]:
    """From where to where a curve about its lowest place is no more than a height over it."""
    lowest = int(np.argmin(over))
    high = over - over[lowest] > height
    ends = []
    for side, step in ((np.flatnonzero(high[:lowest])[::-1], 1), (np.flatnonzero(high), -1)):
        beyond = side[side > lowest] if step < 0 else side
        if not len(beyond):
            ends.append(float(place[0] if step > 0 else place[-1]))
            continue
        pair = [int(beyond[0]), int(beyond[0]) + step]
        rise = over[pair] - over[lowest]
        share = (height - rise[1]) / (rise[0] - rise[1])
        ends.append(float(place[pair[1]] + share * (place[pair[0]] - place[pair[1]])))
    return ends[0], ends[1]
