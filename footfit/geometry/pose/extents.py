"""How long, wide and thick a set of points is, whichever way it lies."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats


def principal_extents(points: Floats) -> tuple[Floats, Floats]:
    """Extents along the points' own principal axes, and those axes.

    Parameters
    ----------
    points : (n, 3) float64
        At least one point, any unit.

    Returns
    -------
    extents : (3,) float64
        Descending, in the points' unit.
    axes : (3, 3) float64
        Unit rows in the same order; a sign means nothing.

    Examples
    --------
    >>> box = np.array([[x, y, z] for x in (0.0, 9) for y in (0.0, 4) for z in (0.0, 1)])
    >>> principal_extents(box)[0].round(9).tolist()
    [9.0, 4.0, 1.0]
    """
    centred = points - points.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1].T
    extents = np.ptp(centred @ axes.T, axis=0)
    order = np.argsort(-extents, kind="stable")
    return extents[order], axes[order]
