"""The lower band of sections: where its two edges are, and how deep its bottom lies."""

from __future__ import annotations

import numpy as np

from footfit.geometry.mesh.sections import Segments, extremes_below
from footfit.geometry.numeric.arrays import Floats


def band_edges(
    across: Floats, height: Floats, limit: Floats, segments: Segments, depth: float
) -> tuple[Floats, Floats]:
    """The two edges of each section's part under a limit, less noisy than its extremes.

    An edge is the mean of ``across`` along the section's curve, weighted by how far outside it
    lies: 1 at the extreme, 0 from ``depth`` inwards. The integral is exact, so that an edge does
    not depend on how the curve is cut into segments. With noise of 0.3 mm it scatters two thirds
    as much as the extreme itself does.

    Parameters
    ----------
    across, height : (m, 2)
        Coordinates in the plane of the segments' two ends.
    limit : (planes,)
        The height at which each section is cut off.
    segments : Segments
    depth : float
        In the unit of ``across``; 0 gives the extremes.

    Returns
    -------
    least, most : (planes,)
        NaN where nothing is low enough.
    """
    extremes = extremes_below(across, height, limit, segments)
    if depth <= 0.0:
        return extremes
    level = limit[segments.plane]
    low = _share_under(height, level)
    least, most = (
        _outer_mean(across, height, sign * extreme, segments, sign, depth, low)
        for sign, extreme in zip((-1.0, 1.0), extremes, strict=True)
    )
    return least, most


def _share_under(values: Floats, level: Floats) -> tuple[Floats, Floats]:
    """The part of each segment, as start and end in [0, 1], where ``values`` (m, 2) <= ``level``.

    Start is not less than end where there is none.
    """
    rise = values[:, 1] - values[:, 0]
    crossing = (level - values[:, 0]) / np.where(rise == 0.0, 1.0, rise)
    flat_out = (rise == 0.0) & (values[:, 0] > level)
    start = np.where(rise < 0.0, np.clip(crossing, 0.0, 1.0), 0.0)
    end = np.where(rise > 0.0, np.clip(crossing, 0.0, 1.0), 1.0)
    return np.where(flat_out, 1.0, start), end


def _outer_mean(
    across: Floats,
    height: Floats,
    extreme: Floats,
    segments: Segments,
    sign: float,
    depth: float,
    low: tuple[Floats, Floats],
) -> Floats:
    outside = (sign * across - extreme[segments.plane][:, None]) / depth + 1.0  # 1 at the extreme
    near = np.flatnonzero(np.maximum(outside[:, 0], outside[:, 1]) > 0.0)
    outside, across = outside[near], across[near]
    begin, stop = _share_under(-outside, np.zeros(len(near)))
    begin, stop = np.maximum(begin, low[0][near]), np.minimum(stop, low[1][near])
    span = np.hypot(across[:, 1] - across[:, 0], np.diff(height[near], axis=1)[:, 0])
    span *= np.maximum(stop - begin, 0.0)
    weight = [outside[:, 0] + t * (outside[:, 1] - outside[:, 0]) for t in (begin, stop)]
    place = [across[:, 0] + t * (across[:, 1] - across[:, 0]) for t in (begin, stop)]
    # Along a segment the weight and the place are linear: both integrals are exact.
    mass = span * (weight[0] + weight[1]) / 2.0
    moment = (
        span
        / 6.0
        * (
            2.0 * (weight[0] * place[0] + weight[1] * place[1])
            + weight[0] * place[1]
            + weight[1] * place[0]
        )
    )
    plane = segments.plane[near]
    total = np.bincount(plane, mass, segments.planes)
    first = np.bincount(plane, moment, segments.planes)
    mean = first / np.where(total > 0.0, total, 1.0)
    return np.asarray(np.where(total > 0.0, mean, sign * extreme), dtype=np.float64)
