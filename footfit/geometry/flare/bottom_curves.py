"""The bottom's longitudinal curves, read along the centre line."""

from __future__ import annotations

import numpy as np

from footfit.geometry.flare.centre_line import CentreLine
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.mesh.sections import depth_at
from footfit.geometry.numeric.arrays import Bools, Floats
from footfit.geometry.numeric.polylines import curvature_density
from footfit.geometry.numeric.smoothing import local_quadratic


def bottom_curvature(
    line: CentreLine, down: Bools, place: float, side: Floats, definition: FlareDefinition
) -> Floats | None:
    """Curvature times length of one longitudinal curve of the bottom, (stations,).

    The curve is the depth of each section at ``place`` of its width from the medial side; + is
    convex, as at the ball of a foot. The depths stand on the side line along which the bottom was
    laid flat: the bend of the shank is part of the curve.

    Parameters
    ----------
    line : CentreLine
    down : (m,)
        Which segments of the line's bands are of faces that look down.
    place : float
    side : (k, 2)
        The side line below each of the line's bands, over the length.
    definition : FlareDefinition

    Returns
    -------
    (stations,) or None
        None if less than ``found_least`` of the sections have a bottom there: a surface that looks
        down.
    """
    bands = line.bands
    where = (1.0 - 2.0 * place) * bands.half_width + bands.offset
    depth = depth_at(where, bands.across, bands.height, bands.segments, down)
    near = depth <= bands.floor + definition.band_height
    if near.mean() < definition.found_least:
        return None
    curve = side + np.column_stack([np.zeros_like(depth), depth])
    return smooth_curvature(line, curve, near, definition.bottom_bandwidth, definition)


def smooth_curvature(
    line: CentreLine, curve: Floats, known: Bools, bandwidth: float, definition: FlareDefinition
) -> Floats:
    """Curvature times length, (stations,), of a curve (k, 2) that has a point for each band."""
    at = extended_stations(definition)
    value, _ = local_quadratic(at, line.station_at(line.bands.x)[known], bandwidth)
    smooth = value @ curve[known]
    return np.asarray(curvature_density(smooth)[1:-1] * line.arc_length, dtype=np.float64)


def extended_stations(definition: FlareDefinition) -> Floats:
    """The fixed stations with one more at either end: a curvature needs two neighbours."""
    step = (definition.stations_to - definition.stations_from) / (definition.stations - 1)
    return np.linspace(
        definition.stations_from - step, definition.stations_to + step, definition.stations + 2
    )
