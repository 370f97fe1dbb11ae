"""The plane a shape stands on: its sole plane, or the rim of one that has no sole.

Points are in an approximate canonical pose: x heel to toe, z up, the ground near z = 0; mm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.samples import SurfaceSample
from footfit.geometry.numeric.arrays import Bools, Floats
from footfit.geometry.numeric.planes import LEVEL, Plane, PlanePoints, robust_plane
from footfit.geometry.numeric.quantiles import median


@dataclass(frozen=True, slots=True)
class FloorSettings:
    """Everything numeric of the sole plane; lengths over L."""

    tau_first: float = 0.06
    tau_last: float = 0.02
    narrowing_steps: int = 12
    final_steps: int = 15
    still: float = 1e-7
    weightless: float = 6.2  # widths from the plane a point weighs less than 1e-16
    reach: float = 0.25  # a point that is higher cannot be sole
    support_height: float = 0.06
    rim_stations: int = 14
    rim_share: float = 0.02
    rim_rounds: int = 9
    rim_scale: float = 0.01


FLOOR = FloorSettings()


def sole_plane(sample: SurfaceSample, length: float, start: Plane = LEVEL) -> Plane:
    """The plane of the sole by iterated reweighting from ``start``, the weight's width narrowing.

    A point weighs its area, times how near the plane it is, times how squarely it faces down.
    If nothing faces the plane, it is ``start``.
    """
    heights = start.heights(sample.points)
    near = (np.abs(heights) < FLOOR.reach * length) & (sample.normals @ start.normal < 0)
    points, areas = PlanePoints(sample.points[near]), sample.areas[near]
    normals = np.asfortranarray(sample.normals[near])  # the steps read column after column
    narrowing = np.geomspace(FLOOR.tau_first, FLOOR.tau_last, FLOOR.narrowing_steps)
    widths = np.append(narrowing, np.full(FLOOR.final_steps, FLOOR.tau_last)) * length
    plane = start
    for step, width in enumerate(widths):
        if step == FLOOR.narrowing_steps:
            close = np.abs(points.heights(plane)) < FLOOR.weightless * width
            points, areas = PlanePoints(sample.points[near][close]), areas[close]
            normals = np.asfortranarray(normals[close])
        weights = points.heights(plane)  # in place: these steps are a good part of an alignment
        weights /= width
        np.negative(np.square(weights, out=weights), out=weights)
        np.exp(weights, out=weights)
        weights *= areas
        weights *= squareness(normals, plane.normal)
        if np.count_nonzero(weights) < 3:
            return start
        before, plane = plane, points.plane(weights, plane.normal)
        if width == widths[-1] and _unmoved(before, plane, FLOOR.still, length):
            break
    return plane


def squareness(normals: Floats, up: Floats) -> Floats:
    """How squarely normals (n, 3) look down: the cosine's fourth power, 0 for one that looks up."""
    up_cosine = normals @ up
    down = np.minimum(up_cosine, 0.0, out=up_cosine)
    np.square(down, out=down)
    return np.square(down, out=down)


def _unmoved(before: Plane, after: Plane, still: float, length: float) -> bool:
    """Whether the plane is at rest, so that further steps would change nothing."""
    tilt = float(np.abs(before.normal - after.normal).max())
    return tilt < still and abs(before.offset - after.offset) < still * length


def support(sample: SurfaceSample, plane: Plane, length: float) -> float:
    """The area facing down at the plane, over L squared: .11-.24 with a sole, <= .07 without."""
    down = squareness(sample.normals, plane.normal)
    near = np.abs(plane.heights(sample.points)) < FLOOR.support_height * length
    return float((sample.areas * down)[near].sum() / length**2)


def rim_plane(sample: SurfaceSample, length: float) -> Plane:
    """The plane of the lowest rim, for a shape without a sole.

    The lowest points in stations along x, on either side, are averaged; the plane through them
    is fitted with Cauchy weights, so that a gap or a spike does not tilt it. A leg that stands over
    the heel's back is no rim.
    """
    low = sample.points[:, 2] < sample.points[:, 2].min() + FLOOR.reach * length
    x, y = sample.points[:, 0], sample.points[:, 1]
    station = np.clip(
        ((x - x.min()) / length * FLOOR.rim_stations).astype(int), 0, FLOOR.rim_stations - 1
    )
    side = y > median(y)
    rim = [
        _lowest_mean(sample, (station == s) & (side == half), FLOOR.rim_share)
        for s in range(FLOOR.rim_stations)
        for half in (False, True)
        if np.any(low & (station == s) & (side == half))
    ]
    scale = FLOOR.rim_scale * length
    return robust_plane(np.array(rim), np.ones(len(rim)), scale, FLOOR.rim_rounds)


def _lowest_mean(sample: SurfaceSample, chosen: Bools, share: float) -> Floats:
    points = sample.points[chosen]
    count = max(1, int(share * len(points)))
    lowest = np.argpartition(points[:, 2], count - 1)[:count]
    return np.asarray(points[lowest].mean(axis=0))
