"""Pooling over a surface: values spread as heat does, and each vertex gets a local mean.

The weights are those of exp(-t L), where L is the cotangent Laplacian. They are close to a Gaussian
of standard deviation sqrt(2 t) along the surface, and never jump to another sheet nearby. A short
Chebyshev polynomial stands for exp, so that no system of equations is solved.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, vertex_sums
from footfit.geometry.numeric.arrays import Floats, Ints, row_dots, row_lengths

if TYPE_CHECKING:
    from scipy.sparse import csr_array


@dataclass(frozen=True, slots=True)
class DiffusionSettings:
    """How exactly exp(-t L) is followed.

    Attributes
    ----------
    tolerance : float
        Chebyshev coefficients below it are left out; the weights still sum to 1.
    degree_most : int
        The highest degree. Vertices that exchange heat too fast for it are slowed down.
    nodes : int
        The number of Chebyshev nodes from which the coefficients are computed.
    crowding_quantile, crowding : float
        The vertices of slivers exchange heat very fast. Rates over ``crowding`` times this quantile
        of all rates are cut to it.
    reach_least : float
        t times the rate of every vertex is at least this, so that the nearest ring always counts.
    followed : float
        The largest product of time and rate that the polynomials follow, over degree_most^2.
    cotangent_least : float
        Cotangents are at least this, since obtuse corners would give negative weights.
    """

    tolerance: float = 1e-3
    degree_most: int = 96
    nodes: int = 200
    crowding_quantile: float = 0.9
    crowding: float = 1.2
    reach_least: float = 0.25
    followed: float = 0.15
    cotangent_least: float = 0.05


SETTINGS = DiffusionSettings()


@dataclass(frozen=True, slots=True)
class Diffusion:
    """Polynomials in a mesh's Laplacian, one for each deviation, for :func:`pooled_fields`.

    ``step`` (n, n) is the sparse matrix of Y. ``coefficients`` are those of the Chebyshev
    polynomials in Y, (degree + 1,) for each deviation.
    """

    step: csr_array
    coefficients: tuple[Floats, ...]


def diffusion(vertices: Floats, faces: Ints, deviations: tuple[float, ...]) -> Diffusion:
    """The operator that pools over a surface, with each of some standard deviations.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Welded and consistently wound; the mesh may be open.
    deviations : tuple of float
        In the coordinates' unit, > 0.

    Notes
    -----
    L f = (d f - sum of w f_q) / a, with degrees d, cotangent weights w and vertex areas a. The
    polynomial is in Y = 2 L / bound - 1, whose eigenvalues lie in [-1, 1].
    """
    from scipy.sparse import diags_array

    times = [0.5 * deviation * deviation for deviation in deviations]
    weights = _cotangent_matrix(vertices, faces)
    degree = weights.sum(axis=1)
    rate = _exchange_rates(degree, _projected_areas(vertices, faces), max(times))
    bound = 2.0 * float(rate.max(initial=0.0)) or 1.0
    scale = 2.0 * rate / bound
    step = (
        diags_array(scale - 1.0)
        - diags_array(scale / np.where(degree > 0.0, degree, 1.0)) @ weights
    )
    coefficients = tuple(_heat_coefficients(time * bound) for time in times)
    return Diffusion(step.tocsr(), coefficients)


def pooled_fields(operator: Diffusion, fields: Floats) -> Floats:
    """Fields (c, n) pooled over the surface, (deviations, c, n).

    Each value is a mean over its neighbourhood, with weights that sum to 1.
    """
    pooled = np.empty((len(operator.coefficients), *fields.shape))
    degree = max(map(len, operator.coefficients)) - 1
    for number, field in enumerate(fields):
        before, now = np.zeros_like(field), field
        totals = [coefficients[0] * now for coefficients in operator.coefficients]
        for k in range(1, degree + 1):
            following = operator.step @ now
            if k > 1:  # T_k = 2 Y T_k-1 - T_k-2
                following *= 2.0
                following -= before
            before, now = now, following
            for total, coefficients in zip(totals, operator.coefficients, strict=True):
                if k < len(coefficients):
                    total += coefficients[k] * now
        pooled[:, number] = totals
    return pooled


def _projected_areas(vertices: Floats, faces: Ints) -> Floats:
    """A third of the area around each vertex, seen along its own normal, (n,).

    Noise wrinkles a surface and so adds to its area, but not to the sum of the area vectors.
    """
    return row_lengths(vertex_sums(area_vectors(vertices, faces), faces, len(vertices))) / 3.0


def _cotangent_matrix(vertices: Floats, faces: Ints) -> csr_array:
    """The symmetric matrix (n, n) of the cotangent weights between neighbours."""
    from scipy.sparse import coo_array

    start, end, opposite = faces.ravel(), faces[:, [1, 2, 0]].ravel(), faces[:, [2, 0, 1]].ravel()
    u, v = vertices[start] - vertices[opposite], vertices[end] - vertices[opposite]
    doubled = 2.0 * np.linalg.norm(area_vectors(vertices, faces), axis=1)
    across = np.repeat(np.where(doubled > 0.0, doubled, np.inf), 3)
    weight = np.maximum(row_dots(u, v) / across, SETTINGS.cotangent_least) / 2.0
    shape = (len(vertices), len(vertices))
    half = coo_array((weight, (start, end)), shape).tocsr()
    return half + half.T


def longest_deviation(vertices: Floats, faces: Ints) -> float:
    """The deviation beyond which half of the vertices spread no further; inf without area."""
    degree = _cotangent_matrix(vertices, faces).sum(axis=1)
    rate, crowded = _free_rates(degree, _projected_areas(vertices, faces))
    known = rate[(degree > 0.0) & np.isfinite(rate)]
    if len(known) == 0:
        return float(np.inf)
    median = min(float(np.median(known)), crowded)
    return float(np.sqrt(2.0 * SETTINGS.followed / median)) * SETTINGS.degree_most


def _free_rates(degree: Floats, area: Floats) -> tuple[Floats, float]:
    """Each vertex's degree over area, inf without area, and the rate that slivers are cut to."""
    rate = np.divide(degree, area, out=np.full_like(degree, np.inf), where=area > 0.0)
    known = rate[(degree > 0.0) & np.isfinite(rate)]
    if len(known) == 0:
        return rate, float(np.inf)
    return rate, SETTINGS.crowding * float(np.quantile(known, SETTINGS.crowding_quantile))


