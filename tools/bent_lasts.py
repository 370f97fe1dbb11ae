"""One last bent from a low heel to a higher one: its bottom keeps its own length along the arc.

A generator draws another last for each heel. Here the surface itself is bent, so what is measured
along the bottom must stay. Where a last is bent, its upper may follow in two ways: its sections
stay upright, or they turn with the bottom. Real bending lies between.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats

SEAT_PITCH = 0.45  # of the shank's steepest slope: trials say half of the chord's slope
SHANK = ((0.13, 0.16), (0.68, 0.16))  # where the slope begins and ends, and over which share
SEAT_END = (0.16, 0.14)
STEEPEST = 1.4  # radians


def bent(vertices_mm: Floats, length_mm: float, heel_mm: float, turning: float = 0.0) -> Floats:
    """The points of a flat last, bent until its heel stands ``heel_mm`` higher.

    Parameters
    ----------
    vertices_mm : (n, 3)
        A last as it stands: x from the rearmost point along the ground, z over it.
    length_mm : float
    heel_mm : float
        How much higher the rearmost point of the bottom comes to stand.
    turning : float
        0 leaves the sections upright, 1 turns them with the bottom.

    Returns
    -------
    (n, 3)
        As it stands then.
    """
    arc = np.linspace(-0.2, 1.2, 4001) * length_mm
    slope = _slope_for(heel_mm, arc / length_mm, arc)
    middle = 0.5 * (slope[1:] + slope[:-1])
    steps = np.diff(arc)
    x = np.concatenate([[0.0], np.cumsum(np.cos(middle) * steps)])
    z = np.concatenate([[0.0], np.cumsum(np.sin(middle) * steps)])
    x, z = x - np.interp(0.0, arc, x), z - np.interp(length_mm, arc, z)
    at, height = vertices_mm[:, 0], vertices_mm[:, 2]
    lean = turning * np.interp(at, arc, slope)
    return np.column_stack(
        [
            np.interp(at, arc, x) - height * np.sin(lean),
            vertices_mm[:, 1],
            np.interp(at, arc, z) + height * np.cos(lean),
        ]
    )


def _slope_for(heel_mm: float, station: Floats, arc: Floats) -> Floats:
    """The slope of the bottom (g,), radians, that raises the rearmost point by ``heel_mm``."""
    (start, rise), (end, fall) = SHANK
    shank = _eased((station - start) / rise) * _eased((end - station) / fall)
    seat = SEAT_PITCH * (1.0 - _eased((station - SEAT_END[0]) / SEAT_END[1]))
    shape = np.maximum(shank, seat)
    low, high = 0.0, STEEPEST
    for _ in range(60):
        steepest = 0.5 * (low + high)
        drop = np.trapezoid(np.sin(steepest * shape)[station >= 0.0], arc[station >= 0.0])
        low, high = (steepest, high) if drop < heel_mm else (low, steepest)
    return np.asarray(-steepest * shape)


def _eased(share: Floats) -> Floats:
    inside = np.clip(share, 0.0, 1.0)
    return np.asarray(inside**2 * (3.0 - 2.0 * inside))
