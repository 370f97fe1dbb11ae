"""The canonical frame of a shape whose pose is roughly known: sole plane, plan axis, origin.

X from heel to toe, Z up, Y to the wearer's left, in mm. x = 0 is where the rearmost 0.3 % of the
low area end, y = 0 is the heel's middle, z = 0 is the contact plane.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.samples import SurfaceSample
from footfit.geometry.numeric.angles import angle_between
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.planes import LEVEL, Plane
from footfit.geometry.numeric.quantiles import area_quantile
from footfit.geometry.pose.resting_line import (
    RESTING,
    bottom_of,
    heeled_share,
    resting_line,
    resting_plane,
    slope_across,
    thinned,
)
from footfit.geometry.pose.sole_plane import FLOOR, rim_plane, sole_plane, support


@dataclass(frozen=True, slots=True)
class FrameSettings:
    """Everything numeric of the refinement and the origin; lengths over L."""

    rounds: int = 2
    still: float = 1e-4  # rad; after so small a turn another round moves the frame by 1e-9 rad
    axis_height: float = 0.15  # the plan axis is taken below, so that a leg does not move it
    axis_softness: float = 0.01
    length_height: float = 0.30
    toes: float = 0.30  # so far back from the foremost low point a last has toes, at any height
    heeled_back: float = 0.10  # the back of a heeled last is taken below: over it, it leans back
    support_minimum: float = 0.05
    tilt_maximum_deg: float = 16.0
    heeled_tilt_deg: float = 6.0  # more for a last on its resting line, which holds from 20 deg
    origin_share: float = 0.003
    origin_height: float = 0.20
    heel_strip: tuple[float, float] = (0.02, 0.10)
    heel_strips: int = 8


FRAME = FrameSettings()


@dataclass(frozen=True, slots=True)
class CanonicalFrame:
    """The frame: canonical = rotation @ p + shift, in the unit of p.

    ``length`` is the extent along X, of the toes below ``length_height`` and of the heel below
    ``back_height``, over L; ``sole`` is False if there is no sole and the frame rests on the rim.
    """

    rotation: Floats
    shift: Floats
    length: float
    support: float
    sole: bool
    back_height: float


def canonical_frame(
    sample: SurfaceSample, length: float, *, last: bool = False, level: bool = True
) -> CanonicalFrame:
    """The canonical frame of a sample in an approximate canonical pose.

    Parameters
    ----------
    sample : SurfaceSample
        Points of the whole surface with areas, x roughly heel to toe, z up, ground near z = 0.
    length : float
        Its approximate length, in the sample's unit.
    last : bool
        Whether it is a last, which rests on its seat and its tread if its heel is raised.
    level : bool
        Whether a last is turned level across its tread in the end. A frame that is found from this
        one begins with the sole plane again, so it should not be.
    """
    standing_plane = _last_plane if last else _sole_plane
    rotation, plane, share = _settled(sample, length, standing_plane)
    tilt_deg = float(np.degrees(angle_between(rotation[2], LEVEL.normal)))
    turned = turned_sample(sample, rotation)
    if last and level:
        turn, plane = _level_across(turned, plane.offset, length)
        rotation, turned = turn @ rotation, turned_sample(turned, turn)
    back_height = FRAME.length_height + share * (FRAME.heeled_back - FRAME.length_height)
    length = length_of(turned.points, plane.offset, length, back_height)
    held = support(turned, plane, length)
    most_deg = FRAME.tilt_maximum_deg + share * FRAME.heeled_tilt_deg
    sole = held >= FRAME.support_minimum and tilt_deg <= most_deg
    if not sole:
        rotation, plane, _ = _settled(sample, length, _rim_plane)
        turned = turned_sample(sample, rotation)
        back_height = FRAME.length_height
        length = length_of(turned.points, plane.offset, length, back_height)
    shift = origin_shift(turned, plane.offset, length, sole)
    return CanonicalFrame(rotation, shift, length, held, sole, back_height)


def turned_sample(sample: SurfaceSample, rotation: Floats) -> SurfaceSample:
    """The sample with points and normals turned by a rotation (3, 3)."""
    return SurfaceSample(sample.points @ rotation.T, sample.normals @ rotation.T, sample.areas)


def length_of(points: Floats, ground: float, length: float, back_height: float) -> float:
    """The extent along x of points (n, 3) below the leg; the heel's back below ``back_height``."""
    x, height = points[:, 0], points[:, 2] - ground
    low, back = x[height < FRAME.length_height * length], x[height < back_height * length]
    return float(low.max() - back.min()) if len(back) else 0.0


def toe_beyond(points: Floats, length: float) -> float:
    """How far the toe of a last reaches beyond what is below ``length_height``, of points (n, 3).

    As a last with a heel over 95 mm rests, its toe lies higher.
    """
    x = points[:, 0]
    low = float(x[points[:, 2] < FRAME.length_height * length].max())
    return float(x[x > low - FRAME.toes * length].max()) - low


def _sole_plane(sample: SurfaceSample, length: float, start: Plane) -> tuple[Plane, float]:
    return sole_plane(sample, length, start), 0.0


