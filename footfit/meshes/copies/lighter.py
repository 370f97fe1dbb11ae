"""A mesh with fewer faces, for a picture."""

from __future__ import annotations

import numpy as np

from footfit.geometry.mesh.topology import welded
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.clean.cleaning import has_distinct_corners
from footfit.meshes.copies.compact_copy import COPY_SETTINGS


def lighter_mesh(vertices: Floats, faces: Ints, target_faces: int) -> tuple[Floats, Ints]:
    """A mesh of about ``target_faces``, welded; the mesh itself where it has no more than that.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
    target_faces : int

    Returns
    -------
    vertices : (k, 3)
    faces : (l, 3)
    """
    if len(faces) <= target_faces:
        return vertices, faces
    import fast_simplification

    vertices, faces, _ = welded(vertices, faces)
    fewer_vertices, fewer = fast_simplification.simplify(
        vertices, faces.astype(np.int32), target_count=target_faces, agg=COPY_SETTINGS.aggression
    )
    kept = np.asarray(fewer, dtype=np.int64)
    return np.asarray(fewer_vertices, dtype=np.float64), kept[has_distinct_corners(kept)]
