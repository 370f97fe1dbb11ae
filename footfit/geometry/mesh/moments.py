"""Centroids, second moments and principal axes of a surface: as the paper prints them, and exact.

The paper's Eq. 1-4 depend on how the surface is cut into triangles. The exact moments of the
surface do not. The methods ``paper`` and ``paper-literal`` use the former.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.mesh.surface import face_areas
from footfit.geometry.numeric.arrays import Floats, Ints


def face_barycentres(vertices: Floats, faces: Ints) -> Floats:
    """The mean of each face's corners, (m, 3).

    Taken by columns, since the mean over the middle axis of (m, 3, 3) takes six times as long.
    """
    a, b, c = (vertices.take(faces[:, corner], axis=0) for corner in range(3))
    return np.asarray((a + b + c) / 3.0, dtype=np.float64)


def vertex_mean(vertices: Floats) -> Floats:
    """The barycentre as printed, the mean of the vertices: (n, 3) -> (3,)."""
    return np.asarray(vertices.mean(axis=0), dtype=np.float64)  # Eq. 1


def printed_covariance(vertices: Floats, faces: Ints) -> Floats:
    """The covariance of the triangles' barycentres as printed, (3, 3), in squared units.

    Weighted by area, around the *unweighted* mean of the barycentres, as the paper has it.
    """
    barycentres = face_barycentres(vertices, faces)
    centre = barycentres.mean(axis=0)  # Eq. 3
    areas = face_areas(vertices, faces)
    away = barycentres - centre
    return np.asarray((areas[:, None] * away).T @ away / areas.sum(), dtype=np.float64)  # Eq. 2, 4


def surface_second_moment(vertices: Floats, faces: Ints) -> Floats:
    """The exact second moment of the surface about its centroid: see `surface_moments`."""
    return surface_moments(vertices, faces)[1]


def surface_moments(vertices: Floats, faces: Ints) -> tuple[Floats, Floats]:
    """The area-weighted centroid of the surface, which Eq. 1 must mean, (3,); and the exact second
    moment about it, over the area, (3, 3).

    The moment is sum A_i (9 T T' + sum v v') / 12 A, with each triangle's barycentre T and corners
    v relative to the centroid. Splitting a triangle does not change it.

    Examples
    --------
    A square plate of side 2 has a third of its half side squared along each side:

    >>> plate = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    >>> centroid, moment = surface_moments(plate, np.array([[0, 1, 2], [0, 2, 3]]))
    >>> centroid.tolist(), moment.round(12).diagonal().tolist()
    ([0.0, 0.0, 0.0], [0.333333333333, 0.333333333333, 0.0])
    """
    areas = face_areas(vertices, faces)
    barycentres = face_barycentres(vertices, faces)
    centroid = np.asarray(areas @ barycentres / areas.sum(), dtype=np.float64)
    away, corners = barycentres - centroid, vertices - centroid
    # The corners' part, vertex by vertex: each counts with the areas of all faces around it.
    around = np.bincount(faces.ravel(), np.repeat(areas, 3), minlength=len(vertices))
    moment = 9 * (areas[:, None] * away).T @ away + (around[:, None] * corners).T @ corners
    return centroid, np.asarray(moment / (12 * areas.sum()), dtype=np.float64)


def principal_axes(second_moment: Floats) -> tuple[Floats, Floats]:
    """The descending eigenvalues (3,) of a second moment, and its unit eigenvectors as rows (3, 3).

    The rows' signs are those that the solver gives:
    :func:`footfit.geometry.pose.paper_frame.settled_axes` and
    :func:`footfit.geometry.pose.paper_frame.largest_positive` choose them.
    """
    values, columns = np.linalg.eigh(second_moment)
    return np.clip(values[::-1], 0.0, None), columns.T[::-1].copy()  # step 4, R of Eq. 5


def moments_along(second_moment: Floats, rows: Floats) -> Floats:
    """The second moment along each unit row (k, 3): the diagonal of R C R^T, (k,).

    Along eigenvectors, in any order and with any signs, these are their eigenvalues.

    Examples
    --------
    >>> moments_along(np.diag([9.0, 1.0, 4.0]), np.array([[0.0, 0, -1], [0, 1, 0]])).tolist()
    [4.0, 1.0]
    """
    along = np.einsum("ij,jk,ik->i", rows, second_moment, rows)
    return np.asarray(np.clip(along, 0.0, None), dtype=np.float64)