def _rim_plane(sample: SurfaceSample, length: float, _: Plane) -> tuple[Plane, float]:
    return rim_plane(sample, length), 0.0


def _last_plane(sample: SurfaceSample, length: float, start: Plane) -> tuple[Plane, float]:
    """The plane of a last, and how much of it is the resting plane of one with a raised heel."""
    line = resting_line(bottom_of(thinned(sample), start.offset, length))
    share = heeled_share(line, length)
    if line is None or share == 0.0:
        return sole_plane(sample, length, start), 0.0
    resting = resting_plane(bottom_of(sample, start.offset, length), line, length)
    if share == 1.0:
        return resting, share
    low = sole_plane(sample, length, start)
    normal = share * resting.normal + (1.0 - share) * low.normal
    offset = share * resting.offset + (1.0 - share) * low.offset
    return Plane(normal / np.linalg.norm(normal), offset), share


def _level_across(sample: SurfaceSample, ground: float, length: float) -> tuple[Floats, Plane]:
    """What a last whose frame is nearly settled must still be turned by, and its plane then.

    The sole plane follows the arch, which is higher on one side: it rolls by 1 to 4 degrees. The
    place of the tread is read in a frame that no longer depends on the pose, so the turn does not.
    """
    bottom = bottom_of(sample, ground, length)
    across = slope_across(bottom, bottom.points[:, 2] - ground, length)
    normal = np.array([0.0, -across, 1.0])
    level = levelling(normal / np.linalg.norm(normal))
    touching = area_quantile(bottom.points @ level[2], bottom.areas, RESTING.contact_share)
    return level, Plane(LEVEL.normal, touching)


def _settled(
    sample: SurfaceSample,
    length: float,
    standing_plane: Callable[[SurfaceSample, float, Plane], tuple[Plane, float]],
) -> tuple[Floats, Plane, float]:
    """The rotation that puts plane and axis in place, the plane after it, and its share."""
    rotation, share = np.eye(3), 0.0
    turned, plane = sample, LEVEL
    for _ in range(FRAME.rounds):
        tilted, share = standing_plane(turned, length, plane)
        level = levelling(tilted.normal)
        plane = Plane(LEVEL.normal, tilted.offset)
        axis = plan_axis(turned.points @ level.T, sample.areas, plane.offset, length)
        turn = about_z(axis) @ level
        rotation = turn @ rotation
        turned = turned_sample(sample, rotation)
        if np.abs(turn - np.eye(3)).max() < FRAME.still:
            break
    return rotation, plane, share


def levelling(normal: Floats) -> Floats:
    """The smallest rotation (3, 3) that takes a unit vector (3,), not -Z, to Z."""
    x, y, z = normal
    f = 1 / (1 + z)
    return np.array([[1 - x * x * f, -x * y * f, -x], [-x * y * f, 1 - y * y * f, -y], [x, y, z]])


def about_z(axis: Floats) -> Floats:
    """The rotation (3, 3) about Z that takes a plan direction (2,) to X."""
    c, s = axis / np.hypot(*axis)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def plan_axis(points: Floats, areas: Floats, ground: float, length: float) -> Floats:
    """The direction (2,) of the low part's longest plan extent, heel to toe: 2-D PCA by area."""
    height = (points[:, 2] - ground) / length
    steepness = np.clip((height - FRAME.axis_height) / FRAME.axis_softness, -50, 50)
    weights = areas / (1 + np.exp(steepness))
    plan = points[:, :2]
    away = plan - weights @ plan / weights.sum()
    axis = np.linalg.eigh((weights[:, None] * away).T @ away)[1][:, 1]
    return np.asarray(axis * np.where(axis[0] < 0, -1.0, 1.0))


def origin_shift(sample: SurfaceSample, ground: float, length: float, sole: bool) -> Floats:
    """The shift (3,) that puts the origin at the heel, in a sample that is turned already.

    Quantiles of area are used, because the rearmost or lowest vertex moves by millimetres.
    """
    points = sample.points
    height = points[:, 2] - ground
    low = height < FRAME.origin_height * length
    x0 = area_quantile(points[low, 0], sample.areas[low], FRAME.origin_share)
    z0 = ground
    if sole:
        down = (height < FLOOR.support_height * length) & (sample.normals[:, 2] < -0.5)
        z0 = area_quantile(points[down, 2], sample.areas[down], FRAME.origin_share)
    y0 = _heel_middle(points[low], x0, length)
    return -np.array([x0, y0, z0])


def _heel_middle(points: Floats, x0: float, length: float) -> float:
    """The mean of the middles in y of strips across the heel."""
    edges = x0 + np.linspace(*FRAME.heel_strip, FRAME.heel_strips + 1) * length
    points = points[(points[:, 0] > edges[0]) & (points[:, 0] <= edges[-1])]
    strip = np.searchsorted(edges, points[:, 0]) - 1
    middles = [
        0.5 * (points[strip == i, 1].min() + points[strip == i, 1].max())
        for i in range(FRAME.heel_strips)
        if np.any(strip == i)
    ]
    return float(np.mean(middles)) if middles else 0.0
