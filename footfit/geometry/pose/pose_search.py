"""Which way up and which way forward: the pose of a foot or last among all poses, by shape.

A coarse search over all rotations, ICP from the best, and a choice that also says by how much the
next best pose is worse. Left or right is decided afterwards (``side.py``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.mesh.samples import even_sample, farthest_points
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.rotations import nearest_rotation, rotations_about, super_fibonacci
from footfit.geometry.pose.icp import (
    FIT,
    FitSettings,
    Poses,
    forward_costs,
    icp_steps,
    joined,
    levelled,
    reverse_cost,
    size_of,
)
from footfit.geometry.pose.templates import ReferenceShape, ReferenceShapes, Singles

MIRROR = np.diag([1.0, -1.0, 1.0])


@dataclass(frozen=True, slots=True)
class OrientationSettings:
    """Everything numeric of the search."""

    fit: FitSettings = FIT
    rotations: int = 576
    more_rotations: int = 1728
    sample_points: int = 1500
    few_points: int = 256
    coarse_points: int = 128
    kept_coarse: int = 24
    icp_rounds: tuple[tuple[int, int], ...] = ((4, 10), (8, 10))  # steps, poses kept after them
    kept_poses: int = 4
    apart_deg: float = 25.0
    final_steps: int = 10
    final_stride: int = 3
    rival_deg: float = 37.0
    rival_steps: int = 14
    rivals_finished: int = 2
    middle: tuple[float, float] = (0.5, 0.17)  # x and z that a rival is turned about
    reverse_height: float = 0.30
    reverse_points: int = 400
    reverse_share: float = 0.75
    reverse_normal: float = -1.0  # points whose normal's z lies below it are not looked for
    retry_cost: float = 0.40
    retry_margin: float = 0.07
    cost_maximum: float = 0.62
    margin_minimum: float = 0.04
    doubtful_cost: float = 0.42
    margin_per_cost: float = 1.5
    margin_without_rival: float = 1.0  # only where even the turned poses fall back to the winner
    long_leg: float = 0.70  # over L: a scan that reaches higher is searched again
    crop: float = 0.60  # without what lies higher than this


ORIENTATION = OrientationSettings()
SOLELESS = OrientationSettings(reverse_normal=-0.5, cost_maximum=0.50)
"""For a scan whose sole is missing: the reference's sole is not looked for in it."""


@dataclass(frozen=True, slots=True)
class Orientation:
    """The pose that fits best: canonical is about rotation @ p + shift, in the mesh's unit.

    ``length`` is approximate; ``cost`` and ``margin`` are those of :class:`PoseQuality`; ``kind``
    is the reference shape that fits best; ``accepted`` says whether it is a foot or last at all.
    """

    rotation: Floats
    shift: Floats
    length: float
    cost: float
    margin: float
    kind: str
    accepted: bool


@dataclass(frozen=True, slots=True)
class _Cloud:
    """The mesh as the fit sees it: few points, then more; float32, perhaps mirrored."""

    few: Singles
    few_normals: Singles
    many: Singles
    many_normals: Singles


@dataclass(frozen=True, slots=True)
class _Candidate:
    pose: Poses
    shape: ReferenceShape
    mirrored: bool
    cost: float


def orientation(
    vertices: Floats,
    faces: Ints,
    references: ReferenceShapes,
    windows: tuple[tuple[float, float], ...] = (),
    settings: OrientationSettings = ORIENTATION,
) -> Orientation:
    """The pose of a mesh, by the fit to the reference shapes.

    Where the pose found has a long leg, the search is made again without it: a leg takes points
    from the foot and adds cost.

    Parameters
    ----------
    vertices, faces : (n, 3) float64, (m, 3) int64
        Outward winding.
    references : ReferenceShapes
    windows : pairs of float
        Lengths, in the mesh's unit, that are plausible; poses with another length are taken last.
        Empty: any length.
    """
    found = _found(vertices, faces, references, windows, settings)
    height = (vertices @ found.rotation[2] + found.shift[2]) / found.length
    if height.max() < settings.long_leg:
        return found
    low = height[faces].max(axis=1) < settings.crop
    if not low.any():
        return found
    again = _found(vertices, faces[low], references, windows, settings)
    return min(found, again, key=lambda one: (not one.accepted, one.cost))


