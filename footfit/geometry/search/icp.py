"""Fitting poses to a template: what a pose costs, where a search starts, and ICP in batches.

A pose takes mesh coordinates p to the template's: q = scale * rotation p + shift, in units of L.
Arrays are float32: the fit only chooses among poses, the frame is refined in float64 afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints, row_lengths
from footfit.geometry.numeric.rotations import rotations_about
from footfit.geometry.search.templates import Singles, Template


@dataclass(frozen=True, slots=True)
class FitSettings:
    """Everything numeric of the fit; lengths over L."""

    far: float = 0.10  # a distance past this costs no more
    normal_weight: float = 0.25
    leg_height: float = 0.42  # above it a point costs at most leg_cost: any leg is harmless
    leg_cost: float = 0.35
    leg_share: float = 0.70  # a pose that calls more of the points leg is implausible
    low_height: float = 0.35  # the part that gives length and shift where a search starts
    least_length: float = 0.25  # of the mesh's size: a shorter length would make nearly all leg
    implausible_cost: float = 0.6
    icp_height: float = 0.47
    icp_quantile: float = 0.85
    normal_floor: float = 0.05
    point_weight: float = 0.15
    damping: float = 1e-6
    max_turn: float = 0.35
    max_shift: float = 0.20
    max_scale_step: float = 0.07
    scale_range: tuple[float, float] = (0.70, 1.35)


FIT = FitSettings()
_ROWS_AT_ONCE = 50
LEVI_CIVITA = np.zeros((3, 3, 3))
LEVI_CIVITA[[0, 1, 2], [1, 2, 0], [2, 0, 1]] = 1.0
LEVI_CIVITA[[0, 1, 2], [2, 0, 1], [1, 2, 0]] = -1.0


@dataclass(frozen=True, slots=True)
class Poses:
    """A batch of poses: ``rotation`` (k, 3, 3), ``shift`` (k, 3), ``scale`` (k,) = 1 / L."""

    rotation: Singles
    shift: Singles
    scale: Singles

    def at(self, index: Ints | Bools) -> Poses:
        """The poses at an index array or mask."""
        return Poses(self.rotation[index], self.shift[index], self.scale[index])


def joined_poses(parts: Sequence[Poses]) -> Poses:
    """Batches of poses as one."""
    return Poses(
        np.concatenate([part.rotation for part in parts]),
        np.concatenate([part.shift for part in parts]),
        np.concatenate([part.scale for part in parts]),
    )


def posed_points(poses: Poses, points: Singles) -> Singles:
    """Points (n, 3) under each pose, (k, n, 3)."""
    turned = points @ poses.rotation.transpose(0, 2, 1)
    return np.asarray(turned * poses.scale[:, None, None] + poses.shift[:, None, :])


def point_costs(away: Singles, cosine: Singles, height: Singles) -> Singles:
    """The cost of each point: distance, capped, plus the normals' disagreement; capped on a leg."""
    distance = np.sqrt(np.einsum("...i,...i->...", away, away))
    cost = np.minimum(distance, FIT.far) * np.float32(1 / FIT.far)
    cost += np.float32(FIT.normal_weight) * (1 - cosine)
    leg = height > FIT.leg_height
    return np.asarray(np.where(leg, np.minimum(cost, np.float32(FIT.leg_cost)), cost))


def forward_costs(poses: Poses, points: Singles, normals: Singles, template: Template) -> Singles:
    """The mean cost from the mesh's points (n, 3) to the template, per pose, (k,).

    A pose that would make nearly all of the mesh leg pays ``implausible_cost`` as well.
    """
    q = posed_points(poses, points)
    turned = normals @ poses.rotation.transpose(0, 2, 1)
    index = template.nearest(q)
    cosine = np.einsum("kni,kni->kn", turned, template.normals.take(index, axis=0))
    costs = point_costs(q - template.points.take(index, axis=0), cosine, q[..., 2])
    mostly_leg = (q[..., 2] > FIT.leg_height).mean(axis=1) > FIT.leg_share
    return np.asarray(costs.mean(axis=1) + np.float32(FIT.implausible_cost) * mostly_leg)


