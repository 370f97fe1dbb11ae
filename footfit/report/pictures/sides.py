"""Meshes on the side that they are drawn on: a left foot is drawn as a left foot."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.results import Comparison, Profiled, SideName

Mesh = tuple[Floats, Ints]
"""Vertices (n, 3) in canonical mm, and faces (m, 3)."""


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