def _found(
    vertices: Floats,
    faces: Ints,
    references: ReferenceShapes,
    windows: tuple[tuple[float, float], ...],
    settings: OrientationSettings,
) -> Orientation:
    """The pose of a mesh as it is, searched more finely where the first search leaves a doubt."""
    centre = _centre(vertices[faces].reshape(-1, 3))
    clouds = _clouds(vertices - centre, faces, settings)
    candidates = _candidates(clouds, references, windows, settings.rotations, settings)
    found = _chosen(candidates, settings)
    if found.cost > settings.retry_cost or found.margin < settings.retry_margin:
        candidates += _candidates(clouds, references, windows, settings.more_rotations, settings)
        candidates += _rivals(candidates, clouds, windows, settings)
        found = _chosen(candidates, settings)
    elif found.margin == settings.margin_without_rival:
        candidates += _rivals(candidates, clouds, windows, settings)
        found = _chosen(candidates, settings)
    return replace(found, shift=found.shift - found.rotation @ centre)


def _centre(vertices: Floats) -> Floats:
    """The middle of the box (3,): about it float32 loses nothing, wherever the origin is."""
    return np.asarray(0.5 * (vertices.min(axis=0) + vertices.max(axis=0)))


def _clouds(vertices: Floats, faces: Ints, settings: OrientationSettings) -> tuple[_Cloud, _Cloud]:
    """The mesh, about its middle, as it is and mirrored."""
    sample = even_sample(vertices, faces, settings.sample_points)
    few = farthest_points(sample.points, settings.few_points)
    points = sample.points.astype(np.float32)
    normals = sample.normals.astype(np.float32)
    flip = MIRROR.astype(np.float32)
    return (
        _Cloud(points[few], normals[few], points, normals),
        _Cloud((points @ flip)[few], (normals @ flip)[few], points @ flip, normals @ flip),
    )


def _candidates(
    clouds: tuple[_Cloud, _Cloud],
    references: ReferenceShapes,
    windows: tuple[tuple[float, float], ...],
    count: int,
    settings: OrientationSettings,
) -> list[_Candidate]:
    """The best few poses per reference over both mirrors, fitted with all points."""
    rotations = super_fibonacci(count).astype(np.float32)
    result = []
    for shape in references.shapes:
        start = _coarse(clouds[0], shape, rotations, windows, settings)
        starts = start, mirror_image(start, shape.middle_y)
        found = [
            _searched(cloud, shape, poses, windows, settings)
            for cloud, poses in zip(clouds, starts, strict=True)
        ]
        costs = np.concatenate([cost for _, cost in found])
        poses = joined(*(pose for pose, _ in found))
        mirrored = np.repeat([False, True], [len(cost) for _, cost in found])
        for place in np.argsort(costs, kind="stable")[: settings.kept_poses]:
            cloud = clouds[int(mirrored[place])]
            pose = poses.at(np.array([place]))
            result.append(_finished(pose, cloud, shape, bool(mirrored[place]), settings))
    return result


def _rivals(
    candidates: list[_Candidate],
    clouds: tuple[_Cloud, _Cloud],
    windows: tuple[tuple[float, float], ...],
    settings: OrientationSettings,
) -> list[_Candidate]:
    """The best of each reference turned upside down, on its sides and end for end, and fitted.

    Which poses the search keeps depends on the pose the mesh came in; where all of them lie in
    one valley the margin would measure nothing. The turned ones are there whatever was kept.
    """
    result = []
    for kind in dict.fromkeys(candidate.shape.kind for candidate in candidates):
        best = min((c for c in candidates if c.shape.kind == kind), key=lambda one: one.cost)
        cloud = clouds[int(best.mirrored)]
        poses = turned_about(best.pose, _turns(), best.shape.middle_y, settings.middle)
        poses = icp_steps(
            poses, cloud.few, cloud.few_normals, best.shape, settings.rival_steps, settings.fit
        )
        costs = forward_costs(poses, cloud.few, cloud.few_normals, best.shape, settings.fit)
        limits = _limits(cloud.few, windows, settings.fit)
        costs += np.where(plausible(1 / poses.scale, limits), 0.0, settings.fit.implausible_cost)
        for place in np.argsort(costs, kind="stable")[: settings.rivals_finished]:
            pose = poses.at(np.array([place]))
            result.append(_finished(pose, cloud, best.shape, best.mirrored, settings))
    return result


