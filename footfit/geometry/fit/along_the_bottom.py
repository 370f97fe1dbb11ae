"""How long a last is along its bottom, from what the catalogue keeps of it: no mesh is read.

A foot that was scanned flat lies along the bottom of a last. Along the ground, or along the resting
plane, a last with a heel is shorter than its bottom.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats

Number = float | Floats


@dataclass(frozen=True, slots=True)
class AlongBottomSettings:
    """What is assumed of a bottom; lengths over the length, ``mm`` as named.

    Attributes
    ----------
    level_mm, raised_mm : float
        Up to the first heel height a last counts as level: its own length is taken. From the second
        on the length along the bottom is taken, and between them a part of each.
    between_sd_mm : float
        The two differ by so much there, times the part of the one and the part of the other.
    seat : float
        The seat is straight as far from the rearmost point; its angle is measured up to there.
    overhang, overhang_sd : float
        How far the heel's back and the toe's tip usually stand out over the feather edges, together
        (two families of lasts, level ones).
    bend_sd : float
        How unsure the bend of the shank is, in mm for each mm of heel.
    turned, turned_sd : float
        How much of the heel's overhang the ground does not show, for a seat at right angles to it:
        sections that turn with the seat hide twice as much, sections that stay upright nothing.
    least_toe : float
        The toe is taken to spring over at least as much.
    """

    level_mm: float = 10.0
    raised_mm: float = 40.0
    between_sd_mm: float = 4.5
    seat: float = 0.14
    overhang: float = 0.0235
    overhang_sd: float = 0.006
    bend_sd: float = 0.012
    turned: float = 0.015
    turned_sd: float = 0.018
    least_toe: float = 0.08


ALONG_BOTTOM = AlongBottomSettings()
GAUSS = (
    (0.2386191860831969, 0.46791393457269104),
    (0.6612093864662645, 0.3607615730481387),
    (0.9324695142031519, 0.17132449237917027),
)
"""Half of the places from -1 to 1, and their weights, of Gauss's rule of six points (as
``numpy.polynomial.legendre.leggauss`` gives them, which takes 2 ms to load).
"""
_PLACES = [
    *((0.5 - 0.5 * place, 0.5 * weight) for place, weight in GAUSS[::-1]),
    *((0.5 + 0.5 * place, 0.5 * weight) for place, weight in GAUSS),
]


@dataclass(frozen=True, slots=True)
class LastLengths:
    """Measures of a last by their names, in mm, and ``seat_angle_deg``; or (n,) of n lasts."""

    bottom_length: Number
    stick_length: Number
    heel_height: Number
    seat_angle_deg: Number
    tread_from: Number
    tread_to: Number
    toe_spring_tip: Number


def length_along_bottom(
    level_mm: Number, last: LastLengths, settings: AlongBottomSettings = ALONG_BOTTOM
) -> tuple[Number, Number]:
    """A last's length along its bottom with both overhangs, and its standard deviation, in mm; of
    n lasts (n,) each.

    It is ``bottom_length`` and what stands out over the feather edges. How much that is, the stick
    length says, if what the bottom's bend takes from it is added. On a high heel this is less sure
    than what lasts usually have, so the two are averaged by their variances. The toe spring counts
    along the ground, as on a level last, whose own length is ``level_mm``.

    Examples
    --------
    >>> last = LastLengths(249.7, 229.7, 83.1, 20.2, 139.8, 182.8, 6.0)
    >>> [round(float(mm), 1) for mm in length_along_bottom(255.0, last)]
    [255.6, 1.2]
    """
    part = (last.heel_height - settings.level_mm) / (settings.raised_mm - settings.level_mm)
    part = np.clip(part, 0.0, 1.0)
    toe_mm = np.maximum(last.stick_length - last.tread_to, settings.least_toe * last.stick_length)
    spring_mm = 2.0 * last.toe_spring_tip**2 / (3.0 * toe_mm)  # a parabola's arc over its run
    pitch = np.sin(np.radians(last.seat_angle_deg)) * last.bottom_length
    run_mm = last.stick_length + _bend_mm(last, settings) + settings.turned * pitch
    overhang_mm = run_mm + spring_mm - last.bottom_length
    sd_mm = np.hypot(settings.bend_sd * last.heel_height, settings.turned_sd * pitch)
    usual_mm = settings.overhang * last.bottom_length
    usual_sd_mm = settings.overhang_sd * last.bottom_length
    trust = usual_sd_mm**2 / (usual_sd_mm**2 + sd_mm**2)
    along_mm = last.bottom_length - spring_mm + usual_mm + trust * (overhang_mm - usual_mm)
    between_sd_mm = (1.0 - part) * settings.between_sd_mm
    spread_mm = part * np.hypot(np.sqrt(trust) * sd_mm, between_sd_mm)
    level = part == 0.0
    whole_mm = np.where(level, level_mm, level_mm + part * (along_mm - level_mm))
    return whole_mm[()], np.where(level, 0.0, spread_mm)[()]


def _bend_mm(last: LastLengths, settings: AlongBottomSettings) -> Number:
    """How much longer the bottom's curve is than its run, from the rearmost point to the tread.

    The seat is straight. From its end a cubic runs to the level tread.
    """
    seat_mm, slope = settings.seat * last.stick_length, -np.tan(np.radians(last.seat_angle_deg))
    run_mm = np.maximum(last.tread_from - seat_mm, seat_mm)
    fall = -(last.heel_height + slope * seat_mm) / run_mm
    arc: Number = 0.0
    for place, weight in _PLACES:
        steep = 6.0 * place * (1.0 - place) * fall + (3.0 * place - 1.0) * (place - 1.0) * slope
        arc += weight * np.hypot(1.0, steep)
    return seat_mm * (np.hypot(1.0, slope) - 1.0) + run_mm * (arc - 1.0)
