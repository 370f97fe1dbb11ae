"""A mesh with fewer faces, by quadric edge collapse."""

from __future__ import annotations

import numpy as np

from footfit.geometry.mesh.welding import has_distinct_corners, welded_vertices
from footfit.geometry.numeric.arrays import Floats, Ints

AGGRESSION = 5.0
"""fast_simplification's ``agg``: lower is slower and closer to the surface."""


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
        None of them names a vertex twice. Where simplifying leaves no face, the mesh itself.
    """
    if len(faces) <= target_faces:
        return vertices, faces
    import fast_simplification

    vertices, faces, _ = welded_vertices(vertices, faces)
    fewer_vertices, fewer = fast_simplification.simplify(
        vertices, faces.astype(np.int32), target_count=target_faces, agg=AGGRESSION
    )
    fewer = np.asarray(fewer, dtype=np.int64).reshape(-1, 3)
    fewer = fewer[has_distinct_corners(fewer)]
    return (
        (np.asarray(fewer_vertices, dtype=np.float64), fewer) if len(fewer) else (vertices, faces)
    )
