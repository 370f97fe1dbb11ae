"""Where a foot's heel ends upward, if its shank leans back over it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.levelled_bottom import low_length
from footfit.geometry.mesh.sections import lowest, sections_across
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class ShankSettings:
    """Where a heel's narrowing is looked for, over the length.

    Attributes
    ----------
    heights, levels : tuple of float, int
        Between which heights, and at how many. A heel narrows at .20-.30; its rear is at .06-.18.
    near : float
        A shank matters only if it comes so near to the rearmost point.
    rear : float
        How far forward the back of the heel is looked at.
    """

    heights: tuple[float, float] = (0.10, 0.30)
    levels: int = 21
    near: float = 0.012
    rear: float = 0.25


SHANK = ShankSettings()


def heel_end(vertices: Floats, faces: Ints) -> float:
    """The height of the heel's narrowing if the shank leans back over the heel, else infinity.

    The narrowing is the height at which the heel's back lies farthest in front of the heel's rear
    below and of the shank's rear above. There the heel bone ends.

    Parameters
    ----------
    vertices : (n, 3)
        Of a canonical foot.
    faces : (m, 3)
    """
    start, length = low_length(vertices, SHANK.heights[1])
    x, z = vertices[:, 0], vertices[:, 2]
    low, high = (height * length for height in SHANK.heights)
    near = (x < start + SHANK.near * length) & (z < high)
    if not (near & (z > 0.5 * (low + high))).any():
        return np.inf
    a, b, c = (x < start + SHANK.rear * length)[faces.T]
    levels = np.linspace(low, high, SHANK.levels)
    cuts = sections_across(vertices[:, ::-1], faces[a & b & c], levels)
    back = lowest(cuts.points[:, :, 2], cuts)
    below, above = np.fmin.accumulate(back), np.fmin.accumulate(back[::-1])[::-1]
    hollow = np.nan_to_num(back - np.maximum(below, above))
    return float(levels[hollow.argmax()]) if hollow.any() else np.inf


def without_leaning_shank(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """A canonical foot without the part of its shank, if any, that leans back over its heel."""
    height = heel_end(vertices, faces)
    if height == np.inf:
        return vertices, faces
    start, length = low_length(vertices, SHANK.heights[1])
    shank = (vertices[:, 2] > height) & (vertices[:, 0] < start + SHANK.rear * length)
    a, b, c = shank[faces.T]
    vertices, faces, _ = without_unused_vertices(vertices, faces[~(a & b & c)])
    return vertices, faces