def _exchange_rates(degree: Floats, area: Floats, time: float) -> Floats:
    """Degree over area, at least what reaches the nearest ring, at most what is followed."""
    rate, crowded = _free_rates(degree, area)
    followed = SETTINGS.followed * SETTINGS.degree_most**2 / time
    least = SETTINGS.reach_least / time
    limited: Floats = np.clip(rate, least, max(least, min(crowded, followed)))
    return np.where(degree > 0.0, limited, 0.0)


def _heat_coefficients(exponent: float) -> Floats:
    """Chebyshev coefficients of exp(-exponent (1 + y) / 2) on [-1, 1], summing to 1 at y = -1."""
    angle = np.pi * (np.arange(SETTINGS.nodes) + 0.5) / SETTINGS.nodes
    values = np.exp(-0.5 * exponent * (1.0 + np.cos(angle)))
    k = np.arange(SETTINGS.degree_most + 1)
    coefficients: Floats = np.cos(np.outer(k, angle)) @ values * (2.0 / SETTINGS.nodes)
    coefficients[0] *= 0.5
    kept = np.flatnonzero(np.abs(coefficients) > SETTINGS.tolerance)
    coefficients = coefficients[: max(2, int(kept[-1]) + 1)]
    total: float = float(np.sum(coefficients * (-1.0) ** np.arange(len(coefficients))))
    return coefficients / total
