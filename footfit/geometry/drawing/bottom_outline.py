"""The outline of a bottom laid flat: a last's feather edge, as its insole pattern has it.

The bottom is laid flat along its own line in the side view (`flare.unrolling`), but a point goes
to the line at right angles: what lies over the line does not move along it. Half planes that stand
upright on the flat bottom are cut: across it along its middle, and around a centre at either end.
In each the edge is where a line touches that is half-way between the bottom and the wall. Where the
edge is rough from irregular facets, these are cut as curved pieces, and what is left is smoothed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.drawing.curved_faces import corner_normals, curved_pieces
from footfit.geometry.drawing.rough_ends import (
    ANY_ROUGHNESS,
    roughness,
    without_roughness,
)
from footfit.geometry.flare.unrolling import SideLine
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.lengths import FeatherEnds, feather_ends
from footfit.geometry.mesh.outlines import TAPE_OUTLINES, steady_loop
from footfit.geometry.mesh.sections import Planes, plane_sections
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class BottomOutlineSettings:
    """How the edge is read; lengths over the length of the bottom.

    Attributes
    ----------
    heel, toe : float
        How far the centres lie from the ends, around which the half planes turn.
    near : float
        Points that lie higher over the line, upright, are not laid flat.
    low : float
        Faces that lie higher over the line, at right angles to it, are no bottom.
    step : float
        From half plane to half plane across the bottom.
    turn_deg : float
        From half plane to half plane around a centre.
    touch_deg : float
        How far the touching line is turned both ways to find where it touches.
    ramp : float
        The sides are smoothed from the centres on; in full so far from them.
    parts : int
        Into how many pieces an edge of a face is cut, for its curve.
    rough : float
        Curved pieces count in full where the outline of flat faces is so rough.
    """

    heel: float = 0.12
    toe: float = 0.14
    near: float = 0.16
    low: float = 0.06
    step: float = 0.006
    turn_deg: float = 2.0
    touch_deg: float = 15.0
    ramp: float = 0.05
    parts: int = 3
    rough: float = 0.00003


BOTTOM_OUTLINE = BottomOutlineSettings()
SIDES = replace(TAPE_OUTLINES, smoothing=0.02, noise_times=1e9, facets=0.0)
"""All that smoothing takes away counts as noise."""
LINE_PLACES = 400
"""Of a side line, from the nearest of which the foot of a perpendicular is looked for."""
LEAST_GAIN = 0.2
"""Keeps a point near the line's centre of curvature on its own side."""


@dataclass(frozen=True, slots=True)
class _Flat:
    """The faces (m, 3) near a bottom laid flat: vertices (n, 3) in mm, and their normals."""

    vertices: Floats
    normals: Floats
    faces: Ints


@dataclass(frozen=True, slots=True)
class FlatFrame:
    """How a right last is laid flat, from the canonical frame.

    ``stands`` (4, 4) leads to the frame of the ``line``. ``rear_mm`` and ``front_mm`` are the ends
    of the bottom along the line. ``tilts`` (2,) say how the walls of heel and toe lean there, in
    radians from right angles, + where the wall looks up.
    """

    line: SideLine
    stands: Floats
    rear_mm: float
    front_mm: float
    tilts: tuple[float, float]

    @property
    def length_mm(self) -> float:
        """From end to end along the line."""
        return self.front_mm - self.rear_mm

    def flat(self, points_mm: Floats) -> Floats:
        """Points (n, 3) of the canonical frame: along the line, to the medial side, over it."""
        return perpendicular(self.line, self.standing(points_mm))

    def standing(self, points_mm: Floats) -> Floats:
        """Points (n, 3) of the canonical frame as the last stands."""
        return points_mm @ self.stands[:3, :3].T + self.stands[:3, 3]


def flat_frame(shape: Shape) -> FlatFrame | None:
    """How a last's bottom is laid flat; None if it is open, and of a foot."""
    ends = feather_ends(shape)
    if ends is None or shape.stance is None:
        return None
    stands = shape.stance.standing_transform
    return FlatFrame(ends.line, stands, ends.rear_mm, ends.front_mm, _tilts(ends))


def _tilts(ends: FeatherEnds) -> tuple[float, float]:
    """How the walls lean at the heel and the toe; the wall of the toe stands upright."""
    x, z = ends.line.x_mm, ends.line.z_mm
    slopes = [np.arctan2(z[row + 1] - z[row], x[row + 1] - x[row]) for row in (0, -2)]
    heel = np.arctan2(ends.heel_wall[1], -ends.heel_wall[0])
    return float(heel + slopes[0]), float(-slopes[1])


