"""Shapes as they are drawn: on their own side, the sole in plan, the profile from the side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.sections import extremes_below, highest, lowest, sections_across
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.results import Comparison, Profiled, SideName

Mesh = tuple[Floats, Ints]
"""Vertices (n, 3) in canonical mm, and faces (m, 3)."""


@dataclass(frozen=True, slots=True)
class Drawing:
    """How an outline is read: how many stations, how high the sole is, how far from the ends.

    ``band`` and ``inset`` are shares of the length.
    """

    stations: int = 160
    band: float = 0.10
    inset: float = 0.002


DRAWING = Drawing()
SHADOW = 10.0
"""A band as high as any shape: the outline of the whole shape's shadow."""


@dataclass(frozen=True, slots=True)
class Outline:
    """Two edges of a shape at ``x_mm`` (n,): medial and lateral in plan, or low and high."""

    x_mm: Floats
    first_mm: Floats
    second_mm: Floats

    def closed(self) -> Floats:
        """The outline as a polygon (2n, 2), without the stations where nothing is cut."""
        known = np.isfinite(self.first_mm) & np.isfinite(self.second_mm)
        there = np.column_stack([self.x_mm[known], self.first_mm[known]])
        back = np.column_stack([self.x_mm[known], self.second_mm[known]])
        return np.concatenate([there, back[::-1]])

    def between(self, start_mm: float, end_mm: float) -> Outline:
        """The part of the outline from ``start_mm`` to ``end_mm`` along X."""
        kept = (self.x_mm >= start_mm) & (self.x_mm <= end_mm)
        return Outline(self.x_mm[kept], self.first_mm[kept], self.second_mm[kept])


def ring(points: Floats) -> Floats:
    """A closed polygon (n, 2) with its first corner again at its end (n + 1, 2)."""
    return np.concatenate([points, points[:1]])


def sole_outline(vertices_mm: Floats, faces: Ints, band: float = DRAWING.band) -> Outline:
    """The two edges of the sole: each section's extremes across, up to ``band`` of the length.

    Parameters
    ----------
    vertices_mm : (n, 3)
        Canonical frame, either side.
    faces : (m, 3)
    band : float
        Height over each section's own lowest point, over the length; `SHADOW` for the whole.
    """
    x = _stations(vertices_mm)
    segments = sections_across(vertices_mm, faces, x)
    across, height = segments.points[:, :, 1], segments.points[:, :, 2]
    length = float(np.ptp(vertices_mm[:, 0]))
    limit = lowest(height, segments) + band * length
    least, most = extremes_below(across, height, limit, segments)
    return Outline(x, least, most)


def side_outline(vertices_mm: Floats, faces: Ints) -> Outline:
    """The lowest and the highest point of each section, along X."""
    x = _stations(vertices_mm)
    segments = sections_across(vertices_mm, faces, x)
    height = segments.points[:, :, 2]
    return Outline(x, lowest(height, segments), highest(height, segments))


def _stations(vertices_mm: Floats) -> Floats:
    """Stations along X, closer together at the two ends, where an outline turns."""
    low, high = float(vertices_mm[:, 0].min()), float(vertices_mm[:, 0].max())
    share = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, DRAWING.stations))
    inset = DRAWING.inset * (high - low)
    return low + inset + share * (high - low - 2 * inset)


def is_left(shape: Profiled) -> bool:
    """Whether a foot or last is a left one; where nobody knows it counts as right."""
    return shape.aligned.alignment.side.side == "left"


def on_side(mesh: Mesh, own: SideName | None, wanted: SideName | None) -> Mesh:
    """A mesh of one side as the other's: mirrored in y, its faces turned over."""
    vertices, faces = mesh
    if own == wanted or own is None or wanted is None:
        return mesh
    return vertices * np.array([1.0, -1.0, 1.0]), faces[:, ::-1]


def own_side(comparison: Comparison) -> tuple[Mesh, Mesh]:
    """Foot and last on the foot's own side: the comparison holds right shapes."""
    side = comparison.foot.aligned.alignment.side.side
    foot = comparison.vertices_mm, comparison.faces
    last = comparison.last_vertices_mm, comparison.last_faces
    return on_side(foot, "right", side), on_side(last, "right", side)
