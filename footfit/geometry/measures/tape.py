"""Girths: what a tape reads around a section, the perimeter of its convex hull."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from footfit.geometry.mesh.outlines import Outline
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.hulls import convex_hull


class Crown(NamedTuple):
    """The section (y, z) across the shape at ``x_mm``; its highest place is where a tape lies."""

    section: Outline
    x_mm: float
    deep_mm: float

    @property
    def place(self) -> Floats:
        """The highest place, (3,); on a flat top it is the middle of what is highest."""
        y, z = self.section.points.T
        top_mm = z.max()
        weight = np.maximum(z - (top_mm - self.deep_mm), 0.0)
        return np.array([self.x_mm, float(y @ weight / weight.sum()), top_mm])


def hull_girth(points: Floats) -> float:
    """The perimeter of the convex hull of points (n, 2): a tape bridges what is hollow.

    Examples
    --------
    >>> hull_girth(np.array([[0.0, 0], [3, 0], [1, 1], [0, 4]]))
    12.0
    """
    hull = convex_hull(points)
    return float(np.linalg.norm(np.roll(hull, -1, axis=0) - hull, axis=1).sum())