def perpendicular(line: SideLine, standing_mm: Floats, rounds: int = 4) -> Floats:
    """Points (n, 3) near a side line as they lie to it: the arc length up to the foot of the
    perpendicular, to the medial side, and the height over the line.

    Examples
    --------
    >>> slope = SideLine(np.array([0.0, 4.0]), np.array([0.0, 3.0]), np.array([0.0, 5.0]))
    >>> perpendicular(slope, np.array([[4.0, 7.0, 3.0], [1.0, 0.0, 7.0]])).round(9).tolist()
    [[5.0, 7.0, 0.0], [5.0, 0.0, 5.0]]
    """
    from scipy.spatial import cKDTree

    x, y, z = standing_mm.T
    slopes = np.gradient(line.z_mm, line.x_mm)
    bends = np.gradient(slopes, line.x_mm)
    places = np.linspace(line.x_mm[0], line.x_mm[-1], LINE_PLACES)
    known = cKDTree(np.column_stack([places, line.height(places)]))
    start = places[known.query(np.column_stack([x, z]))[1]]
    reach, at = places[1] - places[0], start
    for _ in range(rounds):  # Newton's steps to where the way to the point meets the line squarely
        slope = np.interp(at, line.x_mm, slopes)
        over = z - line.height(at)
        gain = 1.0 + np.square(slope) - over * np.interp(at, line.x_mm, bends)
        step = (x - at + over * slope) / np.maximum(gain, LEAST_GAIN)
        at = np.clip(at + step, start - reach, start + reach)
    slope = np.interp(at, line.x_mm, slopes)
    height = (z - line.height(at)) * np.sqrt(1.0 + np.square(slope))
    return np.column_stack([line.arc(at), y, height])


def bottom_outline(
    shape: Shape, frame: FlatFrame, settings: BottomOutlineSettings = BOTTOM_OUTLINE
) -> Floats | None:
    """The outline (k, 2) of a bottom laid flat, from its rearmost point counter-clockwise.

    x runs along the bottom from the rearmost point, y to the medial side. Its extent along x is
    the measure `bottom_length`. None if the bottom is open somewhere.
    """
    standing = frame.standing(shape.vertices_mm)
    over_mm = standing[:, 2] - frame.line.height(standing[:, 0])
    a, b, c = (over_mm < settings.near * frame.length_mm)[shape.faces.T]
    vertices, faces, _ = without_unused_vertices(shape.vertices_mm, shape.faces[a & b & c])
    places = frame.flat(vertices)
    places[:, 0] -= frame.rear_mm
    a, b, c = (np.abs(places[:, 2]) < settings.low * frame.length_mm)[faces.T]
    flat = _Flat(places, corner_normals(places, faces), faces[a & b & c])
    long = frame.length_mm
    planes = tuple(_half_planes(flat, frame, settings))
    loop = _loop(flat, planes, 1, settings)
    if not np.isfinite(loop).all():
        return None
    first = int(np.argmax(loop[:, 0]))
    loop, planes = np.roll(loop, -first, axis=0), planes[first:] + planes[:first]
    rough = roughness(loop, long)
    if rough.any():
        share = np.minimum(1.0, rough / settings.rough)
        curved = _loop(flat, planes, settings.parts, settings)
        loop = loop + share[:, None] * (curved - loop)
        rough = share * roughness(loop, long, ANY_ROUGHNESS)
    return _between_ends(_steadied(loop, long, rough, settings), long, settings)


def _loop(
    flat: _Flat,
    planes: Sequence[tuple[Floats, float, float]],
    parts: int,
    settings: BottomOutlineSettings,
) -> Floats:
    """Where the edge is in each half plane, (n, 2), with faces of so many parts an edge."""
    points = [
        centre + _touched(flat, centre, angle, tilt, settings, parts) * _towards(angle)
        for centre, angle, tilt in planes
    ]
    return np.array(points)


def _steadied(loop: Floats, long: float, rough: Floats, settings: BottomOutlineSettings) -> Floats:
    """An outline without roughness; along its sides also without steps.

    Where a chamfer lies between bottom and wall, the line goes over from one of its edges to the
    other. An insole has no such step. The ends of a last may have corners.
    """
    steady = without_roughness(loop, long, rough)
    smooth = steady_loop(loop, long, SIDES)
    inside = np.minimum(
        steady[:, 0] - settings.heel * long, (1 - settings.toe) * long - steady[:, 0]
    )
    share = np.clip(inside / (settings.ramp * long), 0.0, 1.0)[:, None]
    return np.asarray(steady + share * (smooth - steady))


