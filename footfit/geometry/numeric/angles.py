"""Angles between vectors, taken by atan2.

The paper's Eq. 13 takes gamma = arccos(a . b / |a||b|). Nearly every vertex of a scan has a gamma
near pi, and there arccos turns an error of 1e-16 into 1e-8. atan2 of cross and dot does not.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats


def angle_between(a: Floats, b: Floats) -> Floats:
    """The unsigned angle between 3-D vectors, (...,) radians in [0, pi].

    Parameters
    ----------
    a, b : (..., 3) float64
        Any lengths, any unit; they broadcast. The angle with a zero vector is 0.

    Examples
    --------
    >>> float(angle_between(np.array([1.0, 0, 0]), np.array([-1.0, 1e-9, 0])) - np.pi) < -0.9e-9
    True
    """
    ax, ay, az = np.moveaxis(np.asarray(a), -1, 0)
    bx, by, bz = np.moveaxis(np.asarray(b), -1, 0)
    x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    across = np.sqrt(x * x + y * y + z * z)
    angle: Floats = np.arctan2(across, ax * bx + ay * by + az * bz)  # Eq. 13
    return angle


def turning_angle(a: Floats, b: Floats) -> Floats:
    """The signed angle from 2-D vector ``a`` to ``b``, (...,) radians in (-pi, pi].

    Counter-clockwise is positive.

    Parameters
    ----------
    a, b : (..., 2) float64
        Any lengths, any unit; they broadcast.

    Examples
    --------
    >>> float(turning_angle(np.array([1.0, 0.0]), np.array([0.0, -2.0])) / np.pi)
    -0.5
    """
    ax, ay = np.moveaxis(np.asarray(a), -1, 0)
    bx, by = np.moveaxis(np.asarray(b), -1, 0)
    angle: Floats = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
    return angle
