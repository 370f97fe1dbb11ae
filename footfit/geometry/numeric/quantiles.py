"""Quantiles of values, and of values that stand for areas of different size."""

from __future__ import annotations

import math

import numpy as np

from footfit.geometry.numeric.arrays import Floats


def median(values: Floats) -> float:
    """The middle of some values, or the mean of the two in the middle; NaN of none.

    Unlike ``np.median`` it does not load ``numpy.ma``.

    Examples
    --------
    >>> median(np.array([[3.0, 1.0], [4.0, 2.0]]))
    2.5
    """
    if not values.size:
        return math.nan
    middle = values.size // 2
    first = middle - 1 + values.size % 2
    ordered = np.partition(values, (first, middle), axis=None)
    return 0.5 * (float(ordered[first]) + float(ordered[middle]))


def quantile(values: Floats, share: float) -> float:
    """The value below which ``share`` of the values (n,) lie, linear between values.

    It is that of ``np.quantile``, which takes fifteen times as long for a hundred values and loads
    ``numpy.ma``.

    Examples
    --------
    >>> quantile(np.array([3.0, 1.0, 2.0]), 0.75)
    2.5
    """
    ordered = np.sort(values)
    place = share * (len(ordered) - 1)
    before = int(place)
    low, high = float(ordered[before]), float(ordered[min(before + 1, len(ordered) - 1)])
    part = place - before
    return low + (high - low) * part if part < 0.5 else high - (high - low) * (1.0 - part)


def area_quantile(values: Floats, areas: Floats, share: float) -> float:
    """The value below which ``share`` of the area lies, linear between values.

    Parameters
    ----------
    values, areas : (n,)
    share : float
        0 to 1.

    Raises
    ------
    ValueError
        There are no values.

    Examples
    --------
    >>> area_quantile(np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 2.0]), 0.5)
    2.0
    """
    if len(values) == 0:
        raise ValueError("a quantile needs at least one value")
    order = np.argsort(values)
    weights = areas[order]
    middles = np.cumsum(weights) - 0.5 * weights
    return float(np.interp(share * weights.sum(), middles, values[order]))
