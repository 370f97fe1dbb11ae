"""The two shapes that poses are fitted to, a foot with a long leg and a last.

They are part of the program and depend on no catalogue. Lengths are in units of the length L, in
the canonical frame of a right shape. ``pipeline/scan/shipped_templates.py`` loads them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.numeric.arrays import Ints

Singles = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Template:
    """Points of one shape, and a voxel table of the nearest of them.

    ``kind`` is "foot" or "last"; ``points`` and ``normals`` are (n, 3). ``table`` (nx, ny, nz)
    int16 holds, for the voxel with the lower corner ``origin + pitch * index``, the point nearest
    to the voxel's middle. ``middle_y`` is the middle of the extent in y of the part below z = 0.35.
    """

    kind: str
    points: Singles
    normals: Singles
    origin: Singles
    pitch: float
    table: NDArray[np.int16]
    middle_y: float

    def nearest(self, points: Singles) -> Ints:
        """The index of the point nearest to each of (..., 3), by table: exact to about a pitch.

        Points outside the table get the answer of the voxel at its edge.
        """
        scaled = (points - self.origin) * np.float32(1 / self.pitch)
        nx, ny, nz = self.table.shape
        i = np.clip(scaled[..., 0], 0, nx - 1).astype(np.int32)
        j = np.clip(scaled[..., 1], 0, ny - 1).astype(np.int32)
        k = np.clip(scaled[..., 2], 0, nz - 1).astype(np.int32)
        return np.asarray(self.table.ravel()[(i * ny + j) * nz + k], dtype=np.int64)
