"""How far two surfaces are apart: sampled points of one, exact triangles of the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.nearest import nearest_on_triangles, triangle_samples
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class DeviationSettings:
    """How closely the surfaces are compared.

    Attributes
    ----------
    spacing_mm, most_splits : float, int
        For :func:`footfit.geometry.mesh.nearest.triangle_samples`.
    candidates, most_candidates : int
        The triangles of how many samples are tried: first for every point, at last for the
        farthest points. With too few, a distance can come out too large, never too small.
    trials : int
        How many pairs of a point and a triangle each later round may try.
    """

    spacing_mm: float = 5.0
    most_splits: int = 32
    candidates: int = 4
    most_candidates: int = 256
    trials: int = 16_000


DEVIATION_SETTINGS = DeviationSettings()


def largest_deviation_mm(
    vertices_mm: Floats, faces: Ints, copy_vertices_mm: Floats, copy_faces: Ints
) -> float:
    """The two-sided largest distance between a mesh and a coarser copy, at samples of both.

    The samples are the vertices of both, the middles of the copy's triangles, and the middles of
    the parts of every larger triangle. Each is compared with the exact triangles near it. The
    result is the Hausdorff distance, except for what lies between samples.

    Parameters
    ----------
    vertices_mm, copy_vertices_mm : (n, 3), (k, 3) float64
    faces, copy_faces : (m, 3), (l, 3) int64

    Returns
    -------
    float
        mm.
    """
    lattice = (DEVIATION_SETTINGS.spacing_mm, DEVIATION_SETTINGS.most_splits)
    here, owners = triangle_samples(vertices_mm, faces, *lattice)
    there, copy_owners = triangle_samples(copy_vertices_mm, copy_faces, *lattice)
    large = (np.bincount(owners) > 1)[owners]
    points = np.concatenate([vertices_mm, here[large]])
    copy_points = np.concatenate([copy_vertices_mm, there])
    return max(
        _farthest(points, there, copy_vertices_mm[copy_faces[copy_owners]]),
        _farthest(copy_points, here, vertices_mm[faces[owners]]),
    )


def _farthest(points: Floats, samples: Floats, corners: Floats) -> float:
    """The largest of the points' distances to the triangles (s, 3, 3) that samples (s, 3) lie on.

    Only the maximum is needed, so only the farthest points are tried with more triangles.
    """
    from scipy.spatial import KDTree

    tree = KDTree(samples)
    best = np.full(len(points), np.inf)
    chosen, count = np.arange(len(points)), DEVIATION_SETTINGS.candidates
    while True:
        count = min(count, len(samples))
        nearest = tree.query(points[chosen], k=count)[1].reshape(len(chosen), -1)
        at_once = max(1, DEVIATION_SETTINGS.trials // len(chosen))
        for start in range(0, count, at_once):
            tried = nearest[:, start : start + at_once]
            repeated = np.repeat(points[chosen], tried.shape[1], axis=0)
            squared = nearest_on_triangles(repeated, corners[tried.ravel()])[2]
            best[chosen] = np.minimum(best[chosen], squared.reshape(tried.shape).min(axis=1))
        if count >= min(DEVIATION_SETTINGS.most_candidates, len(samples)):
            return float(np.sqrt(best.max()))
        count *= 4
        chosen = np.argsort(best)[-(DEVIATION_SETTINGS.trials // count) :]
