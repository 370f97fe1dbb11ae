"""How far two surfaces are apart: sampled points of one against the triangles of the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class DeviationSettings:
    """How closely the surfaces are looked at.

    Attributes
    ----------
    spacing_mm : float
        A triangle with a longer edge is looked at in several places, about so far apart.
    most_splits : int
        A triangle's edges are split at most so often.
    candidates, most_candidates : int
        How many samples' triangles are tried for each point at first, and for the farthest points
        at last. Too few can only make a distance come out too large.
    trials : int
        How many points times triangles each of those later rounds may try.
    """

    spacing_mm: float = 5.0
    most_splits: int = 32
    candidates: int = 4
    most_candidates: int = 256
    trials: int = 16_000


DEVIATION_SETTINGS = DeviationSettings()


def largest_deviation_mm(
    vertices_mm: Floats,
    faces: Ints,
    copy_vertices_mm: Floats,
    copy_faces: Ints,
    settings: DeviationSettings = DEVIATION_SETTINGS,
) -> float:
    """The two-sided largest distance between a mesh and a coarser copy, at samples of both.

    The samples are the vertices of both, the middles of the copy's triangles, and the middles of
    the parts of every larger triangle; each is held against the exact triangles near it. It is
    the Hausdorff distance but for what lies between samples.

    Parameters
    ----------
    vertices_mm, copy_vertices_mm : (n, 3), (k, 3) float64
    faces, copy_faces : (m, 3), (l, 3) int64

    Returns
    -------
    float
        mm.
    """
    here, owners = _middles(vertices_mm, faces, settings)
    there, copy_owners = _middles(copy_vertices_mm, copy_faces, settings)
    large = (np.bincount(owners) > 1)[owners]
    points = np.concatenate([vertices_mm, here[large]])
    copy_points = np.concatenate([copy_vertices_mm, there])
    return max(
        _farthest(points, there, copy_vertices_mm[copy_faces[copy_owners]], settings),
        _farthest(copy_points, here, vertices_mm[faces[owners]], settings),
    )


def _middles(vertices: Floats, faces: Ints, settings: DeviationSettings) -> tuple[Floats, Ints]:
    """The middles of all triangles or their parts, (s, 3), and the face of each, (s,)."""
    corners = vertices[faces]
    edges = np.linalg.norm(corners - corners[:, [1, 2, 0]], axis=2).max(axis=1)
    splits = np.clip(np.ceil(edges / settings.spacing_mm), 1, settings.most_splits)
    points, owners = [], []
    for split in np.unique(splits).astype(int).tolist():
        chosen = np.flatnonzero(splits == split)
        points.append((_lattice(split) @ corners[chosen]).reshape(-1, 3))
        owners.append(np.repeat(chosen, split * split))
    return np.concatenate(points), np.concatenate(owners).astype(np.int64)


def _lattice(split: int) -> Floats:
    """Barycentric coordinates of the middles of a triangle's split * split parts."""
    upright = [(3 * i + 1, 3 * j + 1) for i in range(split) for j in range(split - i)]
    turned = [(3 * i + 2, 3 * j + 2) for i in range(split - 1) for j in range(split - 1 - i)]
    rows = [(i, j, 3 * split - i - j) for i, j in upright + turned]
    return np.array(rows, dtype=np.float64) / (3 * split)


def _farthest(
    points: Floats, samples: Floats, corners: Floats, settings: DeviationSettings
) -> float:
    """The largest of the points' distances to the triangles (s, 3, 3) that samples (s, 3) lie on.

    Only the maximum is wanted, so only the farthest points are tried against more triangles.
    """
    from scipy.spatial import KDTree

    tree = KDTree(samples)
    best = np.full(len(points), np.inf)
    chosen, count = np.arange(len(points)), settings.candidates
    while True:
        count = min(count, len(samples))
        nearest = tree.query(points[chosen], k=count)[1].reshape(len(chosen), -1)
        for column in nearest.T:
            distances = point_triangle_distances(points[chosen], corners[column])
            best[chosen] = np.minimum(best[chosen], distances)
        if count >= min(settings.most_candidates, len(samples)):
            return float(best.max())
        count *= 4
        chosen = np.argsort(best)[-(settings.trials // count) :]


def point_triangle_distances(points: Floats, corners: Floats) -> Floats:
    """From each point to its own triangle: (p, 3) and (p, 3, 3) in, (p,) out.

    The nearest point lies on one of the edges, or inside, where the foot of the perpendicular has
    three non-negative barycentric coordinates.

    Examples
    --------
    >>> triangle = np.array([[[0.0, 0, 0], [4, 0, 0], [0, 4, 0]]])
    >>> point_triangle_distances(np.array([[1.0, 1, 7]]), triangle).tolist()
    [7.0]
    >>> point_triangle_distances(np.array([[-3.0, -4, 0]]), triangle).tolist()
    [5.0]
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    on_edges = np.minimum(_edge_squared(points, a, b), _edge_squared(points, b, c))
    squared = np.minimum(on_edges, _edge_squared(points, c, a))
    u, v, w = b - a, c - a, points - a
    uu, uv, vv, wu, wv = (_dot(p, q) for p, q in ((u, u), (u, v), (v, v), (w, u), (w, v)))
    determinant = uu * vv - uv * uv
    safe = np.where(determinant > 0.0, determinant, 1.0)
    s, t = (vv * wu - uv * wv) / safe, (uu * wv - uv * wu) / safe
    inside = (determinant > 0.0) & (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0)
    offset = w - s[:, None] * u - t[:, None] * v
    return np.sqrt(np.where(inside, np.minimum(_dot(offset, offset), squared), squared))


def _edge_squared(points: Floats, start: Floats, end: Floats) -> Floats:
    """Squared distances from points to segments, (p,)."""
    along, offset = end - start, points - start
    length = _dot(along, along)
    share = np.clip(_dot(offset, along) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
    rest = offset - share[:, None] * along
    return _dot(rest, rest)


def _dot(one: Floats, other: Floats) -> Floats:
    products: Floats = np.einsum("ij,ij->i", one, other)
    return products
