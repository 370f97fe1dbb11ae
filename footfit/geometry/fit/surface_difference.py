"""How far the surfaces of two lasts lie apart that are laid on each other, and where most."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.clearance import ZONES, clearance_at, zone_of
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.surface import vertex_areas
from footfit.geometry.numeric.arrays import Bools, Floats
from footfit.geometry.numeric.quantiles import area_quantile

MOST_SHARE = 0.95
"""So much of the area differs by no more than ``p95_mm``."""


@dataclass(frozen=True, slots=True)
class ZoneDifference:
    """The second last minus the first in one zone, + where the second is larger.

    ``mean_mm`` is weighted by the area, ``p05_mm`` and ``p95_mm`` are its quantiles. All are None
    if nothing of the zone is compared.
    """

    zone: str
    mean_mm: float | None
    p05_mm: float | None
    p95_mm: float | None
    area_cm2: float


@dataclass(frozen=True, slots=True)
class LargestDifference:
    """The place where the two differ most: ``point_mm`` (3,) in the first last's canonical right
    frame, its zone, and where it is along the bottom's arc.
    """

    value_mm: float
    point_mm: tuple[float, float, float]
    zone: str
    station: float


@dataclass(frozen=True, slots=True)
class SurfaceDifference:
    """The difference of two surfaces, both ways: at the vertices of both.

    ``at_first_mm`` (n,) is that at the first's vertices, NaN at the top and where the other's top
    or an open rim is nearest. ``p95_mm`` is of the size without its sign.
    """

    at_first_mm: Floats
    mean_mm: float | None
    p95_mm: float | None
    largest: LargestDifference | None
    zones: tuple[ZoneDifference, ...]


def surface_difference(first: Shape, second: Shape) -> SurfaceDifference:
    """How the surface of a last differs from that of another one in whose frame it is."""
    here = clearance_at(first, second, _walls(first))
    there = -clearance_at(second, first, _walls(second))
    values = np.concatenate([here, there])
    areas = np.concatenate([vertex_areas(s.vertices_mm, s.faces) for s in (first, second)])
    zone = np.concatenate([zone_of(first), zone_of(second)])
    known = np.isfinite(values) & (areas > 0.0)
    zones = tuple(
        _zone_difference(name, values[known & (zone == index)], areas[known & (zone == index)])
        for index, name in enumerate(ZONES)
    )
    if not known.any():
        return SurfaceDifference(here, None, None, None, zones)
    most = int(np.nanargmax(np.where(known, np.abs(values), np.nan)))
    place = np.concatenate([first.vertices_mm, second.vertices_mm])[most]
    return SurfaceDifference(
        at_first_mm=here,
        mean_mm=float(values[known] @ areas[known] / areas[known].sum()),
        p95_mm=area_quantile(np.abs(values[known]), areas[known], MOST_SHARE),
        largest=LargestDifference(
            value_mm=float(values[most]),
            point_mm=(float(place[0]), float(place[1]), float(place[2])),
            zone=ZONES[int(zone[most])],
            station=first.share_of(place),
        ),
        zones=zones,
    )


def _walls(shape: Shape) -> Bools:
    """Which vertices (n,) have a face that is not of the top."""
    used = np.zeros(len(shape.vertices_mm), dtype=bool)
    used[shape.faces[~shape.top_cut]] = True
    return used


def _zone_difference(name: str, values: Floats, areas: Floats) -> ZoneDifference:
    if not len(values):
        return ZoneDifference(name, None, None, None, 0.0)
    low, high = (area_quantile(values, areas, share) for share in (1.0 - MOST_SHARE, MOST_SHARE))
    area_cm2 = float(areas.sum()) / 200.0  # both surfaces are in it
    return ZoneDifference(name, float(values @ areas / areas.sum()), low, high, area_cm2)
