"""Crude made feet: straight tubes from ball to ball, joined; five toes apart, no arch drawn."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold, OpType

from tests.shapes import Mesh

Ball = tuple[tuple[float, float, float], float]
TUBES: tuple[tuple[Ball, Ball], ...] = (
    (((0.12, 0.0, 0.12), 0.12), ((0.18, 0.0, 0.35), 0.12)),  # heel and ankle
    (((0.12, 0.0, 0.12), 0.12), ((0.55, 0.02, 0.08), 0.09)),
    (((0.22, 0.0, 0.24), 0.10), ((0.68, 0.05, 0.06), 0.06)),  # the instep
    (((0.30, -0.06, 0.07), 0.06), ((0.66, -0.11, 0.04), 0.05)),  # the outer edge
    (((0.45, 0.06, 0.08), 0.06), ((0.72, 0.11, 0.05), 0.06)),
    (((0.70, 0.09, 0.05), 0.055), ((0.66, -0.10, 0.04), 0.05)),  # across the ball
)
TOES: tuple[tuple[float, float, float], ...] = (
    (0.945, 0.115, 0.048), (0.955, 0.050, 0.034), (0.92, 0.000, 0.033), (0.88, -0.050, 0.031),
    (0.83, -0.100, 0.030),
)  # fmt: skip
"""Where each toe ends, and how thick it is."""
SEGMENTS = 36


def tube_foot(
    length_mm: float,
    *,
    leg: float = 0.45,
    wide: float = 1.0,
    bunion: float = 0.0,
    sock: bool = False,
) -> Mesh:
    """A right foot of tubes on the ground z = 0, mm.

    Parameters
    ----------
    length_mm : float
        About; the toes end at .99 of it.
    leg : float
        Where the leg is cut, over the length.
    wide : float
        Times the usual width.
    bunion : float
        How far the inner ball joint is pushed out, over the length.
    sock : bool
        Whether a sock lies around the toes, which then are one.
    """
    tubes = [_tube(*ends) for ends in TUBES]
    joint = 0.11 + bunion
    toes = []
    for x, y, thick in TOES:
        start = (0.72 - 0.25 * (0.95 - x), joint if y > 0.1 else y, 0.05)
        toes.append(_tube((start, 1.2 * thick), ((x, y - 0.3 * bunion * (y > 0.1), thick), thick)))
    tubes += [Manifold.batch_hull(toes)] if sock else toes
    tubes.append(_tube(((0.18, 0.0, 0.30), 0.12), ((0.20, 0.0, leg + 0.2), 0.12)))
    whole = Manifold.batch_boolean(tubes, OpType.Add)
    above, below = Manifold.cube((3.0, 3.0, leg)).translate((-1.0, -1.5, 0.004)), whole
    solid = (below ^ above).scale((length_mm, wide * length_mm, length_mm))
    mesh = solid.refine_to_length(0.04 * length_mm).to_mesh()
    points = np.asarray(mesh.vert_properties[:, :3], dtype=np.float64)
    return points - [0.0, 0.0, points[:, 2].min()], np.asarray(mesh.tri_verts, dtype=np.int64)


def _tube(start: Ball, end: Ball) -> Manifold:
    balls = [Manifold.sphere(radius, SEGMENTS).translate(place) for place, radius in (start, end)]
    return Manifold.batch_hull(balls)
