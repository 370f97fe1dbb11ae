"""How girths and widths answer to a small change of a last: on the few faces that they run over.

A whole measure finds its landmarks first. A probe keeps the plane and the places that the measure
found, so that its differences are quick and smooth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.least_tape import RoughGirths
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats, Ints

NEAR_MM = 2.0
"""A girth's probe keeps the faces that come so near to its plane."""
DIRECTIONS = 180


@dataclass(frozen=True, slots=True)
class Probe:
    """A number, in mm, of the vertices ``rows`` (k,): ``value`` takes their places (k, 3)."""

    rows: Ints
    value: Callable[[Floats], float]


def girth_probe(
    vertices_mm: Floats, faces: Ints, origin: Floats, axes: Floats, reach_mm: float = np.inf
) -> Probe:
    """The girth in the plane through ``origin`` (3,) along ``axes`` (2, 3)."""
    height = (vertices_mm - origin) @ cross(*axes)
    corners = height[faces]
    cut = (corners.min(axis=1) < NEAR_MM) & (corners.max(axis=1) > -NEAR_MM)
    rows, near = np.unique(faces[cut], return_inverse=True)
    triangles = near.reshape(-1, 3).astype(np.int64)

    def value(points: Floats) -> float:
        return RoughGirths(Shape(points, triangles), origin, DIRECTIONS, reach_mm).at(axes)

    return Probe(rows.astype(np.int64), value)


def span_probe(vertices_mm: Floats, start: Floats, end: Floats, direction: Floats) -> Probe:
    """How far the vertex next to ``end`` (3,) lies beyond that next to ``start``, along a unit
    vector ``direction`` (3,).
    """
    rows = [int(np.argmin(((vertices_mm - at) ** 2).sum(axis=1))) for at in (start, end)]
    return Probe(
        np.array(rows, dtype=np.int64), lambda points: float((points[1] - points[0]) @ direction)
    )
