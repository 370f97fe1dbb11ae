"""Quantiles of values that stand for areas of different size."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats


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
