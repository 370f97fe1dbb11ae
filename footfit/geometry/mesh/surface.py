"""Normals, areas and angles of triangle surfaces. Faces are counter-clockwise from outside.

``vertices`` is (n, 3) float64, ``faces`` (m, 3) int64; an area has the coordinates' unit squared.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints, row_dots, row_lengths


def area_vectors(vertices: Floats, faces: Ints) -> Floats:
    """The faces' normals, each as long as the face's area, (m, 3).

    Examples
    --------
    >>> area_vectors(np.array([[0.0, 0, 0], [2, 0, 0], [0, 3, 0]]), np.array([[0, 1, 2]])).tolist()
    [[0.0, 0.0, 3.0]]
    """
    a, b, c = (vertices.take(faces[:, corner], axis=0) for corner in range(3))
    b -= a
    c -= a
    vectors = cross(b, c)
    vectors *= 0.5
    return vectors


def cross(u: Floats, v: Floats) -> Floats:
    """The cross product of two vectors (3,), or of rows (k, 3); much faster than np.cross.

    Examples
    --------
    >>> cross(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])).tolist()
    [0.0, 0.0, 1.0]
    """
    product = np.empty_like(u)
    product[..., 0] = u[..., 1] * v[..., 2] - u[..., 2] * v[..., 1]
    product[..., 1] = u[..., 2] * v[..., 0] - u[..., 0] * v[..., 2]
    product[..., 2] = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    return product


def unit(vectors: Floats) -> Floats:
    """The rows (k, d) at length 1; a zero row stays zero."""
    length = row_lengths(vectors)
    units: Floats = vectors / np.where(length > 0.0, length, 1.0)[:, None]
    return units


def face_normals(vertices: Floats, faces: Ints) -> Floats:
    """Unit normals of the faces, (m, 3); zero for a face without area."""
    return unit(area_vectors(vertices, faces))


def face_areas(vertices: Floats, faces: Ints) -> Floats:
    """Areas of the faces, (m,)."""
    return row_lengths(area_vectors(vertices, faces))


def corner_angles(vertices: Floats, faces: Ints) -> Floats:
    """The angle of each face at each of its corners, (m, 3), in radians, by atan2."""
    doubled_area = 2.0 * face_areas(vertices, faces)
    angles = np.empty(faces.shape, dtype=np.float64)
    for corner in range(3):
        here = vertices[faces[:, corner]]
        u = vertices[faces[:, (corner + 1) % 3]] - here
        v = vertices[faces[:, (corner + 2) % 3]] - here
        angles[:, corner] = np.arctan2(doubled_area, row_dots(u, v))
    return angles


def vertex_sums(values: Floats, faces: Ints, n_vertices: int) -> Floats:
    """The sum of its faces' values at each vertex: (m,) or (m, d) in, (n,) or (n, d) out."""
    columns = values.reshape(len(faces), int(np.prod(values.shape[1:])))
    sums = np.empty((n_vertices, columns.shape[1]), dtype=np.float64)
    corners = faces.ravel()
    for column in range(columns.shape[1]):
        repeated = np.repeat(columns[:, column], 3)
        sums[:, column] = np.bincount(corners, weights=repeated, minlength=n_vertices)
    shaped: Floats = sums.reshape((n_vertices, *values.shape[1:]))
    return shaped


def vertex_areas(vertices: Floats, faces: Ints) -> Floats:
    """A third of the area of the faces around each vertex, (n,); the sum is the surface's area."""
    return vertex_sums(face_areas(vertices, faces), faces, len(vertices)) / 3.0


def vertex_normals(vertices: Floats, faces: Ints) -> Floats:
    """Unit normals at the vertices, (n, 3): the mean of the faces' normals, weighted by area.

    Zero where a vertex has no face, or where its faces cancel.
    """
    return unit(vertex_sums(area_vectors(vertices, faces), faces, len(vertices)))
