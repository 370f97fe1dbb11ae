"""Poses turned about the middle of a shape, and their mirror images."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.rotations import rotations_about
from footfit.geometry.search.clouds import MIRROR
from footfit.geometry.search.icp import Poses
from footfit.geometry.search.templates import Singles


def straight_turns() -> Singles:
    """The seven turns (7, 3, 3), without the identity, that leave the line of X in place."""
    half = np.diag([-1.0, -1.0, 1.0])
    rolls = [
        rotations_about(np.array([[angle, 0.0, 0.0]]))[0] for angle in np.pi / 2 * np.arange(4)
    ]
    every = [roll @ end for end in (np.eye(3), half) for roll in rolls]
    return np.array(every[1:], dtype=np.float32)


def turned_about(
    pose: Poses, turns: Singles, middle_y: float, middle: tuple[float, float]
) -> Poses:
    """One pose turned (k, 3, 3) about the middle of the shape, as k poses."""
    centre = np.array([middle[0], middle_y, middle[1]], dtype=np.float32)
    rotation = np.asarray(turns @ pose.rotation[0])
    shift = (pose.shift[0] - centre) @ turns.transpose(0, 2, 1) + centre
    return Poses(rotation, np.asarray(shift), np.repeat(pose.scale, len(turns)))


def mirror_image(poses: Poses, middle_y: float) -> Poses:
    """The poses (of the mirrored mesh) that leave it where the mesh is, but mirrored in place."""
    flip = MIRROR.astype(np.float32)
    shift = poses.shift * np.diag(flip)
    shift[:, 1] += np.float32(2 * middle_y)
    return Poses(np.asarray(flip @ poses.rotation @ flip), shift, poses.scale)
