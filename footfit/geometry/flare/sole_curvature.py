"""The sole's mean curvature along the centre line: III.C, pooled over a stretch of sole.

Twice the mean curvature is the divergence of the surface's normal. It is averaged with a smooth
weight that is 0 at the edges of the stretch. The divergence theorem moves the derivative from the
noisy normals to the weight: the average is a sum of the faces' area vectors times the weight's
gradient. So noise cancels, no neighbourhood is searched, and a subdivided facet gives the same.
One ring of concentrated curvatures, or normals that are fitted over a radius and then averaged,
cost ten times as much for the same station means (docs/decisions/0031).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.bottom_curves import extended_stations, smooth_curvature
from footfit.geometry.flare.centre_line import CentreLine
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.levelled_bottom import BottomShape
from footfit.geometry.mesh.samples import short_triangles
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.quantiles import median
from footfit.geometry.numeric.smoothing import local_quadratic


def surface_curvature_profile(
    shape: BottomShape, line: CentreLine, side: Floats, definition: FlareDefinition
) -> Floats | None:
    """Area-weighted mean curvature of the sole's surface times length, (stations,); convex is +.

    To lay the bottom flat took the bend of the side line ``side`` (k, 2) away: half of it is added
    again, since the mean curvature is the mean of the two principal ones.

    Returns
    -------
    (stations,) or None
        None if less than ``found_least`` of the stations have a sole: a surface in the band that
        looks down.
    """
    points, vectors = _sole(shape, line, definition)
    if len(points) == 0:
        return None
    weight = _window(points, line, definition)
    grid = np.linspace(*definition.table[:2], definition.surface_bins)
    columns = np.column_stack(
        [
            weight.value[:, None] * vectors,
            weight.value * vectors[:, 0] * weight.station_slope,
            weight.along * vectors[:, 0] + weight.across * vectors[:, 1],
        ]
    )
    binned = _binned(weight.station, columns, grid)
    mean = _station_means(binned, grid, line.arc_length, definition)
    if mean is None:
        return None
    known = np.isfinite(line.bands.x)
    bend = smooth_curvature(line, side, known, definition.surface_bandwidth, definition)
    return mean + 0.5 * bend


def _station_means(
    binned: Floats, grid: Floats, arc_length: float, definition: FlareDefinition
) -> Floats | None:
    at = extended_stations(definition)[1:-1]
    offset = (grid[None, :] - at[:, None]) / definition.surface_bandwidth
    kernel = np.exp(-0.5 * offset**2)
    normal = kernel @ binned[:, :3]
    floor_area = -normal[:, 2]  # seen from below
    seen = floor_area > definition.surface_least * median(floor_area)
    if floor_area.max() <= 0.0 or seen.mean() < definition.found_least:
        return None
    cosine = np.ones(len(at))
    cosine[seen] = floor_area[seen] / np.linalg.norm(normal[seen], axis=1)
    slope = -offset * kernel / definition.surface_bandwidth
    bend = -0.5 * cosine * (slope @ binned[:, 3] + kernel @ binned[:, 4])
    mean = bend[seen] * cosine[seen] / floor_area[seen] * arc_length
    return np.asarray(np.interp(at, at[seen], mean), dtype=np.float64)


def _sole(
    shape: BottomShape, line: CentreLine, definition: FlareDefinition
) -> tuple[Floats, Floats]:
    """Centres and area vectors, (k, 3) each, of the band's facets that look down."""
    down = area_vectors(shape.vertices, shape.faces)[:, 2] < 0.0
    whole = shape.vertices[shape.faces[down]]
    corners, _, _ = short_triangles(whole, definition.surface_piece, definition.surface_halvings)
    points = corners.mean(axis=1)
    known = np.isfinite(line.bands.floor)
    ceiling = np.interp(points[:, 0], line.bands.x[known], line.bands.floor[known])
    low = points[:, 2] <= ceiling + definition.band_height
    corners = corners[low]
    flat = np.arange(3 * len(corners)).reshape(-1, 3)
    return points[low], area_vectors(corners.reshape(-1, 3), flat)


@dataclass(frozen=True, slots=True)
class _Window:
    """The part of the weight that is the same for all stations, at k points.

    ``value`` is 1 on the line and 0 at the stretch's edges and the foot's ends, ``along`` and
    ``across`` its slopes by x and y; ``station`` with its slope by x.
    """

    value: Floats
    along: Floats
    across: Floats
    station: Floats
    station_slope: Floats


def _window(points: Floats, line: CentreLine, definition: FlareDefinition) -> _Window:
    x = points[:, 0]
    known = np.isfinite(line.bands.half_width)
    bandwidth = definition.surface_width_bandwidth
    smooth, slope = local_quadratic(line.bands.x, line.bands.x[known], bandwidth)
    half, half_slope = (
        np.interp(x, line.bands.x, rows @ line.bands.half_width[known]) for rows in (smooth, slope)
    )
    reach = definition.surface_width * np.maximum(half, 1e-6)
    aside = (points[:, 1] - np.interp(x, line.x, line.y)) / reach
    inward = np.maximum(1.0 - aside**2, 0.0)
    station = line.station_at(x)
    step = line.x[1] - line.x[0]
    station_slope = np.interp(x, line.x, np.gradient(line.station, step))
    fade, fade_slope = _fading(station, *definition.surface_ends)
    across = -4.0 * inward * aside / reach * fade
    turned = np.interp(x, line.x, line.slope) + aside * definition.surface_width * half_slope
    along = fade_slope * station_slope * inward**2 - across * turned
    return _Window(inward**2 * fade, along, across, station, station_slope)


def _fading(station: Floats, start: float, end: float) -> tuple[Floats, Floats]:
    """A smooth rise from 0 to 1 at the heel, the same fall at the toe, and the slope."""
    at_heel = station < 0.5
    inward = np.where(at_heel, station, 1.0 - station)
    t = np.clip((inward - start) / (end - start), 0.0, 1.0)
    slope = 6.0 * t * (1.0 - t) / (end - start)
    return t**2 * (3.0 - 2.0 * t), np.where(at_heel, slope, -slope)


def _binned(where: Floats, amounts: Floats, grid: Floats) -> Floats:
    """Amounts (k, c), divided between the two nearest points of an even grid, (g, c)."""
    place = np.clip((where - grid[0]) / (grid[1] - grid[0]), 0.0, len(grid) - 1.001)
    left = place.astype(np.int64)
    share = place - left
    columns = [
        np.bincount(left, column * (1.0 - share), len(grid))
        + np.bincount(left + 1, column * share, len(grid))
        for column in amounts.T
    ]
    return np.asarray(np.column_stack(columns), dtype=np.float64)