def _turns() -> Singles:
    """The seven turns (7, 3, 3), but for the identity, that leave the line of X in place."""
    half = np.diag([-1.0, -1.0, 1.0])
    rolls = [
        rotations_about(np.array([[angle, 0.0, 0.0]]))[0] for angle in np.pi / 2 * np.arange(4)
    ]
    every = [roll @ end for end in (np.eye(3), half) for roll in rolls]
    return np.array(every[1:], dtype=np.float32)


def turned_about(
    pose: Poses, turns: Singles, middle_y: float, middle: tuple[float, float]
) -> Poses:
    """One pose turned (k, 3, 3) about the middle of the shape, as k poses."""
    centre = np.array([middle[0], middle_y, middle[1]], dtype=np.float32)
    rotation = np.asarray(turns @ pose.rotation[0])
    shift = (pose.shift[0] - centre) @ turns.transpose(0, 2, 1) + centre
    return Poses(rotation, np.asarray(shift), np.repeat(pose.scale, len(turns)))


def _coarse(
    cloud: _Cloud,
    shape: ReferenceShape,
    rotations: Singles,
    windows: tuple[tuple[float, float], ...],
    settings: OrientationSettings,
) -> Poses:
    """The cheapest of all rotations, length and shift taken from the mesh's low part.

    Of the mesh as it is only: a left foot lies on a right reference well enough to start from.
    """
    fit, few = settings.fit, settings.coarse_points
    poses = levelled(rotations, cloud.few, shape.middle_y, fit)
    costs = forward_costs(poses, cloud.few[:few], cloud.few_normals[:few], shape, fit)
    limits = _limits(cloud.few, windows, fit)
    costs = costs + fit.implausible_cost * ~plausible(1 / poses.scale, limits)
    return poses.at(np.argsort(costs, kind="stable")[: settings.kept_coarse])


def mirror_image(poses: Poses, middle_y: float) -> Poses:
    """The poses (of the mirrored mesh) that leave it where the mesh is, but mirrored in place."""
    flip = MIRROR.astype(np.float32)
    shift = poses.shift * np.diag(flip)
    shift[:, 1] += np.float32(2 * middle_y)
    return Poses(np.asarray(flip @ poses.rotation @ flip), shift, poses.scale)


def _searched(
    cloud: _Cloud,
    shape: ReferenceShape,
    poses: Poses,
    windows: tuple[tuple[float, float], ...],
    settings: OrientationSettings,
) -> tuple[Poses, Singles]:
    """Poses of one cloud on one reference after ICP, in two halves, and their costs."""
    points, normals, fit = cloud.few, cloud.few_normals, settings.fit
    limits = _limits(points, windows, fit)
    costs = np.zeros(len(poses.scale), dtype=np.float32)
    for steps, kept in settings.icp_rounds:
        poses = icp_steps(poses, points, normals, shape, steps, fit)
        costs = forward_costs(poses, points, normals, shape, fit)
        costs += np.where(plausible(1 / poses.scale, limits), 0.0, fit.implausible_cost)
        best = np.argsort(costs, kind="stable")[:kept]
        poses, costs = poses.at(best), costs[best]
    apart = _apart(poses, costs, settings)
    return poses.at(apart), costs[apart]


