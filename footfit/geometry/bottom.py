"""The bottom's longitudinal curves and its surface, read along the centre line."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.centre_line import BottomShape, CentreLine, projected
from footfit.geometry.flare_definition import FlareDefinition
from footfit.geometry.polylines import curvature_density
from footfit.geometry.sections import depth_at
from footfit.geometry.smoothing import local_quadratic
from footfit.geometry.surface import area_vectors

Curvature = Callable[[Floats, Ints, float, Ints], Floats]


def bottom_curvature(
    shape: BottomShape, line: CentreLine, place: float, definition: FlareDefinition
) -> Floats | None:
    """Curvature times length of one longitudinal curve of the bottom, (stations,).

    The curve is the depth of each section at ``place`` of its width from the medial side; + is
    convex, as on a ball of the foot. The line from seat to ball is taken out, so that a heel's
    pitch does not shrink what the curve bends.

    Returns
    -------
    (stations,) or None
        None where less than ``found_least`` of the sections have a bottom there: a surface
        that looks down.
    """
    bands = line.bands
    where = (1.0 - 2.0 * place) * bands.half_width + bands.offset
    down = _looks_down(shape, bands.segments.face)
    depth, _ = depth_at(where, bands.across, bands.height, bands.segments, down)
    near = depth <= bands.floor + definition.band_height
    if near.mean() < definition.found_least:
        return None
    station = line.station_at(bands.x)[near]
    at = extended_stations(definition)
    value, _ = local_quadratic(at, station, definition.bottom_bandwidth)
    smooth = value @ depth[near]
    seat, ball = definition.chord
    low, high = np.interp([seat, ball], at, smooth)
    level = smooth - low - (high - low) * (at - seat) / (ball - seat)
    curve = np.column_stack([at * line.arc_length, level])
    return np.asarray(curvature_density(curve)[1:-1] * line.arc_length, dtype=np.float64)


def surface_curvature_profile(
    shape: BottomShape, line: CentreLine, pooled: Curvature, definition: FlareDefinition
) -> Floats | None:
    """Mean curvature of the sole's surface times length, (stations,); the paper's III.C.

    Parameters
    ----------
    shape : BottomShape
    line : CentreLine
    pooled : callable
        ``pooled(vertices, faces, radius, subset)``: the mean curvature at the vertices of
        ``subset`` (k,), in 1/length.
    definition : FlareDefinition

    Returns
    -------
    (stations,) or None
        The area-weighted mean over what looks down in the middle ``surface_width`` of the band.
        None where stations of the whole length have no such surface.
    """
    weight = _sole_weights(shape, definition)
    subset = np.flatnonzero(weight > 0.0)
    if len(subset) == 0:
        return None
    x, aside = _line_coordinates(shape.vertices[subset], line)
    half = np.interp(x, line.bands.x, _filled(line.bands.half_width))
    floor = np.interp(x, line.bands.x, _filled(line.bands.floor))
    keep = np.abs(aside) <= definition.surface_width * half
    keep &= shape.vertices[subset, 2] <= floor + definition.band_height
    subset, x = subset[keep], x[keep]
    if len(subset) == 0:
        return None
    curvature = pooled(shape.vertices, shape.faces, definition.surface_radius, subset)
    known = np.isfinite(curvature)
    values = curvature[known] * line.arc_length
    return _kernel_mean(line.station_at(x[known]), values, weight[subset][known], definition)


def extended_stations(definition: FlareDefinition) -> Floats:
    """The fixed stations with one more at either end: a curvature needs two neighbours."""
    step = (definition.stations_to - definition.stations_from) / (definition.stations - 1)
    return np.linspace(
        definition.stations_from - step, definition.stations_to + step, definition.stations + 2
    )


def _looks_down(shape: BottomShape, face: Ints) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    vectors = area_vectors(shape.vertices, shape.faces)
    return np.asarray(vectors[face, 2] < 0.0)


def _sole_weights(shape: BottomShape, definition: FlareDefinition) -> Floats:
    """The area of sole at each vertex, (n,): a third of each face that looks down enough."""
    vectors = area_vectors(shape.vertices, shape.faces)
    area = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    sole = np.where(-vectors[:, 2] >= definition.surface_down * area, area / 3.0, 0.0)
    return np.bincount(
        shape.faces.ravel(), np.repeat(sole, 3), minlength=len(shape.vertices)
    ).astype(np.float64)


def _line_coordinates(points: Floats, line: CentreLine) -> tuple[Floats, Floats]:
    """Where along x each point's normal section meets the line, and how far aside it lies."""
    bend = np.gradient(line.slope, line.x)
    x = projected(points, (line.y, line.slope, bend))
    y, slope = np.interp(x, line.x, line.y), np.interp(x, line.x, line.slope)
    return x, (points[:, 1] - y) * np.hypot(1.0, slope)


def _filled(values: Floats) -> Floats:
    known = np.isfinite(values)
    index = np.arange(len(values))
    return np.asarray(np.interp(index, index[known], values[known]), dtype=np.float64)


def _kernel_mean(
    station: Floats, values: Floats, weight: Floats, definition: FlareDefinition
) -> Floats | None:
    at = extended_stations(definition)[1:-1]
    offset = (station[None, :] - at[:, None]) / definition.surface_bandwidth
    kernel = weight * np.exp(-0.5 * offset**2)
    mass = kernel.sum(axis=1)
    reached = mass > 1e-3 * mass.max(initial=0.0)
    if reached.mean() < definition.found_least:
        return None
    mean = kernel @ values / np.where(mass > 0.0, mass, 1.0)
    return np.asarray(np.interp(at, at[reached], mean[reached]), dtype=np.float64)
