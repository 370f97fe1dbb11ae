"""How much a change bends the surface of a mesh."""

from __future__ import annotations

import numpy as np

from footfit.geometry.mesh.surface import face_normals
from footfit.geometry.mesh.topology import edge_groups
from footfit.geometry.numeric.arrays import Floats, Ints, row_dots

PERCENT = 99.0


def bend_deg(before_mm: Floats, after_mm: Floats, faces: Ints) -> float:
    """By how many degrees the angle between two faces changes, at the 99th percentile of all edges.

    Parameters
    ----------
    before_mm, after_mm : (n, 3)
        The vertices.
    faces : (m, 3)
    """
    order, starts, counts = edge_groups(faces)
    first = starts[counts == 2]
    left, right = order[first] // 3, order[first + 1] // 3
    angles = []
    for points in (before_mm, after_mm):
        normals = face_normals(points, faces)
        angles.append(np.arccos(np.clip(row_dots(normals[left], normals[right]), -1.0, 1.0)))
    change = np.abs(angles[1] - angles[0])
    return float(np.degrees(np.percentile(change, PERCENT))) if len(change) else 0.0
