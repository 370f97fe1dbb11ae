"""The nearest point of a triangle surface, and on which side of the surface a point is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, corner_angles, unit
from footfit.geometry.mesh.topology import boundary_vertices
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct, row_dots


@dataclass(frozen=True, slots=True)
class NearestSettings:
    """How the nearest triangle is looked for.

    Attributes
    ----------
    spacing, most_splits : float, int
        For :func:`triangle_samples`; the spacing is a share of the longest extent.
    candidates : int
        The triangles of so many nearest samples are tried exactly. With too few, a distance can
        come out too large, never too small.
    points_at_once : int
        How many points are worked on together, which bounds the memory.
    """

    spacing: float = 0.02
    most_splits: int = 32
    candidates: int = 10
    points_at_once: int = 20_000


NEAREST = NearestSettings()


@dataclass(frozen=True, slots=True)
class Nearest:
    """The nearest ``face`` (p,) of each point, and the nearest ``place`` (p, 3) on that face.

    ``weights`` (p, 3) are the place's barycentric coordinates, ``distance`` (p,) is its distance.
    """

    face: Ints
    place: Floats
    weights: Floats
    distance: Floats


def nearest_on_surface(points: Floats, vertices: Floats, faces: Ints) -> Nearest:
    """The point of a surface that is nearest to each given point.

    Parameters
    ----------
    points : (p, 3)
    vertices : (n, 3)
    faces : (m, 3)
        At least one.

    Examples
    --------
    >>> corners, faces = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]]), np.array([[0, 1, 2]])
    >>> nearest = nearest_on_surface(np.array([[1.0, 1, 7], [-3, -4, 0]]), corners, faces)
    >>> nearest.distance.tolist(), nearest.place.tolist()
    ([7.0, 5.0], [[1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    """
    from scipy.spatial import KDTree

    corner, first = np.unique(faces.ravel(), return_index=True)
    spacing = NEAREST.spacing * float(np.ptp(vertices[corner], axis=0).max()) or 1.0
    middles, owners = triangle_samples(vertices, faces, spacing, NEAREST.most_splits)
    owners = np.append(first // 3, owners)  # a needle's middle is far from its tip
    tree = KDTree(np.concatenate([vertices[corner], middles]))
    count = min(NEAREST.candidates, len(owners))
    parts = []
    for start in range(0, max(len(points), 1), NEAREST.points_at_once):
        batch = points[start : start + NEAREST.points_at_once]
        sample = tree.query(batch, k=count)[1].reshape(len(batch), count)
        parts.append(_nearest_of(batch, owners[sample], vertices[faces]))
    face, place, weights, distance = (np.concatenate(field) for field in zip(*parts, strict=True))
    return Nearest(face, place, weights, distance)


def _nearest_of(
    points: Floats, candidates: Ints, corners: Floats
) -> tuple[Ints, Floats, Floats, Floats]:
    """The face, place, weights and distance of the nearest of the candidates (p, k) of a point."""
    candidates = np.sort(candidates, axis=1)  # at equal distances the lowest face, on any machine
    row, column = np.nonzero(np.diff(candidates, axis=1, prepend=-1))
    face = candidates[row, column]
    weights, place, squared = nearest_on_triangles(points[row], corners[face])
    order = np.lexsort((face, squared, row))
    best = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
    return face[best], place[best], weights[best], np.sqrt(squared[best])


def nearest_on_triangles(points: Floats, corners: Floats) -> tuple[Floats, Floats, Floats]:
    """The nearest point of each point's own triangle.

    Parameters
    ----------
    points : (p, 3)
    corners : (p, 3, 3)
        A triangle without area is taken as its longest edge.

    Returns
    -------
    weights : (p, 3)
        Barycentric.
    place : (p, 3)
    squared : (p,)
        The square of its distance.

    Examples
    --------
    >>> triangle = np.array([[[0.0, 0, 0], [4, 0, 0], [0, 4, 0]]])
    >>> nearest_on_triangles(np.array([[1.0, 1, 7]]), triangle)[2].tolist()
    [49.0]
    >>> nearest_on_triangles(np.array([[-3.0, -4, 0]]), triangle)[2].tolist()
    [25.0]
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v, w = b - a, c - a, points - a
    uu, uv, vv, wu, wv = (row_dots(p, q) for p, q in ((u, u), (u, v), (v, v), (w, u), (w, v)))
    determinant = uu * vv - uv * uv
    safe = np.where(determinant > 0.0, determinant, 1.0)
    s, t = (vv * wu - uv * wv) / safe, (uu * wv - uv * wu) / safe
    inside = (determinant > 0.0) & (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0)
    weights = np.stack([1.0 - s - t, s, t], axis=1)
    outside = np.flatnonzero(~inside)
    weights[outside] = _on_edges(points[outside], corners[outside])
    place = np.einsum("pj,pjk->pk", weights, corners)
    away = place - points
    return weights, place, row_dots(away, away)


def _on_edges(points: Floats, corners: Floats) -> Floats:
    """The weights (p, 3) of the nearest point on the three edges of each point's triangle."""
    best, least = np.zeros((len(points), 3)), np.full(len(points), np.inf)
    for first in range(3):
        second = (first + 1) % 3
        start, along = corners[:, first], corners[:, second] - corners[:, first]
        length = row_dots(along, along)
        share = row_dots(points - start, along) / np.where(length > 0.0, length, 1.0)
        share = np.clip(share, 0.0, 1.0)
        away = points - start - share[:, None] * along
        squared = row_dots(away, away)
        nearer = np.flatnonzero(squared < least)
        best[nearer] = 0.0
        best[nearer, first], best[nearer, second] = 1.0 - share[nearer], share[nearer]
        least[nearer] = squared[nearer]
    return best


def triangle_samples(
    vertices: Floats, faces: Ints, spacing: float, most_splits: int
) -> tuple[Floats, Ints]:
    """Points of a surface: the middle of each triangle, and of a large one those of its parts.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
    spacing : float
        A triangle with a longer edge is cut into parts about so long, in the vertices' unit.
    most_splits : int
        An edge is split into this many parts at most.

    Returns
    -------
    points : (s, 3)
    owners : (s,)
        The face of each.
    """
    corners = vertices[faces]
    longest = np.linalg.norm(corners - corners[:, [1, 2, 0]], axis=2).max(axis=1)
    splits = np.clip(np.ceil(longest / spacing), 1, most_splits).astype(np.int64)
    points, owners = [], []
    for split in distinct(splits).tolist():
        chosen = np.flatnonzero(splits == split)
        points.append((part_middles(split) @ corners[chosen]).reshape(-1, 3))
        owners.append(np.repeat(chosen, split * split))
    return np.concatenate(points), np.concatenate(owners)


def part_middles(split: int) -> Floats:
    """The middles of the split^2 equal parts of a triangle, barycentric, (split^2, 3).

    Examples
    --------
    >>> part_middles(2).shape, bool(np.allclose(part_middles(2).mean(axis=0), 1 / 3))
    ((4, 3), True)
    """
    upright = [(3 * i + 1, 3 * j + 1) for i in range(split) for j in range(split - i)]
    turned = [(3 * i + 2, 3 * j + 2) for i in range(split - 1) for j in range(split - 1 - i)]
    rows = [(i, j, 3 * split - i - j) for i, j in upright + turned]
    return np.array(rows, dtype=np.float64) / (3 * split)


# ---------------------------------------------------------------- the side


def outward_at(nearest: Nearest, vertices: Floats, faces: Ints) -> Floats:
    """The surface's outward direction at the nearest points, (p, 3).

    It is the pseudonormal of [baerentzen2005]: inside a face the face's normal, on an edge the sum
    of two normals, at a vertex the sum of the normals weighted by the corners' angles. Take its
    dot product with the way from the nearest point to the point: it is positive outside and
    negative inside, exactly, also where the nearest point lies on a crease.
    """
    normals = unit(area_vectors(vertices, faces))
    lying = nearest.weights > 0.0
    on = lying.sum(axis=1)
    outward = normals[nearest.face].copy()
    at_vertex = np.flatnonzero(on == 1)
    if len(at_vertex):
        felt = corner_angles(vertices, faces)[None] * normals.T[:, :, None]
        corners = faces.ravel()
        sums = np.stack([np.bincount(corners, axis.ravel(), len(vertices)) for axis in felt], 1)
        corner = np.argmax(lying[at_vertex], axis=1)
        outward[at_vertex] = sums[faces[nearest.face[at_vertex], corner]]
    at_edge = np.flatnonzero(on == 2)
    if len(at_edge):
        missing = np.argmin(lying[at_edge], axis=1)
        outward[at_edge] += normals[faces_across(faces, nearest.face[at_edge], missing)]
    return outward


def faces_across(faces: Ints, face: Ints, corner: Ints) -> Ints:
    """The neighbours (p,) of ``face`` (p,), over the edge opposite to its ``corner`` (p,).

    Where there is no neighbour, it is the face itself.

    Examples
    --------
    >>> faces = np.array([[0, 1, 2], [2, 1, 3]])
    >>> faces_across(faces, np.array([0, 0]), np.array([0, 1])).tolist()
    [1, 0]
    """
    span = int(faces.max()) + 1
    start, end = faces[:, [1, 2, 0]].ravel(), faces[:, [2, 0, 1]].ravel()  # opposite to 0, 1, 2
    keys = start * span + end
    order = np.argsort(keys, kind="stable")
    reverse = faces[face, (corner + 2) % 3] * span + faces[face, (corner + 1) % 3]
    place = np.minimum(np.searchsorted(keys[order], reverse), len(keys) - 1)
    other = order[place]
    return np.where(keys[other] == reverse, other // 3, face)


def at_rim(nearest: Nearest, faces: Ints, n_vertices: int) -> Bools:
    """Which points (p,) are nearest to the surface's open rim, where there is no side."""
    rim = boundary_vertices(faces, n_vertices)[faces[nearest.face]]
    lying = nearest.weights > 0.0
    return np.asarray(~lying.all(axis=1) & (rim | ~lying).all(axis=1))
