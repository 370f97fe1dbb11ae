"""Faces as curved pieces of a smooth surface, so that a section does not depend on the facets.

The corners of a mesh lie on the shape, and its faces inside of a round edge. A face is replaced by
the cubic patch through its corners that meets the surface's normals there: a curved point-normal
triangle (Vlachos, Peters, Boyd and Mitchell 2001).
"""

from __future__ import annotations

from math import factorial

import numpy as np

from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats, Ints


def corner_normals(vertices: Floats, faces: Ints) -> Floats:
    """The unit normal of the surface at each vertex, (n, 3); zeros where there is none.

    Faces are weighted as Max (1999) does, which is exact for a sphere with any facets.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> corner_normals(corners, np.array([[0, 1, 2]])).tolist()[0]
    [0.0, 0.0, 1.0]
    """
    sums = np.zeros_like(vertices)
    for corner in range(3):
        at, after, before = (faces[:, (corner + turn) % 3] for turn in range(3))
        ahead, back = vertices[after] - vertices[at], vertices[before] - vertices[at]
        weight = np.square(ahead).sum(axis=1) * np.square(back).sum(axis=1)
        share = cross(ahead, back) / np.maximum(weight, 1e-12)[:, None]
        for axis in range(3):
            sums[:, axis] += np.bincount(at, share[:, axis], len(vertices))
    long = np.linalg.norm(sums, axis=1)
    return np.asarray(sums / np.maximum(long, 1e-30)[:, None])


def curved_pieces(
    vertices: Floats, normals: Floats, faces: Ints, parts: int
) -> tuple[Floats, Ints]:
    """Each face as ``parts`` squared small faces on its curved patch: vertices and faces.

    Parameters
    ----------
    vertices, normals : (n, 3)
    faces : (m, 3)
    parts : int
        Into how many pieces an edge is cut.

    Returns
    -------
    vertices : (k, 3)
        Those of each face by themselves, in mm.
    faces : (m * parts**2, 3)
    """
    shares, pieces = _grid(parts)
    patch = shares @ _controls(vertices[faces], normals[faces])
    count = len(shares)
    numbered = count * np.arange(len(faces))[:, None, None] + pieces
    return patch.reshape(-1, 3), numbered.reshape(-1, 3)


_POWERS = tuple((3 - j - k, j, k) for j in range(4) for k in range(4 - j))
"""Of the three corners' shares, in the order of the control points."""


def _controls(corners: Floats, normals: Floats) -> Floats:
    """The ten control points (m, 10, 3) of each face's patch."""
    known: dict[tuple[int, ...], Floats] = {}
    for i in range(3):
        known[tuple(3 * (k == i) for k in range(3))] = corners[:, i]
        for j in range(3):
            if i != j:
                way = corners[:, j] - corners[:, i]
                rise = (way * normals[:, i]).sum(axis=1)[:, None]
                powers = tuple(2 * (k == i) + (k == j) for k in range(3))
                known[powers] = corners[:, i] + (way - rise * normals[:, i]) / 3.0
    edges = np.mean([known[powers] for powers in known if max(powers) == 2], axis=0)
    known[1, 1, 1] = edges + 0.5 * (edges - corners.mean(axis=1))
    return np.stack([known[powers] for powers in _POWERS], axis=1)


def _grid(parts: int) -> tuple[Floats, Ints]:
    """The weights (k, 10) of the control points at each point of a face, and its pieces (p, 3)."""
    places = [(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)]
    row = {place: number for number, place in enumerate(places)}
    at = np.array([(parts - i - j, i, j) for i, j in places]) / parts
    weights = [
        factorial(3) / np.prod([factorial(p) for p in powers]) * (at ** np.array(powers)).prod(1)
        for powers in _POWERS
    ]
    pieces = []
    for i, j in places:
        if i + j < parts:
            pieces.append((row[i, j], row[i + 1, j], row[i, j + 1]))
        if i + j < parts - 1:
            pieces.append((row[i + 1, j], row[i + 1, j + 1], row[i, j + 1]))
    return np.column_stack(weights), np.array(pieces)
