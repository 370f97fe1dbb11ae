"""Concentrated curvature of polygonal curves (the paper's III.B).

``points`` is (n, 2) or (n, 3) float64 in any unit. In the plane curvature has a sign: + turns left
(counter-clockwise). In space it is unsigned.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.angles import angle_between, turning_angle
from footfit.geometry.numeric.arrays import Floats


def arc_length(points: Floats) -> Floats:
    """The length along the curve up to each point, (n,); the first is 0.

    Examples
    --------
    >>> arc_length(np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 6.0]])).tolist()
    [0.0, 5.0, 7.0]
    """
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate([np.zeros(1), np.cumsum(steps)])


def concentrated_curvature(points: Floats, closed: bool = False) -> Floats:
    """The angle pi - gamma by which the curve turns at each point, (n,) radians.

    gamma is the angle at p between the two neighbours a and b. The arc of any circle that touches
    both legs turns by the same pi - gamma, whatever its radius (Eq. 12). The printed step
    "1/2 2 r theta" is a misprint: the arc is r (2 theta), and 2 theta = pi - gamma.

    Parameters
    ----------
    points : (n, 2) or (n, 3) float64
    closed : bool
        Join the last point to the first. Otherwise both ends are NaN, since they have no gamma.

    Returns
    -------
    (n,) float64
        Signed in the plane, in [0, pi] in space. On a closed plane curve that does not cross
        itself they sum to 2 pi.

    Raises
    ------
    ValueError
        Fewer than 3 points.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> (concentrated_curvature(square, closed=True) / np.pi).tolist()
    [0.5, 0.5, 0.5, 0.5]
    """
    arriving, leaving = _legs(points, closed)
    turn = turning_angle if points.shape[1] == 2 else angle_between
    turned = turn(arriving, leaving)  # Eq. 12: pi - gamma, with Eq. 13 by atan2
    return turned if closed else np.concatenate([[np.nan], turned, [np.nan]])


def curvature_density(points: Floats, closed: bool = False) -> Floats:
    """Concentrated curvature over the mean of the two edges that meet, (n,) in 1/length.

    A concentrated curvature is an angle, which shrinks with the edges. Its density is the same for
    two polylines of one curve. NaN where both edges have no length.

    Raises
    ------
    ValueError
        Fewer than 3 points.

    Examples
    --------
    >>> turn = 2 * np.pi * np.arange(360) / 360
    >>> circle = 5.0 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    >>> round(float(curvature_density(circle, closed=True)[0]), 4)
    0.2
    """
    arriving, leaving = _legs(points, closed)
    edge = 0.5 * (np.linalg.norm(arriving, axis=1) + np.linalg.norm(leaving, axis=1))
    edge = edge if closed else np.concatenate([[np.nan], edge, [np.nan]])
    density: Floats = concentrated_curvature(points, closed) / np.where(edge > 0.0, edge, np.nan)
    return density


def _legs(points: Floats, closed: bool) -> tuple[Floats, Floats]:
    """The vectors that arrive at and leave each inner point (each point where closed)."""
    if len(points) < 3:
        raise ValueError("curvature needs a polyline of 3 points or more")
    if closed:
        return points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
    steps = np.diff(points, axis=0)
    return steps[:-1], steps[1:]
