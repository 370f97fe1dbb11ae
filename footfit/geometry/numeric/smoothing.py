"""Linear smoothers of values along a line: local quadratic regression and uniform cubic splines.

Each smoother is a matrix that depends on the places of the values, not on the values. So an error
of the values passes through it exactly.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats


def local_quadratic(at: Floats, where: Floats, bandwidth: float) -> tuple[Floats, Floats]:
    """Value and slope of a local quadratic regression with Gaussian weights.

    Parameters
    ----------
    at : (k,)
        The places at which the smooth curve is wanted.
    where : (n,)
        The places of the values, n >= 3.
    bandwidth : float
        Standard deviation of the weights, in the unit of ``at``.

    Returns
    -------
    value, slope : (k, n)
        ``value @ y`` is the smooth curve, ``slope @ y`` its derivative.

    Examples
    --------
    A parabola stays a parabola:

    >>> where = np.linspace(0, 1, 9)
    >>> value, slope = local_quadratic(np.array([0.5]), where, 0.1)
    >>> round(float((value @ where**2)[0]), 12), round(float((slope @ where**2)[0]), 12)
    (0.25, 1.0)
    """
    offset = (where[None, :] - at[:, None]) / bandwidth
    weight = np.exp(-0.5 * offset**2)
    basis = np.stack([np.ones_like(offset), offset, offset**2])  # (3, k, n)
    normal = np.einsum("akn,kn,bkn->kab", basis, weight, basis)
    rows = np.linalg.solve(normal, np.moveaxis(basis * weight, 0, 1))  # (k, 3, n)
    return rows[:, 0], rows[:, 1] / bandwidth


def cubic_splines(at: Floats, count: int) -> tuple[Floats, Floats, Floats]:
    """A uniform cubic B-spline basis over [0, 1], with its derivatives.

    Parameters
    ----------
    at : (k,)
        In [0, 1]; outside, the end pieces are continued.
    count : int
        The number of basis functions, >= 4. They have count - 3 pieces of equal length.

    Returns
    -------
    value, slope, bend : (k, count)
        The functions and their first and second derivatives.

    Examples
    --------
    They sum to one:

    >>> value, slope, bend = cubic_splines(np.linspace(0, 1, 7), 8)
    >>> bool(np.allclose(value.sum(axis=1), 1)), bool(np.allclose(slope.sum(axis=1), 0))
    (True, True)
    """
    pieces = count - 3
    scaled = np.asarray(at, dtype=np.float64) * pieces
    piece = np.clip(np.floor(scaled), 0, pieces - 1).astype(np.int64)
    u = (scaled - piece)[:, None]
    rest = 1 - u
    value = np.hstack([rest**3, 4 - 6 * u**2 + 3 * u**3, 4 - 6 * rest**2 + 3 * rest**3, u**3])
    slope = np.hstack([-(rest**2), 3 * u**2 - 4 * u, 4 * rest - 3 * rest**2, u**2])
    bend = np.hstack([rest, 3 * u - 2, 3 * rest - 2, u])
    columns = piece[:, None] + np.arange(4)
    spread = []
    for table, scale in ((value / 6, 1.0), (slope / 2, pieces), (bend, pieces**2)):
        full = np.zeros((len(scaled), count))
        np.put_along_axis(full, columns, table * scale, axis=1)
        spread.append(full)
    return spread[0], spread[1], spread[2]