def _limits(
    points: Singles, windows: tuple[tuple[float, float], ...], fit: FitSettings
) -> tuple[tuple[float, float], ...]:
    """The windows, without the lengths for which nearly all of the mesh would be leg."""
    least = 1.001 * fit.least_length * size_of(points)
    whole = windows or ((0.0, np.inf),)
    return tuple((max(low, least), high) for low, high in whole)


def plausible(lengths: Floats | Singles, windows: tuple[tuple[float, float], ...]) -> Bools:
    """Whether each length lies in one of the windows; all do where there are none."""
    if not windows:
        return np.ones(np.shape(lengths), dtype=bool)
    inside = [(low < lengths) & (lengths < high) for low, high in windows]
    return np.asarray(np.any(inside, axis=0))


def _apart(poses: Poses, costs: Singles, settings: OrientationSettings) -> Ints:
    """Indices of the cheapest poses that differ by more than ``apart_deg`` from a cheaper one."""
    rotations = poses.rotation
    traces = np.einsum("aij,bij->ab", rotations, rotations)
    near = traces > 1 + 2 * np.cos(np.radians(settings.apart_deg))
    kept: list[int] = []
    for place in np.argsort(costs, kind="stable"):
        if len(kept) < settings.kept_poses and not near[place, kept].any():
            kept.append(int(place))
    return np.array(kept, dtype=np.int64)


def _finished(
    pose: Poses,
    cloud: _Cloud,
    shape: ReferenceShape,
    mirrored: bool,
    settings: OrientationSettings,
) -> _Candidate:
    points, normals, fit = cloud.many, cloud.many_normals, settings.fit
    every = slice(None, None, settings.final_stride)
    pose = icp_steps(pose, points[every], normals[every], shape, settings.final_steps, fit)
    forward = float(forward_costs(pose, points, normals, shape, fit)[0])
    sought = shape.normals[:, 2] >= settings.reverse_normal
    low = np.flatnonzero(sought & (shape.points[:, 2] < settings.reverse_height))
    low = low[np.linspace(0, len(low) - 1, settings.reverse_points).astype(int)]
    sparse = shape.points[low], shape.normals[low]
    back = reverse_cost(pose, points, normals, sparse, settings.reverse_share, fit)
    return _Candidate(pose, shape, mirrored, forward + back)


def _chosen(candidates: list[_Candidate], settings: OrientationSettings) -> Orientation:
    """The cheapest candidate, and its margin to the cheapest that points elsewhere."""
    order = sorted(candidates, key=lambda candidate: candidate.cost)
    winner = order[0]
    rotation = _unmirrored(winner)
    limit = np.cos(np.radians(settings.rival_deg))
    rivals = [
        other.cost
        for other in order
        if any(_unmirrored(other)[axis] @ rotation[axis] < limit for axis in (0, 2))
    ]
    margin = rivals[0] - winner.cost if rivals else settings.margin_without_rival
    length = 1 / float(winner.pose.scale[0])
    shift = winner.pose.shift[0].astype(np.float64) * length
    return Orientation(
        rotation=nearest_rotation(rotation),
        shift=MIRROR @ shift if winner.mirrored else shift,
        length=length,
        cost=winner.cost,
        margin=margin,
        kind=winner.shape.kind,
        accepted=is_accepted(winner.cost, margin, settings),
    )


def is_accepted(cost: float, margin: float, settings: OrientationSettings = ORIENTATION) -> bool:
    """Whether a pose is that of a foot or last: the worse it fits, the clearer it must be.

    Cost alone does not tell: a cylinder has .55, an ellipsoid .55; their margins are below .03.
    """
    extra = settings.margin_per_cost * max(0.0, cost - settings.doubtful_cost)
    return cost <= settings.cost_maximum and margin >= settings.margin_minimum + extra


def _unmirrored(candidate: _Candidate) -> Floats:
    """The candidate's rotation for the mesh as it is: mirrored before and after, if at all."""
    rotation = candidate.pose.rotation[0].astype(np.float64)
    return np.asarray(MIRROR @ rotation @ MIRROR) if candidate.mirrored else rotation
