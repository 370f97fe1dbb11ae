"""Numbers of whole surfaces that tests compare: area, volume, Euler characteristic, winding."""

from __future__ import annotations

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, face_areas
from footfit.geometry.mesh.topology import boundary_loops, edges, half_edges
from footfit.geometry.numeric.arrays import Floats, Ints


def surface_area(vertices: Floats, faces: Ints) -> float:
    """The whole area.

    Examples
    --------
    >>> surface_area(np.array([[0.0, 0, 0], [2, 0, 0], [0, 3, 0]]), np.array([[0, 1, 2]]))
    3.0
    """
    return float(face_areas(vertices, faces).sum())


def signed_volume(vertices: Floats, faces: Ints) -> float:
    """The volume inside a closed surface; negative where its faces look inward.

    An open surface is closed by a cone to the mean of its vertices: trust the sign at most.

    Examples
    --------
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 6]])
    >>> round(signed_volume(corner, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])), 12)
    1.0
    """
    if len(faces) == 0:
        return 0.0
    centred = vertices - vertices[np.unique(faces)].mean(axis=0)
    apexes = centred[faces[:, 0]]
    return float(np.einsum("ij,ij->", apexes, area_vectors(centred, faces)) / 3.0)


def euler_characteristic(faces: Ints) -> int:
    """V - E + F over the vertices that faces use: 2 - 2 genus - holes for one piece.

    Examples
    --------
    >>> euler_characteristic(np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
    2
    """
    return len(np.unique(faces)) - len(edges(faces)) + len(faces)


def is_consistently_wound(faces: Ints) -> bool:
    """Whether no two faces run an edge that only they share in the same direction."""
    ends = half_edges(faces)
    _, edge, count = np.unique(
        np.sort(ends, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    ways = np.bincount(edge.ravel(), weights=np.where(ends[:, 0] < ends[:, 1], 1.0, -1.0))
    return not (ways[count == 2] != 0.0).any()


def capped(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """The mesh with each boundary loop closed by a fan around its middle."""
    vertices, faces = np.array(vertices), np.array(faces)
    for loop in boundary_loops(faces):
        middle = len(vertices)
        vertices = np.concatenate([vertices, vertices[loop].mean(axis=0)[None]])
        after = np.roll(loop, -1)
        fan = np.stack([after, loop, np.full(len(loop), middle)], axis=1)
        faces = np.concatenate([faces, fan])
    if is_consistently_wound(faces):
        return vertices, faces
    raise AssertionError("the fan is wound the other way")
