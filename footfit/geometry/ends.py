"""Whether a shape was cut across: a forefoot without its heel, a rearfoot without its toes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.samples import SurfaceSample
from footfit.geometry.topology import boundary_edges


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
    sample: SurfaceSample, rim: Floats, length: float, settings: EndSettings = ENDS
) -> Literal["heel", "toes"] | None:
    """The end of a canonical shape that was cut off: closed by a flat face, or left open.

    Parameters
    ----------
    sample : SurfaceSample
        The whole surface, canonical.
    rim : (n, 3) float64
        The mesh's boundary vertices, canonical; none for a closed mesh.
    length : float
    """
    below = settings.height * length  # a leg's own cut is no end of the foot
    rim = rim[rim[:, 2] < below]
    low_points = sample.points[sample.points[:, 2] < below, 0]
    low, high = low_points.min(), low_points.max()
    reach = settings.reach * length
    flat = (np.abs(sample.normals[:, 0]) > settings.facing) & (sample.points[:, 2] < below)
    for name, near, near_rim in (
        ("heel", sample.points[:, 0] < low + reach, rim[:, 0] < low + reach),
        ("toes", sample.points[:, 0] > high - reach, rim[:, 0] > high - reach),
    ):
        closed = sample.areas[flat & near].sum() > settings.flat_area * length**2
        if closed or _is_open(rim[near_rim], length, settings):
            return "heel" if name == "heel" else "toes"
    return None


def boundary_points(vertices: Floats, faces: Ints) -> Floats:
    """The vertices (k, 3) on the boundary."""
    return np.asarray(vertices[np.unique(boundary_edges(faces))])


def _is_open(rim: Floats, length: float, settings: EndSettings) -> bool:
    if len(rim) == 0:
        return False
    _, width, height = np.ptp(rim, axis=0)
    return bool(width > settings.rim_width * length and height > settings.rim_height * length)