def size_of(points: Singles) -> float:
    """About the greatest extent of points (n, 3), in whatever pose."""
    away = points - points.mean(axis=0)
    return 2 * float(np.sqrt(np.einsum("ij,ij->i", away, away).max()))


def levelled_poses(rotations: Singles, points: Singles, middle_y: float) -> Poses:
    """Poses with given rotations; length and shift come from the mesh's low part, in two rounds."""
    x, y, z = np.moveaxis(points @ rotations.transpose(0, 2, 1), 2, 0)
    ground = z.min(axis=1)
    height = z - ground[:, None]
    back, front = x.min(axis=1), x.max(axis=1)
    low = np.ones(x.shape, dtype=bool)
    least = np.float32(FIT.least_length * size_of(points))
    for _ in range(2):
        low = height < FIT.low_height * np.maximum(front - back, least)[:, None]
        back = np.where(low, x, np.inf).min(axis=1)
        front = np.where(low, x, -np.inf).max(axis=1)
    left = np.where(low, y, -np.inf).max(axis=1)
    right = np.where(low, y, np.inf).min(axis=1)
    scale = 1 / np.maximum(front - back, least)
    shift = -np.stack([back, (left + right) / 2, ground], axis=1) * scale[:, None]
    shift[:, 1] += middle_y
    return Poses(rotations, shift.astype(np.float32), scale.astype(np.float32))


def icp_steps(
    poses: Poses, points: Singles, normals: Singles, template: Template, steps: int
) -> Poses:
    """The poses after some Gauss-Newton steps in rotation, shift and scale.

    The residual is point to plane plus a little point to point. The scale stays within
    ``scale_range`` of the one that a pose came with.
    """
    lowest, highest = (poses.scale * np.float32(factor) for factor in FIT.scale_range)
    for _ in range(steps):
        poses = _stepped(poses, _gauss_newton(poses, points, normals, template))
        poses = Poses(poses.rotation, poses.shift, np.clip(poses.scale, lowest, highest))
    return poses


def _gauss_newton(poses: Poses, points: Singles, normals: Singles, template: Template) -> Floats:
    """The step (k, 7) in turn, shift and logarithm of the scale, about the template's origin."""
    q = posed_points(poses, points)
    turned = normals @ poses.rotation.transpose(0, 2, 1)
    index = template.nearest(q)
    away = q - template.points.take(index, axis=0)
    plane = template.normals.take(index, axis=0)
    cosine = np.einsum("kni,kni->kn", turned, plane)
    costs = point_costs(away, cosine, q[..., 2])
    lower = int(FIT.icp_quantile * (costs.shape[1] - 1))  # as np.quantile
    bound = np.partition(costs, lower, axis=1)[:, lower, None]
    weight = np.clip(cosine, FIT.normal_floor, 1.0)
    weight *= (costs <= bound) & (q[..., 2] <= FIT.icp_height)
    normal = _plane_part(q, away, plane, weight) + FIT.point_weight * _point_part(q, away, weight)
    matrix = normal[:, :7, :7] + FIT.damping * weight.shape[1] * np.eye(7)
    return np.asarray(-np.linalg.solve(matrix, normal[:, :7, 7:])[..., 0])


def _plane_part(q: Singles, away: Singles, plane: Singles, weight: Singles) -> Floats:
    """Normal equations (k, 8, 8), the residual last, of the distances along ``plane``."""
    rows = np.empty((len(q), 8, q.shape[1]), dtype=np.float32)
    qx, qy, qz = (np.ascontiguousarray(q[..., i]) for i in range(3))
    nx, ny, nz = (np.ascontiguousarray(plane[..., i]) for i in range(3))
    rows[:, 0] = qy * nz - qz * ny  # (omega x q) . n = omega . (q x n)
    rows[:, 1] = qz * nx - qx * nz
    rows[:, 2] = qx * ny - qy * nx
    rows[:, 3], rows[:, 4], rows[:, 5] = nx, ny, nz
    rows[:, 6] = qx * nx + qy * ny + qz * nz
    rows[:, 7] = np.einsum("kni,kni->kn", away, plane)
    return np.asarray((rows * weight[:, None]) @ rows.transpose(0, 2, 1), dtype=np.float64)


