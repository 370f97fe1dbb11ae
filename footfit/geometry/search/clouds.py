"""A mesh as the pose search sees it: few points, then more, as it is and mirrored."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.samples import even_sample, farthest_points
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.search.icp import FIT, Poses
from footfit.geometry.search.templates import Singles

MIRROR = np.diag([1.0, -1.0, 1.0])


@dataclass(frozen=True, slots=True)
class Cloud:
    """The mesh as the fit sees it, float32; ``ends`` (k, 3) look up or down."""

    few: Singles
    few_normals: Singles
    many: Singles
    many_normals: Singles
    ends: Floats
    mirrored: bool

    def implausible(self, poses: Poses, upright: float) -> Singles:
        """What each pose (k,) pays for turning an end sideways."""
        steep = np.abs(poses.rotation[:, 2] @ self.ends.T)
        return np.asarray(FIT.implausible_cost * (steep < upright).any(axis=1), dtype=np.float32)


def both_clouds(
    vertices: Floats, faces: Ints, ends: Floats, many: int, few: int
) -> tuple[Cloud, Cloud]:
    """A mesh about its middle, as it is and mirrored, by ``many`` points and the same by few.

    ``ends`` (k, 3) are directions that look up or down.
    """
    sample = even_sample(vertices, faces, many)
    chosen = farthest_points(sample.points, few)
    points, normals = sample.points.astype(np.float32), sample.normals.astype(np.float32)
    flip = MIRROR.astype(np.float32)
    mirrored, looking = points @ flip, normals @ flip
    return (
        Cloud(points[chosen], normals[chosen], points, normals, ends, mirrored=False),
        Cloud(mirrored[chosen], looking[chosen], mirrored, looking, ends @ MIRROR, mirrored=True),
    )
