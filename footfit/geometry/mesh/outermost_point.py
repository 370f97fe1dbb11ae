"""The outermost point of a surface in a direction, steadier than its outermost vertex.

A vertex that sticks out is noise as often as shape. With 0.3 mm of noise, the outermost vertex of a
scan lies about half a millimetre too far out. So the extreme is computed from the area that lies
beyond a level, as that level moves inward.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.nearest import part_middles
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats, Ints, row_lengths

_PARTS = part_middles(4)


@dataclass(frozen=True, slots=True)
class TipSettings:
    """Depths under the outermost vertex, over the shape's length.

    Attributes
    ----------
    law, levels : tuple of float, int
        Between which depths, and at how many, the growth of the area is read.
    degree : int
        Of the curve through the areas: 1 if the area grows evenly, 2 if it grows faster farther in.
    cap : float
        The part of the surface above this depth is the cap whose middle is the tip's place.
    """

    law: tuple[float, float] = (0.0026, 0.0085)
    levels: int = 6
    degree: int = 1
    cap: float = 0.012


TIPS = TipSettings()
LAST_TIPS = TipSettings(law=(0.0026, 0.012), levels=8, degree=2, cap=0.006)
"""Of a last: it is smooth, has one toe, and may have an edge there, so that more can be read."""


@dataclass(frozen=True, slots=True)
class Tip:
    """``reach`` is the largest p . direction; ``place`` (3,) is the middle of the cap there."""

    reach: float
    place: Floats


def tip(
    vertices: Floats,
    faces: Ints,
    direction: Floats,
    length: float,
    settings: TipSettings = TIPS,
) -> Tip:
    """The outermost point of a surface in a direction.

    Take a level at the depth t under the extreme of a smooth surface. The area beyond it is 2 pi t
    times a radius (exactly so on a sphere: Archimedes), so it grows evenly with t. The extreme is
    where the straight line through the areas at several depths meets zero, or a parabola, if the
    settings say so: towards an edge, the area grows faster farther in. Noise that is as often
    inward as outward does not move that line. The areas are exact for triangles of any size.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
        At least one.
    direction : (3,)
        A unit vector.
    length : float
        The shape's length, which depths are multiplied by.
    settings : TipSettings

    Returns
    -------
    Tip
        Not beyond the outermost vertex, and not deeper under it than the first level.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
    >>> tip(corners, np.array([[0, 1, 2]]), np.array([0.0, 0, 1]), 4.0).reach
    0.0
    """
    values = vertices @ direction
    corner = values[faces]
    outermost = np.maximum(np.maximum(corner[:, 0], corner[:, 1]), corner[:, 2])
    top = float(outermost.max())
    near = outermost > top - max(settings.law[1], settings.cap) * length
    corner, triangles = corner[near], vertices[faces[near]]
    sides = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = row_lengths(cross(*sides))
    depth = np.linspace(*settings.law, settings.levels) * length
    inward = _no_area(depth, area @ share_over(corner, top - depth), settings.degree)
    weight = np.maximum(corner @ _PARTS.T - (top - settings.cap * length), 0.0) * area[:, None]
    of_corners = (weight @ _PARTS).ravel()
    place = of_corners @ triangles.reshape(-1, 3) / max(weight.sum(), 1e-300)
    if not weight.any():  # a spike so thin that no middle of a part lies in the cap
        place = vertices[faces].reshape(-1, 3)[np.argmax(values[faces])]
    return Tip(top - float(np.clip(inward, 0.0, depth[0])), place)


def _no_area(depth: Floats, beyond: Floats, degree: int) -> float:
    """The depth at which the area beyond it, (k,) at depths (k,), would be zero.

    Examples
    --------
    >>> depth = np.array([1.0, 2.0, 3.0])
    >>> round(_no_area(depth, 5.0 * (depth - 0.2), 1), 9)
    0.2
    >>> round(_no_area(depth, (depth - 0.2) + (depth - 0.2) ** 2, 2), 9)
    0.2
    """
    slope, start = np.polyfit(depth, beyond, 1)
    if slope <= 0.0:
        return 0.0
    if degree == 2:
        bend, rise, level = np.polyfit(depth, beyond, 2)
        inside = rise**2 - 4.0 * bend * level
        if rise > 0.0 and inside > 0.0:  # else the curve turns before it meets zero
            return float(-2.0 * level / (rise + np.sqrt(inside)))
    return float(-start / slope)


def share_over(corner_values: Floats, levels: Floats) -> Floats:
    """The share of each triangle (m, levels) where a linear function is over each level.

    Parameters
    ----------
    corner_values : (m, 3)
    levels : (k,)

    Examples
    --------
    >>> share_over(np.array([[0.0, 0.0, 1.0]]), np.array([-1.0, 0.5, 2.0]))
    array([[1.  , 0.25, 0.  ]])
    """
    low, middle, high = (column[:, None] for column in np.sort(corner_values, axis=1).T)
    rise, fall = (middle - low) * (high - low), (high - middle) * (high - low)
    at = np.clip(levels, low, high)
    under = np.square(at - low) / np.where(rise > 0.0, rise, 1.0)
    over = np.square(high - at) / np.where(fall > 0.0, fall, 1.0)
    return np.asarray(np.where(levels <= middle, 1.0 - under, over))
