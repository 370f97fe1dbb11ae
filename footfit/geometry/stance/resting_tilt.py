"""How far a last's frame is from the pose in which it rests on seat and tread.

A low last lies on its sole plane, which follows all of its bottom. On a table it rests on the
lower edge of its side view. A measure that is read in the frame varies with this angle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from footfit.geometry.mesh.outermost_point import LAST_TIPS, tip
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.middle_line import turned

ROUNDS = 3


class RestingTilt(NamedTuple):
    """The line that a last rests on: its angle (radians) from the plane z = 0, + if it rises
    forward, and how high it passes over the origin.
    """

    angle: float
    height_mm: float

    def levelled(self, points_mm: Floats) -> Floats:
        """Points (n, 3) in the frame in which the line is the X axis."""
        return turned(points_mm, self.angle) - [0.0, 0.0, self.height_mm]


def resting_tilt(
    vertices_mm: Floats, faces: Ints, waist_mm: float, length_mm: float
) -> RestingTilt | None:
    """The line that touches a last's bottom from below, behind its waist and in front of it.

    Parameters
    ----------
    vertices_mm : (n, 3)
        Of a last in its frame: x from heel to toe, z up.
    faces : (m, 3)
        Those that are low.
    waist_mm, length_mm : float
        Where its waist is along x, and its length.

    Returns
    -------
    RestingTilt or None
        None if there is nothing behind or in front of the waist.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0], [90, 0, 1], [99, 0, 1], [90, 9, 1]])
    >>> angle, height_mm = resting_tilt(corners, np.array([[0, 1, 2], [3, 4, 5]]), 40.0, 99.0)
    >>> bool(0.009 < angle < 0.012)
    True
    """
    front = vertices_mm[faces, 0].mean(axis=1) > waist_mm
    halves = faces[~front], faces[front]
    if not len(halves[0]) or not len(halves[1]):
        return None
    angle = height_mm = 0.0
    for _ in range(ROUNDS):
        down = np.array([np.sin(angle), 0.0, -np.cos(angle)])
        seat, tread = (tip(vertices_mm, half, down, length_mm, LAST_TIPS) for half in halves)
        apart_mm = float((tread.place - seat.place) @ [np.cos(angle), 0.0, np.sin(angle)])
        angle += (seat.reach - tread.reach) / apart_mm
        height_mm = -tread.reach
    return RestingTilt(float(angle), height_mm)
