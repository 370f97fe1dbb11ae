"""Whether a shape was cut across: a forefoot without its heel, a rearfoot without its toes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.arrays import Floats
from footfit.geometry.samples import SurfaceSample


@dataclass(frozen=True, slots=True)
class EndSettings:
    """Everything numeric of the cut ends; lengths over L, areas over L squared."""

    height: float = 0.30
    reach: float = 0.10
    facing: float = 0.94
    flat_area: float = 0.03  # a heel or a square toe has .005-.02, a cut across .05-.09
    rim_width: float = 0.18
    rim_height: float = 0.08


ENDS = EndSettings()


def missing_end(
    sample: SurfaceSample, rims: list[Floats], length: float, settings: EndSettings = ENDS
) -> Literal["heel", "toes"] | None:
    """The end of a canonical shape that was cut off: closed by a flat face, or left open.

    Parameters
    ----------
    sample : SurfaceSample
        The whole surface, canonical.
    rims : list of (n, 3) float64
        The mesh's boundary loops, canonical; none for a closed mesh.
    length : float
    """
    below = settings.height * length  # a leg's own cut is no end of the foot
    low = sample.points[:, 2] < below
    x = sample.points[:, 0]
    back, front = float(x[low].min()), float(x[low].max())
    flat = low & (np.abs(sample.normals[:, 0]) > settings.facing)
    reach = settings.reach * length
    ends: tuple[tuple[Literal["heel", "toes"], float], ...] = (("heel", back), ("toes", front))
    for name, end in ends:
        closed = sample.areas[flat & (np.abs(x - end) < reach)].sum()
        if closed > settings.flat_area * length**2:
            return name
        near = [rim[(np.abs(rim[:, 0] - end) < reach) & (rim[:, 2] < below)] for rim in rims]
        if any(_is_open(part, length, settings) for part in near):
            return name
    return None


def _is_open(rim: Floats, length: float, settings: EndSettings) -> bool:
    """Whether a loop's part near an end is as large as the end: a hole in the heel is not."""
    if len(rim) == 0:
        return False
    _, width, height = np.ptp(rim, axis=0)
    return bool(width > settings.rim_width * length and height > settings.rim_height * length)