def _between_ends(loop: Floats, long: float, settings: BottomOutlineSettings) -> Floats:
    """An outline with its ends moved to where the measure has them: it is steadier there.

    What lies behind the heel's centre, or before that of the toe, moves by a part of the way.
    """
    x = loop[:, 0]
    ends = (
        ((settings.heel * long - x) / (settings.heel * long), -x.min()),
        ((x - (1.0 - settings.toe) * long) / (settings.toe * long), long - x.max()),
    )
    moved = loop.copy()
    for depth, way in ends:
        share = np.clip(depth / depth.max(), 0.0, 1.0)
        moved[:, 0] += way * share * share * (3.0 - 2.0 * share)
    return moved


def _towards(angle: float) -> Floats:
    return np.array([np.cos(angle), np.sin(angle)])


def _half_planes(
    flat: _Flat, frame: FlatFrame, settings: BottomOutlineSettings
) -> Iterator[tuple[Floats, float, float]]:
    """The centre (2,) of each half plane, its angle in plan, and how the wall leans there."""
    long = frame.length_mm
    heel_x, toe_x = settings.heel * long, (1.0 - settings.toe) * long
    heel, toe = (np.array([x, _middle(flat, x, settings)]) for x in (heel_x, toe_x))
    quarter = 0.5 * np.pi
    turns = np.linspace(-quarter, quarter, 1 + round(180.0 / settings.turn_deg))
    steps = np.linspace(0.0, 1.0, 2 + round((toe_x - heel_x) / (settings.step * long)))[1:-1]
    for share in steps:
        yield heel + share * (toe - heel), -quarter, 0.0
    for turn in turns:
        yield toe, float(turn), float(np.cos(turn)) ** 2 * frame.tilts[1]
    for share in steps:
        yield toe + share * (heel - toe), quarter, 0.0
    for turn in turns:
        yield heel, float(np.pi + turn), float(np.cos(turn)) ** 2 * frame.tilts[0]


def _middle(flat: _Flat, x: float, settings: BottomOutlineSettings) -> float:
    """The middle of the bottom across, at ``x``."""
    along, aside, _ = flat.vertices.T
    near = aside[flat.faces[np.abs(along[flat.faces[:, 0]] - x) < 0.05 * np.ptp(along)]]
    guess = 0.5 * float(near.min() + near.max())
    centre, quarter = np.array([x, guess]), 0.5 * np.pi
    medial = _touched(flat, centre, quarter, 0.0, settings)
    lateral = _touched(flat, centre, -quarter, 0.0, settings)
    return guess + 0.5 * (medial - lateral)


def _touched(
    flat: _Flat,
    centre: Floats,
    angle: float,
    tilt: float,
    settings: BottomOutlineSettings,
    parts: int = 1,
) -> float:
    """How far from a centre a line touches the bottom's edge from below, in one half plane.

    As the line with the normal n turns, its distance h changes by h' and n by n': it touches at
    h n + h' n'. Distances are steadier than the points of an edge. NaN if nothing is cut.
    """
    out, aside = np.array([*_towards(angle), 0.0]), np.array([*_towards(angle + 0.5 * np.pi), 0.0])
    origin = np.array([*centre, 0.0])
    level = float(aside @ origin)
    above = (flat.vertices @ aside > level)[flat.faces]
    crossed = flat.faces[above.any(axis=1) & ~above.all(axis=1)]
    points, pieces = flat.vertices, crossed
    if parts > 1:
        points, pieces = curved_pieces(points, flat.normals, crossed, parts)
    planes = Planes(np.array([level]), origin[None], aside[None])
    cut = plane_sections(points, pieces, points @ aside, planes).points.reshape(-1, 3) - origin
    section = np.column_stack([cut @ out, cut @ AXES[2]])
    section = section[section[:, 0] > 0.0]
    if not len(section):
        return float("nan")
    turn = np.radians(settings.touch_deg)
    normals = 0.5 * (tilt - 0.5 * np.pi) + np.array([-turn, 0.0, turn])
    before, reach, after = (section @ np.stack([np.cos(normals), np.sin(normals)])).max(axis=0)
    change = (after - before) / (2.0 * np.sin(turn))
    return float(reach * np.cos(normals[1]) - change * np.sin(normals[1]))
