"""Polygons cut into triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh, TooLarge
from footfit.geometry.numeric.arrays import Ints
from footfit.meshes.formats.raw import doubles
from footfit.meshes.read_limits import Limits

_EXACT = 2.0**53  # up to this size a double holds every integer


def fans(corners: Ints, counts: Ints, limits: Limits) -> Ints:
    """Each polygon cut into a fan around its first corner.

    Parameters
    ----------
    corners : (sum of counts,) int64
        The polygons' vertices, one polygon after the other.
    counts : (p,) int64
        How many corners each polygon has; with fewer than three it gives no triangle.
    limits : Limits

    Returns
    -------
    (m, 3) int64

    Raises
    ------
    TooLarge
        A polygon has more corners than ``limits.polygon_corners``; its fan would not be a surface.

    Examples
    --------
    >>> from footfit.meshes.read_limits import LIMITS
    >>> fans(np.array([0, 1, 2, 3, 4, 5, 6]), np.array([3, 4]), LIMITS).tolist()
    [[0, 1, 2], [3, 4, 5], [3, 5, 6]]
    """
    if len(counts) and counts.max() > limits.polygon_corners:
        raise TooLarge(
            f"a face has {int(counts.max()):,} corners and footfit reads up to"
            f" {limits.polygon_corners:,}: export triangles"
        )
    if len(counts) and (counts == 3).all():
        return corners.reshape(-1, 3)
    begins = np.cumsum(counts) - counts
    triangles = np.maximum(counts - 2, 0)
    base = np.repeat(begins, triangles)
    step = np.arange(len(base)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    fanned: Ints = corners[np.stack([base, base + step + 1, base + step + 2], axis=1)]
    return fanned


def whole(values: NDArray[np.generic]) -> Ints:
    """Indices as integers.

    Raises
    ------
    DamagedMesh
        An index is not a whole number.
    """
    if values.dtype.kind in "iu":
        return values.astype(
            np.int64
        )  # an index that wraps around is negative, and refused for that
    numbers = doubles(values)
    exact = np.abs(numbers) < _EXACT  # False for NaN
    if not exact.all() or (numbers != np.floor(numbers)).any():
        raise DamagedMesh("a face index is not a whole number: export the mesh again")
    return numbers.astype(np.int64)
