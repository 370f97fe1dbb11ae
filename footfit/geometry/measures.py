"""What is measured in millimetres on a canonical right shape: one function a measure, one table.

A new measure is a function and an entry of ``MEASURES``; its row in the catalogue, its key in the
JSON and its line in the report follow.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.bottom_shape import low_length
from footfit.geometry.sections import extremes_below, lowest, sections_across


@dataclass(frozen=True, slots=True)
class MeasureSettings:
    """Where measures are taken; heights and places over the length."""

    length_height: float = 0.30  # what lies higher is leg
    width_height: float = 0.15  # over each section's lowest point; over it ankles may stand out
    ball: tuple[float, float] = (0.50, 0.90)
    ball_sections: int = 61  # 2 mm apart: a tangent's error is under .02 mm
    heel: float = 1.0 / 6.0


SETTINGS = MeasureSettings()


class Reading(NamedTuple):
    """A measured value, or the reason why there is none."""

    value: float | None
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class Measure:
    """An entry of the table.

    ``reading(vertices_mm, faces)`` takes a canonical right shape; ``sd`` is the repeatability of
    the whole way from a scan (noise of 0.3 mm, decimation, any pose): benchmarks/flare.py.
    """

    name: str
    unit: str
    sd: float
    definition: str
    reading: Callable[[Floats, Ints], Reading]


def length(vertices_mm: Floats, faces: Ints) -> Reading:  # noqa: ARG001
    """From the pternion to the foremost point along X, of what is no leg.

    Examples
    --------
    >>> points = np.array([[0.0, 0, 0], [250, 0, 0], [-30, 0, 300]])
    >>> length(points, np.array([[0, 1, 2]])).value
    250.0
    """
    return Reading(low_length(vertices_mm, SETTINGS.length_height)[1])


def ball_width(vertices_mm: Floats, faces: Ints) -> Reading:
    """Between the two tangents along X at the ball (the orthogonal ball width)."""
    start, length_mm = low_length(vertices_mm, SETTINGS.length_height)
    share = np.linspace(*SETTINGS.ball, SETTINGS.ball_sections)
    least, most = _width_edges(vertices_mm, faces, start + share * length_mm, length_mm)
    known = np.isfinite(least)
    if known.mean() < 1.0:
        return Reading(None, "the scan has a gap at the ball")
    return Reading(float(most.max() - least.min()))


def heel_width(vertices_mm: Floats, faces: Ints) -> Reading:
    """Across the section at one sixth of the length from the pternion."""
    start, length_mm = low_length(vertices_mm, SETTINGS.length_height)
    at = np.array([start + SETTINGS.heel * length_mm])
    least, most = _width_edges(vertices_mm, faces, at, length_mm)
    if not np.isfinite(least[0]):
        return Reading(None, "the scan has a gap at the heel")
    return Reading(float(most[0] - least[0]))


def _width_edges(
    vertices_mm: Floats, faces: Ints, x_mm: Floats, length_mm: float
) -> tuple[Floats, Floats]:
    segments = sections_across(vertices_mm, faces, x_mm)
    across, height = segments.points[:, :, 1], segments.points[:, :, 2]
    floor = lowest(height, segments)
    band = SETTINGS.width_height * length_mm
    # Over a gap in the sole the lowest thing is a leg: no width.
    limit = np.where(floor <= band, floor + band, np.nan)
    return extremes_below(across, height, limit, segments)


MEASURES: tuple[Measure, ...] = (
    Measure(
        "length",
        "mm",
        0.35,
        "pternion to the foremost point along X, below 0.30 of the length",
        length,
    ),
    Measure(
        "ball_width",
        "mm",
        0.35,
        "between the tangents along X from 0.50 to 0.90 of the length, within 0.15 of the length "
        "over the sole (orthogonal)",
        ball_width,
    ),
    Measure(
        "heel_width",
        "mm",
        0.3,
        "across X at one sixth of the length from the pternion, within 0.15 of the length over "
        "the sole",
        heel_width,
    ),
)