def _point_part(q: Singles, away: Singles, weight: Singles) -> Floats:
    """Normal equations (k, 8, 8) of the distances point to point, from their moments alone."""
    rows = np.ones((len(q), 7, q.shape[1]), dtype=np.float32)
    rows[:, :3], rows[:, 3:6] = q.transpose(0, 2, 1), away.transpose(0, 2, 1)
    left = rows[:, [0, 1, 2, 6]] * weight[:, None]
    moments = (left @ rows.transpose(0, 2, 1)).astype(np.float64)
    qq, qe, wq = moments[:, :3, :3], moments[:, :3, 3:6], moments[:, 3, :3]
    we, total = moments[:, 3, 3:6], moments[:, 3, 6]
    squares = np.trace(qq, axis1=1, axis2=2)
    normal = np.zeros((len(q), 8, 8))
    normal[:, :3, :3] = squares[:, None, None] * np.eye(3) - qq
    normal[:, :3, 3:6] = np.einsum("ijl,kl->kij", LEVI_CIVITA, wq) * -1.0
    normal[:, 3:6, :3] = normal[:, :3, 3:6].transpose(0, 2, 1)
    normal[:, 3:6, 3:6] = total[:, None, None] * np.eye(3)
    normal[:, 3:6, 6] = normal[:, 6, 3:6] = wq
    normal[:, 6, 6] = squares
    normal[:, :3, 7] = np.einsum("ijl,kjl->ki", LEVI_CIVITA, qe)  # q x e
    normal[:, 3:6, 7] = we
    normal[:, 6, 7] = np.trace(qe, axis1=1, axis2=2)
    return normal


def _stepped(poses: Poses, step: Floats) -> Poses:
    """The poses after one step, shortened as a whole if a part of it is too long."""
    size = np.maximum(np.abs(step[:, 6]) / FIT.max_scale_step, 1.0)
    np.maximum(size, row_lengths(step[:, :3]) / FIT.max_turn, out=size)
    np.maximum(size, row_lengths(step[:, 3:6]) / FIT.max_shift, out=size)
    step = step / size[:, None]
    small = rotations_about(step[:, :3]).astype(np.float32)
    growth = np.exp(step[:, 6]).astype(np.float32)
    shift = growth[:, None] * np.einsum("kij,kj->ki", small, poses.shift) + step[:, 3:6]
    return Poses(small @ poses.rotation, shift.astype(np.float32), poses.scale * growth)


def reverse_cost(
    pose: Poses,
    points: Singles,
    normals: Singles,
    sparse: tuple[Singles, Singles],
    share: float,
) -> float:
    """The mean of the lowest ``share`` of costs from the template's points to the mesh, one pose.

    ``sparse`` are points and normals of the template; the nearest are found by comparing all.
    """
    q = posed_points(pose, points)[0]
    turned = normals @ pose.rotation[0].T
    sought, sought_normals = sparse
    index = _nearest_rows(sought, q)
    cosine = np.einsum("ij,ij->i", sought_normals, turned[index])
    costs = np.sort(point_costs(sought - q[index], cosine, sought[:, 2]))
    return float(costs[: max(1, int(share * len(costs)))].mean())


def _nearest_rows(points: Singles, among: Singles) -> Ints:
    """The index (k,) of the point among (n, 3) that is nearest to each of (k, 3), exactly.

    Few rows at a time: BLAS shares a product of all rows out to threads, which takes a hundred
    times as long as the product on a busy machine.
    """
    squares = np.einsum("ij,ij->i", among, among)
    columns = np.ascontiguousarray(np.column_stack([among, squares]).T)
    rows = np.column_stack([-2 * points, np.ones(len(points), dtype=np.float32)])
    starts = range(0, len(rows), _ROWS_AT_ONCE)
    return np.concatenate([(rows[i : i + _ROWS_AT_ONCE] @ columns).argmin(axis=1) for i in starts])
