"""The step of a file's coordinates: decimals were cut off, or float32 lies far from the origin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.errors import TooCoarse
from footfit.geometry.numeric.arrays import Floats, distinct
from footfit.geometry.numeric.quantiles import median
from footfit.results.values import Notice


@dataclass(frozen=True, slots=True)
class ResolutionSettings:
    """How a step is found, and what it means.

    Attributes
    ----------
    sample, fewest : int
        The step is looked for in about so many vertices; a mesh of fewer is a drawn shape.
    rounding : float
        How far apart float32 may put equal numbers, over the largest of them.
    off_step : float
        How far a difference may be from a whole number of steps, in steps.
    alike : float
        The steps of the three axes differ by at most this factor. An axis alone may have even
        stations because a shape was made so.
    far : float
        An axis counts alone if its coordinates are so many times as large as its extent.
    said_mm, coarsest_mm : float
        From the first on a notice says the step; a coarser one than the second is refused.
    """

    sample: int = 4096
    fewest: int = 200
    rounding: float = 2.4e-7
    off_step: float = 0.1
    alike: float = 4.0
    far: float = 100.0
    said_mm: float = 0.3
    coarsest_mm: float = 3.0


RESOLUTION = ResolutionSettings()


def coordinate_step(vertices: Floats) -> float:
    """The step that all coordinates are whole numbers of, in the file's unit; 0 for none.

    Parameters
    ----------
    vertices : (n, 3) float64
        As the file has them.

    Examples
    --------
    >>> points = np.random.default_rng(1).normal(size=(2000, 3))
    >>> coordinate_step(points), coordinate_step(points.round(1))
    (0.0, 0.1)
    """
    if len(vertices) < RESOLUTION.fewest:
        return 0.0
    sample = vertices[:: max(1, len(vertices) // RESOLUTION.sample)].T
    steps = np.array([_step(axis) for axis in sample])
    extents, sizes = np.ptp(sample, axis=1), np.abs(sample).max(axis=1)
    together = steps.min() > 0.0 and steps.max() <= RESOLUTION.alike * steps.min()
    counts = together | (sizes > RESOLUTION.far * extents)
    return float(f"{steps[counts].max(initial=0.0):.6g}")


def _step(values: Floats) -> float:
    """The step between the values (n,) of an axis; 0 if their differences have none in common."""
    gaps = np.diff(distinct(values))
    size = float(np.abs(values).max())
    for least in (0.0, RESOLUTION.rounding * size):  # exact numbers first, then rounded ones
        wide = gaps[gaps > least]
        if not len(wide):
            return 0.0
        step = median(wide[wide < 1.5 * wide.min()])
        off = np.abs(wide / step - np.round(wide / step))
        if off.max() < RESOLUTION.off_step:
            return step
    return 0.0


def check_resolution(resolution_mm: float) -> None:
    """Refuse a file that is too coarse to be measured.

    Raises
    ------
    TooCoarse
        The step is over ``RESOLUTION.coarsest_mm``.
    """
    if resolution_mm > RESOLUTION.coarsest_mm:
        raise TooCoarse(
            f"the file keeps its coordinates in steps of {resolution_mm:.3g} mm, and footfit needs"
            f" {RESOLUTION.coarsest_mm:.0f} mm or finer: {_TO_DO}"
        )


def resolution_notices(resolution_mm: float) -> tuple[Notice, ...]:
    """What to say of the step in which a file keeps its coordinates, if it is coarse."""
    if resolution_mm < RESOLUTION.said_mm:
        return ()
    words = f"the file keeps its coordinates in steps of {resolution_mm:.2g} mm: {_TO_DO}"
    return (Notice("coarse_file", words),)


_TO_DO = "export it with more decimals, with the shape near the origin"
