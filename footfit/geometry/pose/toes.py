"""Toes: the grooves between them tell a foot from a last."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.outlines import outline
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.hulls import convex_hull, depth_under_hull


@dataclass(frozen=True, slots=True)
class ToeSettings:
    """Where grooves are looked for, and how deep they are; all over the length.

    Attributes
    ----------
    first, last, sections : float, float, int
        The sections across the toes. The toes begin at .80 on a foot with short ones.
    low : float
        The length is that of what lies lower, without a leg.
    upper : float
        Grooves lie over this share of a section's height: an arch under it is none.
    shown : int
        So many sections show a groove: one dent or hole is none.
    groove : float
        The least depth under the tape. Feet with separate toes have .0079 or more, lasts .0015 at
        most, with noise (docs/decisions/0228).
    """

    first: float = 0.80
    last: float = 0.98
    sections: int = 7
    low: float = 0.30
    upper: float = 0.25
    shown: int = 2
    groove: float = 0.004


TOES = ToeSettings()


def has_toes(points: Floats, faces: Ints) -> bool:
    """Whether the front of a shape has grooves, as between toes.

    Toes that are wrapped in a sock, or that a scanner did not tell apart, have none.

    Parameters
    ----------
    points : (n, 3)
        Roughly canonical and over the length: x from heel to toe, z up, ground near z = 0.
    faces : (m, 3)
    """
    low = points[points[:, 2] < TOES.low, 0]
    if not len(low):
        return False
    start, end = float(low.min()), float(low.max())
    places = start + np.linspace(TOES.first, TOES.last, TOES.sections) * (end - start)
    front, numbers, _ = without_unused_vertices(
        points, faces[(points[:, 0] > places[0])[faces].any(axis=1)]
    )
    depths = [_groove(front, numbers, x) for x in places]
    return bool(sorted(depths)[-TOES.shown] > TOES.groove)


def _groove(points: Floats, faces: Ints, x: float) -> float:
    """How deep the upper side of the section at x lies under a tape around it."""
    section = outline(points, faces, np.array([x, 0.0, 0.0]), np.eye(3)[1:], 1.0).points
    if not len(section):
        return 0.0
    height = section[:, 1] - section[:, 1].min()
    depths = depth_under_hull(section, convex_hull(section))
    return float(depths[height > TOES.upper * height.max()].max(initial=0.0))
