"""Widths: of the ball, of the heel, of a last's bottom."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.arrays import Floats
from footfit.geometry.landmarks import Shape
from footfit.geometry.measures_lengths import NO_BALL
from footfit.geometry.readings import OPEN, Reading


@dataclass(frozen=True, slots=True)
class WidthSettings:
    """Where widths are taken, over the length."""

    forefoot: tuple[float, float] = (0.50, 0.90)
    heel: float = 1.0 / 6.0
    ball: float = 0.66
    beside: tuple[float, ...] = (-0.015, 0.0, 0.015)  # sections that are averaged
    bottom_beside: tuple[float, ...] = (-0.03, -0.015, 0.0, 0.015, 0.03)
    height: float = 0.15  # over each section's lowest point; over it ankles may stand out


WIDTHS = WidthSettings()


def ball_width(shape: Shape) -> Reading:
    """From MT1 to MT5 in plan (the oblique ball width)."""
    if shape.mt1 is None or shape.mt5 is None:
        return Reading(None, NO_BALL)
    return Reading(float(np.hypot(*(shape.mt1 - shape.mt5)[:2])))


def ball_width_orthogonal(shape: Shape) -> Reading:
    """Between the two tangents along X at the forefoot (ISO 7250-1 foot breadth)."""
    medial, lateral = (shape.outermost(side, WIDTHS.forefoot) for side in (1.0, -1.0))
    if medial is None or lateral is None:
        return Reading(None, NO_BALL)
    return Reading(float(medial[1] - lateral[1]))


def heel_width(shape: Shape) -> Reading:
    """Across the heel at one sixth of the length from the pternion."""
    return _mean_width(shape, [WIDTHS.heel + by for by in WIDTHS.beside], "heel", _lower_width)


def bottom_width_ball(shape: Shape) -> Reading:
    """Across the bottom of a last at the ball, from feather edge to feather edge."""
    return _bottom_width(shape, WIDTHS.ball, "ball")


def bottom_width_heel(shape: Shape) -> Reading:
    """Across the bottom of a last at one sixth of the length, from feather edge to feather edge."""
    return _bottom_width(shape, WIDTHS.heel, "heel")


def _bottom_width(shape: Shape, share: float, place: str) -> Reading:
    shares = [share + by for by in WIDTHS.bottom_beside]
    return _mean_width(shape, shares, place, _feather_width)


def _mean_width(
    shape: Shape, shares: Sequence[float], place: str, width: Callable[[Floats, float], float]
) -> Reading:
    """The mean width of the sections at some shares of the length."""
    widths = []
    for share in shares:
        section = shape.across(share)
        if shape.opened(section):
            return Reading(None, OPEN.format(place=place))
        widths.append(width(section.points, shape.length_mm))
    return Reading(float(np.mean(widths)))


def _lower_width(points: Floats, length_mm: float) -> float:
    """The extent across of what is not high over a section's lowest point."""
    low = points[:, 1] < points[:, 1].min() + WIDTHS.height * length_mm
    return float(np.ptp(points[low, 0]))


def _feather_width(points: Floats, length_mm: float) -> float:  # noqa: ARG001
    """Between the points of a section that lines of 45 degrees touch from below on either side."""
    across, up = points.T
    return float(across[np.argmax(across - up)] - across[np.argmin(across + up)])
