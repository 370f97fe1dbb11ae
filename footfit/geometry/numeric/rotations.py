"""Rotations and rigid transforms: grids over all rotations, small rotations, angles."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, row_lengths

# The real root of psi^4 = psi + 4 (Alexa, "Super-Fibonacci Spirals", CVPR 2022).
SUPER_FIBONACCI_PSI = 1.533751168755204


def rotation_matrices(quaternions: Floats) -> Floats:
    """The rotation matrices (k, 3, 3) of unit quaternions (k, 4), whose scalar part comes last.

    Examples
    --------
    >>> rotation_matrices(np.array([[0.0, 0.0, 0.0, 1.0]]))[0].tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    x, y, z, w = np.asarray(quaternions, dtype=np.float64).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def super_fibonacci(count: int) -> Floats:
    """Rotation matrices (count, 3, 3) that lie evenly over all rotations.

    Alexa, "Super-Fibonacci Spirals: Fast, Low-Discrepancy Sampling of SO(3)", CVPR 2022.
    """
    s = np.arange(count) + 0.5
    alpha = 2 * np.pi * s / np.sqrt(2.0)
    beta = 2 * np.pi * s / SUPER_FIBONACCI_PSI
    inner, outer = np.sqrt(s / count), np.sqrt(1 - s / count)
    return rotation_matrices(
        np.stack(
            [
                inner * np.sin(alpha),
                inner * np.cos(alpha),
                outer * np.sin(beta),
                outer * np.cos(beta),
            ],
            axis=1,
        )
    )


def rotations_about(vectors: Floats) -> Floats:
    """Rotation matrices (k, 3, 3) about the ``vectors`` (k, 3), by their lengths in radians.

    Examples
    --------
    >>> rotations_about(np.array([[0.0, 0.0, np.pi / 2]]))[0].round(9).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    vectors = np.asarray(vectors, dtype=np.float64)
    angle = row_lengths(vectors)
    half_sinc = 0.5 * np.sinc(angle / (2 * np.pi))
    return rotation_matrices(
        np.concatenate([vectors * half_sinc[:, None], np.cos(angle / 2)[:, None]], 1)
    )


def angle_deg(first: Floats, second: Floats) -> float:
    """The angle in degrees by which one rotation (3, 3) differs from another.

    It is taken by atan2 of the skew part and the trace, which is exact near 0; arccos is not.

    Examples
    --------
    >>> small = rotations_about(np.array([[1e-9, 0.0, 0.0]]))[0]
    >>> round(np.radians(angle_deg(np.eye(3), small)).item(), 15)
    1e-09
    """
    between = np.asarray(first, dtype=np.float64).T @ np.asarray(second, dtype=np.float64)
    skew = (between - between.T)[[2, 0, 1], [1, 2, 0]]
    return float(np.degrees(np.arctan2(np.linalg.norm(skew), np.trace(between) - 1)))


def nearest_rotation(matrix: Floats) -> Floats:
    """The rotation (3, 3) nearest to a matrix (3, 3) with positive determinant."""
    u, _, vt = np.linalg.svd(np.asarray(matrix, dtype=np.float64))
    return np.asarray(u @ vt, dtype=np.float64)


def transform(rotation: Floats, shift: Floats, scale: float = 1.0) -> Floats:
    """The (4, 4) matrix of x -> scale * rotation x + shift."""
    result = np.eye(4)
    result[:3, :3] = scale * np.asarray(rotation)
    result[:3, 3] = shift
    return result


def moved_points(transform_4x4: Floats, points: Floats) -> Floats:
    """Points (n, 3), moved by a (4, 4) affine transform."""
    return points @ transform_4x4[:3, :3].T + transform_4x4[:3, 3]
