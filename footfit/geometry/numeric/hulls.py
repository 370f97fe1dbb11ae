"""Convex hulls in the plane: what a tape around a section touches, and how deep the rest lies."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats


def convex_hull(points: Floats) -> Floats:
    """The corners (h, 2) of the convex hull of points (n, 2), counter-clockwise (monotone chain).

    Examples
    --------
    >>> convex_hull(np.array([[0.0, 0], [2, 0], [1, 1], [2, 2], [0, 2]])).tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
    """
    ordered = points[np.lexsort((points[:, 1], points[:, 0]))].tolist()
    lower = _half_hull(ordered)
    upper = _half_hull(ordered[::-1])
    return np.array([*lower[:-1], *upper[:-1]], dtype=np.float64).reshape(-1, 2)


def _half_hull(ordered: list[list[float]]) -> list[list[float]]:
    """The lower half of the hull of points in lexicographic order."""
    chain: list[list[float]] = []
    for point in ordered:
        x, y = point
        while len(chain) > 1:
            (x1, y1), (x2, y2) = chain[-2], chain[-1]
            if (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1) > 0.0:
                break
            chain.pop()
        chain.append(point)
    return chain


def depth_under_hull(points: Floats, hull: Floats) -> Floats:
    """How deep points (n, 2) lie inside a convex hull (h, 2), counter-clockwise, (n,).

    Examples
    --------
    >>> square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    >>> depth_under_hull(np.array([[2.0, 1], [4, 2]]), square).tolist()
    [1.0, 0.0]
    """
    sides = np.roll(hull, -1, axis=0) - hull
    inward = np.column_stack([-sides[:, 1], sides[:, 0]]) / np.hypot(*sides.T)[:, None]
    return np.asarray((points @ inward.T - (hull * inward).sum(axis=1)).min(axis=1))
