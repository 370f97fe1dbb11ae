"""Meshes from and to trimesh, so that a script can go on with its own tools."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from footfit.geometry.numeric.arrays import Floats, Ints

if TYPE_CHECKING:
    from trimesh import Trimesh as Trimesh


def as_trimesh(vertices_mm: Floats, faces: Ints, **metadata: Any) -> Trimesh:
    """A mesh as trimesh has it, in mm; no vertex is merged or moved.

    Parameters
    ----------
    vertices_mm : (n, 3)
    faces : (m, 3)
    **metadata
        What trimesh keeps beside the mesh.
    """
    import trimesh

    meta = {"units": "mm"} | metadata
    return trimesh.Trimesh(vertices_mm, faces, process=False, metadata=meta)
