"""A last laid on the longest lower edge of its side view, as it rests on a table."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull

from footfit.geometry.numeric.arrays import Floats


def at_rest(points: Floats) -> tuple[Floats, float]:
    """Points (n, 3) laid on their resting line, and the angle (radians) that this turned them by.

    The angle is + if the heel was lowered: it leads from the resting plane back to the ground.
    """
    hull = points[ConvexHull(points[:, [0, 2]]).vertices][:, [0, 2]]
    edges = np.roll(hull, -1, axis=0) - hull
    below = edges[np.argmax(np.where(edges[:, 0] > 0, edges[:, 0], 0.0))]
    angle = -float(np.arctan2(below[1], below[0]))
    resting = pitched(points, -angle)
    return resting - resting.min(axis=0) * [1.0, 0.0, 1.0], angle


def pitched(points: Floats, angle: float) -> Floats:
    """Points (n, 3) turned about Y; an angle (radians) above 0 raises the rear.

    Examples
    --------
    >>> pitched(np.array([[1.0, 5.0, 0.0]]), np.pi / 2).round(9).tolist()
    [[0.0, 5.0, -1.0]]
    """
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])
    return np.asarray(points @ turn)
