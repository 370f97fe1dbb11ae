"""The curvature of a surface at a scale: concentrated curvatures pooled over a radius.

Convex is positive, k1 <= k2. ``vertices`` is (n, 3) float64 in any unit, ``faces`` (m, 3) int64,
welded and wound outward.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.curvature.diffusion import (
    Diffusion,
    diffusion,
    longest_deviation,
    pooled_fields,
)
from footfit.geometry.curvature.one_ring import PrincipalCurvatures
from footfit.geometry.mesh.refinement import with_flat_facets_split
from footfit.geometry.mesh.surface import area_vectors, cross, unit, vertex_sums
from footfit.geometry.numeric.arrays import Floats, Ints, row_dots, row_lengths


@dataclass(frozen=True, slots=True)
class PoolingSettings:
    """The constants of :func:`pooled_curvature`.

    Attributes
    ----------
    radius_over_deviation : float
        The radius in standard deviations of the narrower pooling weights.
    wider : float
        The variance of the wider weights over that of the narrower ones. The change between the
        two is extrapolated to no width at all.
    widening_least : float
        On some meshes the weights cannot widen as they should. They then count as wider by at
        least this share of it.
    side_over_radius : float
        Sides longer than this share of the radius are split where they lie in a flat facet, which
        otherwise has no vertices to pool.
    rounds : int
        How often normals are corrected for the arcs over the facets' sides.
    arc_most : float
        The largest angle in radians that such an arc may turn; a crease is not an arc.
    flattest : float
        NaN is returned where the weights' two principal variances in the tangent plane have a
        smaller ratio than this, since a curvature cannot be determined there.
    """

    radius_over_deviation: float = 2.2
    wider: float = 1.3
    widening_least: float = 0.5
    side_over_radius: float = 0.5
    rounds: int = 2
    arc_most: float = 0.2
    flattest: float = 1e-6


POOLING = PoolingSettings()


def pooled_curvature(vertices: Floats, faces: Ints, radius: float) -> PrincipalCurvatures:
    """Curvature at the scale ``radius``, 1/length: concentrated curvatures pooled over it.

    Between p and any q nearby, the normal turns by (n_q - n_p).(q - p)/|q - p|^2 per length, which
    is exactly 1/R on a circle: a concentrated curvature over its length. A single ring of them
    drowns in a scan's noise. Here n_q - n = S (q - c), with a symmetric S, is fitted over the
    neighbourhood by least squares in the tangent plane; k1 and k2 are the eigenvalues of S. The
    weights are those of heat (:mod:`footfit.geometry.curvature.diffusion`) with the standard
    deviation ``radius / POOLING.radius_over_deviation``. n, c and the tangent plane are pooled too,
    so that p's own noise counts no more than its neighbours'. A second, wider pooling tells what
    the first has smoothed away, and this is put back. Spheres and cylinders come out exactly for
    any radius, up to the mesh.

    Parameters
    ----------
    vertices, faces
        See the module. n_q is the area-weighted normal of the faces around q, after their sides
        were bent into arcs. It stands for their centroid, not for q.
    radius : float
        > 0. If it is smaller than the edges, the nearest ring counts. If it is over
        :func:`longest_radius`, it is cut to that. Big flat facets are split first
        (:mod:`footfit.geometry.mesh.refinement`).

    Returns
    -------
    PrincipalCurvatures
        At a boundary it is one-sided. NaN where a vertex has no face, where the normals around it
        cancel, or where its neighbourhood is a line.

    Raises
    ------
    ValueError
        ``radius`` is not positive.

    Examples
    --------
    >>> corners = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    >>> upper = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> octahedron = np.array(upper + [[b, a, 5] for a, b, _ in upper])
    >>> np.ptp(pooled_curvature(corners, octahedron, 1.0).k2) < 1e-12
    np.True_
    """
    centres, normals, operator = _pooling(vertices, faces, radius)
    pooled = pooled_fields(operator, _moment_fields(centres, normals))
    a, b, c = _unsmoothed(pooled[:, :, : len(vertices)])
    mean, half = 0.5 * (a + c), np.hypot(0.5 * (a - c), b)
    k1, k2 = mean - half, mean + half
    return PrincipalCurvatures(k1, k2, 0.5 * (k1 + k2), k1 * k2)


def longest_radius(vertices: Floats, faces: Ints) -> float:
    """The largest radius that :func:`pooled_curvature` uses; inf without area.

    It is that of the median vertex: about 45 mean edges on an even mesh, 33 on a random mesh.
    """
    widest = longest_deviation(vertices, faces)
    return POOLING.radius_over_deviation * widest / float(np.sqrt(POOLING.wider))


def _pooling(vertices: Floats, faces: Ints, radius: float) -> tuple[Floats, Floats, Diffusion]:
    """Centroids, normals and the pooling operator; the new vertices in flat facets come last."""
    if not radius > 0.0:
        raise ValueError("the pooling radius must be positive; for one ring use one_ring_curvature")
    vertices, faces = with_flat_facets_split(vertices, faces, POOLING.side_over_radius * radius)
    narrow = radius / POOLING.radius_over_deviation
    deviations = (narrow, narrow * float(np.sqrt(POOLING.wider)))
    return *_stars(vertices, faces), diffusion(vertices, faces, deviations)


def _stars(vertices: Floats, faces: Ints) -> tuple[Floats, Floats]:
    """The middle of the faces around each vertex and the mean normal there, (n, 3) each.

    The centroid lies under a bent surface, so it is raised to the height of the vertex; otherwise a
    sphere of radius R reads (edge / R)^2 / 3 too much. A vertex without faces stands for itself,
    with a zero normal.
    """
    flat = area_vectors(vertices, faces)
    areas = row_lengths(flat)
    weighted = areas[:, None] * vertices[faces].sum(axis=1) / 3.0
    sums = vertex_sums(np.column_stack([weighted, areas]), faces, len(vertices))
    area = sums[:, 3:]
    centres: Floats = np.where(area > 0.0, sums[:, :3] / np.where(area > 0.0, area, 1.0), vertices)
    normals = _arched_normals(vertices, faces, centres, flat)
    below = row_dots(vertices - centres, normals)
    return centres + below[:, None] * normals, normals


def _arched_normals(vertices: Floats, faces: Ints, centres: Floats, flat: Floats) -> Floats:
    """The area-weighted normals (n, 3) of the faces, after each side is bent into its arc.

    The area between the chord and the arc of a side of length e and curvature k is k e^3 / 12. Flat
    facets (``flat`` are their area vectors) leave it out, an uneven mesh unevenly. Without it the
    error stays at (edge / radius)^2. k is the side's own turning over its length, between the
    centroids at its ends, and gets better with each round.
    """
    sides, ways = _sides(vertices[faces]), _sides(centres[faces])
    square = np.einsum("mcx,mcx->mc", ways, ways)
    length = np.sqrt(np.einsum("mcx,mcx->mc", sides, sides))
    per_turn = length / np.where(square > 0.0, square, np.inf)
    up = unit(flat)
    normals = unit(vertex_sums(flat, faces, len(vertices)))
    for _ in range(POOLING.rounds):
        angle = np.einsum("mcx,mcx->mc", _sides(normals[faces]), ways) * per_turn
        bulge = np.clip(angle, -POOLING.arc_most, POOLING.arc_most) * length / 12.0
        missing = cross(np.einsum("mcx,mc->mx", sides, bulge), up)
        normals = unit(vertex_sums(flat - missing, faces, len(vertices)))
    return normals


def _sides(corners: Floats) -> Floats:
    """The vectors along the three sides of triangles, (m, 3, 3) in and out."""
    sides = np.empty_like(corners)
    np.subtract(corners[:, 1:], corners[:, :2], out=sides[:, :2])
    np.subtract(corners[:, 0], corners[:, 2], out=sides[:, 2])
    return sides


_UPPER = (np.array([0, 0, 0, 1, 1, 2]), np.array([0, 1, 2, 1, 2, 2]))  # xx xy xz yy yz zz
_SQUARE = np.array([[0, 1, 2], [1, 3, 4], [2, 4, 5]])  # the place in them of each 3 x 3 entry


def _moment_fields(centres: Floats, normals: Floats) -> Floats:
    """The fields to pool, (18, n): x (3), x x' (6), n (3), the symmetric part of n x' (6)."""
    x, n = centres.T - centres.mean(axis=0)[:, None], normals.T
    row, column = _UPPER
    turns = 0.5 * (n[row] * x[column] + n[column] * x[row])
    return np.concatenate([x, x[row] * x[column], n, turns])


def _unsmoothed(pooled: Floats) -> tuple[Floats, Floats, Floats]:
    """S = [[a, b], [b, c]] in the tangent planes, (k,) each, corrected for the smoothing.

    Pooled S is off by a multiple of the weights' variance, of its square and so on. From the two
    scales (2, 18, k), S = narrow + (narrow - wide) / (wide's variance / narrow's variance - 1)
    removes the first term. The variances are measured, since on some meshes the weights do not
    spread as they should.
    """
    narrow, wide = pooled
    basis = _tangent_bases(unit(narrow[9:12].T))
    (s, variance), (s_wide, variance_wide) = _turning(narrow, basis), _turning(wide, basis)
    least = POOLING.widening_least * (POOLING.wider - 1.0)
    widening = np.maximum(variance_wide / variance - 1.0, least)
    a, b, c = s + (s - s_wide) / widening
    return a, b, c


def _turning(pooled: Floats, basis: Floats) -> tuple[Floats, Floats]:
    """The S (3, k) that best fits turns = S ways, and the ways' variance (k,); NaN on a line.

    The tangent covariances are [[p, q], [q, r]] of the ways and [[u, v/2], [v/2, w]] of the turns
    (symmetric part). The normal equations of min |turn - S way|^2 in S = [[a, b], [b, c]] are::

        p a + q b             = u
        q a + (p + r) b + q c = v
                  q b + r c   = w
    """
    x, n = pooled[:3], pooled[9:12]
    row, column = _UPPER
    ways = _tangent_part(pooled[3:9] - x[row] * x[column], basis)
    turns = _tangent_part(pooled[12:] - 0.5 * (n[row] * x[column] + n[column] * x[row]), basis)
    (p, q, r), (u, v, w) = ways, turns * np.array([[1.0], [2.0], [1.0]])
    both, area = p + r, p * r - q * q
    known = (area > POOLING.flattest * both * both) & (np.abs(n).max(axis=0) > 0.0)
    determinant = np.where(known, both * area, np.nan)
    a = ((both * r - q * q) * u - q * r * v + q * q * w) / determinant
    b = (p * r * v - q * r * u - p * q * w) / determinant
    c = ((both * p - q * q) * w - p * q * v + q * q * u) / determinant
    return np.stack([a, b, c]), np.where(known, both, np.nan)


def _tangent_part(upper: Floats, basis: Floats) -> Floats:
    """The entries 11, 12, 22 (3, k) of symmetric matrices (6, k) in the tangent planes."""
    matrices = np.moveaxis(upper[_SQUARE], -1, 0)
    tangent = basis @ matrices @ basis.transpose(0, 2, 1)
    return np.stack([tangent[:, 0, 0], tangent[:, 0, 1], tangent[:, 1, 1]])


def _tangent_bases(normals: Floats) -> Floats:
    """Two orthonormal tangents of each unit normal, (k, 2, 3) [duff2017], Eq. 2."""
    x, y, z = normals.T
    sign = np.where(z >= 0.0, 1.0, -1.0)
    a = -1.0 / (sign + z)
    b = x * y * a
    first = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=1)
    return np.stack([first, np.stack([b, sign + y * y * a, -y], axis=1)], axis=1)
