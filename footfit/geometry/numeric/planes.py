"""Planes, and how they are fitted to points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class Plane:
    """The points with normal . x = offset; ``normal`` (3,) is a unit vector that looks up."""

    normal: Floats
    offset: float

    def heights(self, points: Floats) -> Floats:
        """Signed heights (n,) of points (n, 3) over the plane."""
        return points @ self.normal - self.offset


LEVEL = Plane(np.array([0.0, 0.0, 1.0]), 0.0)


class PlanePoints:
    """Points (n, 3) that planes are fitted to many times, with other weights each time.

    They are kept by columns, beside room for what is computed of them each time.
    """

    def __init__(self, points: Floats) -> None:
        self._points = np.asfortranarray(points)
        self._away, self._products = np.empty((2, 3, len(points)))

    def heights(self, plane: Plane) -> Floats:
        """Signed heights (n,) over a plane."""
        return plane.heights(self._points)

    def plane(self, weights: Floats, up: Floats) -> Plane:
        """The plane with the least weighted square distance, looking up."""
        centre = weights @ self._points / weights.sum()
        away = np.subtract(self._points.T, centre[:, None], out=self._away)
        moment = np.multiply(weights, away, out=self._products) @ away.T
        normal = np.linalg.eigh(moment)[1][:, 0]
        normal = normal * np.where(normal @ up < 0, -1.0, 1.0)
        return Plane(normal, float(normal @ centre))


def robust_plane(
    points: Floats, areas: Floats, scale: float, rounds: int, start: Plane | None = None
) -> Plane:
    """The plane that most of the points lie in, fitted with Cauchy weights.

    A point at the distance d counts with 1 / (1 + (d / scale)^2), so that a gap, a spike or another
    surface beside it does not tilt the plane.

    Parameters
    ----------
    points : (n, 3)
    areas : (n,)
        What each point stands for.
    scale : float
        In the points' unit.
    rounds : int
        How often the weights are taken from the plane before.
    start : Plane, optional
        Where to begin, and which way is up; otherwise the plane that all points fit best, looking
        along +Z.

    Examples
    --------
    >>> flat = np.array([[x, y, 0.0] for x in range(9) for y in range(9)])
    >>> flat[40, 2] = 5.0
    >>> plane = robust_plane(flat, np.ones(81), 0.1, 20)
    >>> bool(abs(plane.heights(flat)[0]) < 1e-3)
    True
    """
    known = PlanePoints(points)
    plane = known.plane(areas, LEVEL.normal) if start is None else start
    up = plane.normal
    for _ in range(rounds):
        weights = areas / (1.0 + np.square(known.heights(plane) / scale))
        plane = known.plane(weights, up)
    return plane
