"""The underside seen from the side: where the arch is, how the middle runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.sections import sections_across, soles
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.smoothing import local_quadratic


@dataclass(frozen=True, slots=True)
class BottomSettings:
    """Where the underside is read, over the length; ``places`` over the width, 0 lateral."""

    step: float = 0.015  # from section to section
    band: float = 0.10  # over the section's lowest point: the places are shares of its width
    reach: float = 0.30  # higher faces are not underside
    bandwidth: float = 0.03
    tape_bandwidth: float = 0.018  # of a tape, which lies over a crisp break at the tread
    gap_rise: float = 0.01  # a section so much higher than those before and after is in a gap
    whole: tuple[float, float] = (0.04, 0.96)
    arch: tuple[float, float] = (0.28, 0.62)
    arch_places: tuple[float, ...] = (0.70, 0.75, 0.80)
    middle_places: tuple[float, ...] = (0.35, 0.50, 0.65)


BOTTOM = BottomSettings()


@dataclass(frozen=True, slots=True)
class Underside:
    """The height of the underside ``z_mm`` (k,) at ``x_mm`` (k,)."""

    x_mm: Floats
    z_mm: Floats

    def smooth(self, spread_mm: float) -> Underside:
        """The same curve, smoothed by local parabolas with weights that fall over ``spread_mm``."""
        return Underside(self.x_mm, local_quadratic(self.x_mm, self.x_mm, spread_mm)[0] @ self.z_mm)

    def line(self) -> tuple[float, float]:
        """Slope and height at x = 0 of the straight line along it."""
        slope, height = np.polyfit(self.x_mm, self.z_mm, 1)
        return float(slope), float(height)


def underside(
    shape: Shape, window: tuple[float, float], places: tuple[float, ...]
) -> Underside | None:
    """The underside's mean height (mm) at some shares of the width.

    Parameters
    ----------
    shape : Shape
    window : (2,)
        From where to where, over the length.
    places : (p,)
        Shares of the width, 0 lateral and 1 medial.

    Returns
    -------
    Underside or None
        None if a section has no surface that looks down at one of the places. A gap of up to two
        sections, as an open hinge has, is bridged.
    """
    count = 1 + round((window[1] - window[0]) / BOTTOM.step)
    x = shape.x_mm(0.0) + np.linspace(*window, count) * shape.length_mm
    faces = shape.under(BOTTOM.reach)
    segments = sections_across(shape.vertices_mm, faces, x)
    down = area_vectors(shape.vertices_mm, faces[segments.face])[:, 2] < 0.0
    bottom = soles(segments, BOTTOM.band * shape.length_mm, places, down)
    if not np.all(bottom.depth <= bottom.limit):
        return None
    bridged = [_over_gaps(heights, BOTTOM.gap_rise * shape.length_mm) for heights in bottom.depth]
    return Underside(x, np.mean(bridged, axis=0))


def _over_gaps(heights: Floats, rise: float) -> Floats:
    """Heights (k,) without those in a gap: higher than the least of two on either side by ``rise``.

    Examples
    --------
    >>> _over_gaps(np.array([3.0, 2, 9, 8, 2, 1, 0]), 2.0).tolist()
    [3.0, 2.0, 2.0, 2.0, 2.0, 1.0, 0.0]
    """
    padded = np.pad(heights, 2, constant_values=np.inf)
    before = np.minimum(padded[:-4], padded[1:-3])
    after = np.minimum(padded[3:-1], padded[4:])
    sound = heights <= np.maximum(before, after) + rise
    places = np.arange(len(heights))
    return np.interp(places, places[sound], heights[sound])
