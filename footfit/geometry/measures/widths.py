"""Widths: of the ball, of the heel, of a last's bottom."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import OPEN, UNSCANNED, MeasureValue, no_ball
from footfit.geometry.mesh.outlines import OUTLINES, TAPE_OUTLINES, Outline, OutlineSettings


@dataclass(frozen=True, slots=True)
class WidthSettings:
    """Where widths are taken, over the length."""

    forefoot: tuple[float, float] = (0.50, 0.90)
    heel: float = 1.0 / 6.0
    ball: float = 0.66
    beside: tuple[float, ...] = (-0.015, 0.0, 0.015)  # sections that are averaged
    bottom_beside: tuple[float, ...] = (-0.03, -0.015, 0.0, 0.015, 0.03)
    feather_turn_deg: float = 15.0  # how far the line that touches the feather edge is turned
    height: float = 0.15  # over each section's lowest point; above it ankles may stand out


WIDTHS = WidthSettings()


def ball_width(shape: Shape) -> MeasureValue:
    """From MT1 to MT5 in plan (the oblique ball width)."""
    if shape.mt1 is None or shape.mt5 is None:
        return no_ball(shape)
    return MeasureValue(float(np.hypot(*(shape.mt1 - shape.mt5)[:2])))


def ball_width_orthogonal(shape: Shape) -> MeasureValue:
    """Between the two tangents along X at the forefoot (ISO 7250-1 foot breadth)."""
    medial, lateral = (shape.outermost(side, WIDTHS.forefoot) for side in (1.0, -1.0))
    if medial is None or lateral is None:
        return no_ball(shape)
    return MeasureValue(float(medial[1] - lateral[1]))


def heel_width(shape: Shape) -> MeasureValue:
    """Across the heel at one sixth of the length from the pternion."""
    return _mean_width(shape, [WIDTHS.heel + by for by in WIDTHS.beside], "heel", _lower_width)


def bottom_width_ball(shape: Shape) -> MeasureValue:
    """Across the bottom of a last at the ball, from feather edge to feather edge."""
    return _bottom_width(shape, WIDTHS.ball, "ball")


def bottom_width_heel(shape: Shape) -> MeasureValue:
    """Across the bottom of a last at one sixth of the length, from feather edge to feather edge."""
    return _bottom_width(shape, WIDTHS.heel, "heel")


def _bottom_width(shape: Shape, share: float, place: str) -> MeasureValue:
    shares = [share + by for by in WIDTHS.bottom_beside]
    return _mean_width(shape, shares, place, _feather_width, TAPE_OUTLINES)


def _mean_width(
    shape: Shape,
    shares: Sequence[float],
    place: str,
    width: Callable[[Outline, float], float],
    outlines: OutlineSettings = OUTLINES,
) -> MeasureValue:
    """The mean width of the sections at some shares of the length."""
    widths = []
    for share in shares:
        section = shape.across(share, outlines)
        below_mm = section.points[:, 1].min(initial=np.inf) + WIDTHS.height * shape.length_mm
        if shape.opened(section, below_mm):
            return MeasureValue(None, OPEN.format(place=place))
        if shape.unscanned(section, upright=True, below_mm=below_mm):
            return MeasureValue(None, UNSCANNED)
        widths.append(width(section, shape.length_mm))
    return MeasureValue(float(np.mean(widths)))


def _lower_width(section: Outline, length_mm: float) -> float:
    """The extent across of the part of a section that is low (``WidthSettings.height``)."""
    points = section.points
    low = points[:, 1] < points[:, 1].min() + WIDTHS.height * length_mm
    return float(np.ptp(points[low, 0]))


def _feather_width(section: Outline, _length_mm: float) -> float:
    """Between the two points of a section that lines of 45 degrees touch from below."""
    return _touched(section, 1.0) + _touched(section, -1.0)


def _touched(section: Outline, side: float) -> float:
    """How far across a section a line of 45 degrees touches it from below, on one side.

    A line with the normal n is at the distance h. As it turns, h changes by h' and n by n': it
    touches at h n + h' n'. Distances are steadier than the points of an edge.
    """
    angles = np.radians(45.0 + WIDTHS.feather_turn_deg * np.array([-1.0, 0.0, 1.0]))
    directions = np.stack([side * np.cos(angles), -np.sin(angles)])
    before, reach, after = (section.points @ directions).max(axis=0)
    change = (after - before) / (2.0 * np.sin(np.radians(WIDTHS.feather_turn_deg)))
    return float((reach - change) * np.sqrt(0.5))
