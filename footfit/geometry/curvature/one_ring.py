"""The paper's concentrated curvature of a surface (III.C), from one ring of neighbours.

Convex is positive, k1 <= k2. ``vertices`` is (n, 3) float64 in any unit, ``faces`` (m, 3) int64,
welded and wound outward.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import face_normals, unit, vertex_sums
from footfit.geometry.mesh.topology import closed_fan_vertices
from footfit.geometry.numeric.angles import turning_angle
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class PrincipalCurvatures:
    """Per vertex, (n,) each; NaN where undefined. ``gaussian`` is k1 k2."""

    k1: Floats
    k2: Floats
    mean: Floats
    gaussian: Floats


def one_ring_curvature(vertices: Floats, faces: Ints, density: bool = True) -> PrincipalCurvatures:
    """The paper's concentrated curvatures at every vertex (III.C).

    At a vertex p, the plane through the normal n_p and a neighbour v_i cuts the far side of the
    ring around p in w_i. The polygonal line v_i p w_i turns by the concentrated curvature
    pi - gamma_i (Eq. 12, 13), + where it bends away from the normal. k1 is the smallest over the
    neighbours, k2 the largest, ``mean`` the mean of all, ``gaussian`` k1 k2.

    Parameters
    ----------
    vertices, faces
        See the module.
    density : bool
        Divide each pi - gamma_i by the mean of its two edges, |v_i - p| and |w_i - p|: curvatures
        in 1/length (``gaussian`` in 1/length^2), which compare a coarse and a fine mesh. Otherwise
        the paper's angles in radians, which shrink with the edges.

    Returns
    -------
    PrincipalCurvatures
        NaN where the faces around p are not one closed fan (at a boundary, at an edge of three
        faces, where the winding turns) and where no plane meets the far side.

    Notes
    -----
    n_p is the plain mean of the unit normals of the faces around p. The sum of k1 k2 over a closed
    surface is not 2 pi times its Euler characteristic: Eq. 11 holds for another quantity, 2 pi
    minus the angles around a vertex.
    """
    n = len(vertices)
    normals = unit(vertex_sums(face_normals(vertices, faces), faces, n))
    k1, k2, mean = np.full(n, np.nan), np.full(n, np.nan), np.full(n, np.nan)
    for centre, near, far in _fans(faces, n):
        curvature = _normal_curvatures(vertices, normals, (centre, near, far), density)
        known = ~np.isnan(curvature)
        some = known.any(axis=1)
        curvature, known, centre = curvature[some], known[some], centre[some]
        k1[centre] = np.where(known, curvature, np.inf).min(axis=1)
        k2[centre] = np.where(known, curvature, -np.inf).max(axis=1)
        mean[centre] = np.where(known, curvature, 0.0).sum(axis=1) / known.sum(axis=1)
    return PrincipalCurvatures(k1, k2, mean, k1 * k2)


def _fans(faces: Ints, n: int) -> list[tuple[Ints, Ints, Ints]]:
    """The vertices with a closed fan, by valence d: centre (k,), the link's edges near, far (k, d).

    On a closed fan, the near ends are all neighbours, each once.
    """
    corners = faces.ravel()
    near, far = faces[:, [1, 2, 0]].ravel(), faces[:, [2, 0, 1]].ravel()
    order = np.argsort(corners, kind="stable")
    valence = np.bincount(corners, minlength=n)
    first = np.cumsum(valence) - valence
    closed = closed_fan_vertices(faces, n)
    fans = []
    for d in np.unique(valence[closed]):
        centre = np.flatnonzero(closed & (valence == d))
        places = order[first[centre][:, None] + np.arange(d)]
        fans.append((centre, near[places], far[places]))
    return fans


def _normal_curvatures(
    vertices: Floats, normals: Floats, fan: tuple[Ints, Ints, Ints], density: bool
) -> Floats:
    """The normal curvature over each neighbour v_i, (k, d); NaN where there is no w_i."""
    centre, near, far = fan
    p, n = vertices[centre], normals[centre]
    v, b = vertices[near] - p[:, None], vertices[far] - p[:, None]
    height_v, height_b = np.einsum("kdx,kx->kd", v, n), np.einsum("kdx,kx->kd", b, n)
    flat_v = v - height_v[:, :, None] * n[:, None]
    side = np.cross(n[:, None], flat_v)
    along = unit(flat_v.reshape(-1, 3)).reshape(flat_v.shape)
    # On which side of neighbour i's plane each link vertex j lies: (k, i, j).
    off_v, off_b = side @ v.transpose(0, 2, 1), side @ b.transpose(0, 2, 1)
    crossed = (off_v < 0.0) != (off_b < 0.0)
    share = off_v / np.where(crossed, off_v - off_b, 1.0)
    u_v, u_b = along @ v.transpose(0, 2, 1), along @ b.transpose(0, 2, 1)
    w_along = u_v + share * (u_b - u_v)
    w_up = height_v[:, None] + share * (height_b - height_v)[:, None]
    backward = np.where(crossed & (w_along < 0.0), -w_along / np.hypot(w_along, w_up), -np.inf)
    # A link that folds is cut several times; w_i is then the cut that bends least.
    best = np.argmax(backward, axis=2)[:, :, None]
    w = np.stack([np.take_along_axis(x, best, axis=2)[:, :, 0] for x in (w_along, w_up)], axis=2)
    v_plane = np.stack([np.einsum("kdx,kdx->kd", v, along), height_v], axis=2)
    turned = turning_angle(-v_plane, w)  # Eq. 13 by atan2: pi - gamma_i with its sign
    if density:
        turned /= 0.5 * (np.linalg.norm(v, axis=2) + np.linalg.norm(w, axis=2))
    met = np.isfinite(np.take_along_axis(backward, best, axis=2)[:, :, 0])
    curvature: Floats = np.where(met, turned, np.nan)
    return curvature
