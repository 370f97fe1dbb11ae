"""The room between a foot and the last around it: signed, by direction, in mm and cm2.

Both shapes are canonical right ones and the foot is docked (``docking.py``). + is room to spare,
- is where the foot would reach through the last's surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.nearest import at_rim, nearest_on_surface, outward_at
from footfit.geometry.mesh.surface import vertex_areas, vertex_normals
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.quantiles import area_quantile

ZONES = ("bottom", "medial", "lateral", "dorsal", "toe")


@dataclass(frozen=True, slots=True)
class ClearanceSettings:
    """What is compared and how it is summed up.

    Attributes
    ----------
    topline : ((share, share), ...)
        Height over the length at places along the length, straight in between: what lies higher is
        not in the shoe (back, under the ankles, at the throat). Ahead of the last place all is.
    toe_from : float
        Over the length: what lies ahead is toe, but for its bottom.
    facing_down, facing_up : float
        The Z part of a normal, from which on a place is bottom or dorsal.
    tight_mm, loose_mm : float
        An area counts as tight under the one and as loose over the other; a foot gives way by the
        first without pressing (the spread of a soft foot's scans).
    """

    topline: tuple[tuple[float, float], ...] = ((0.0, 0.22), (0.22, 0.19), (0.50, 0.30))
    toe_from: float = 0.85
    facing_down: float = 0.60
    facing_up: float = 0.60
    tight_mm: float = -2.0
    loose_mm: float = 8.0


CLEARANCE = ClearanceSettings()


@dataclass(frozen=True, slots=True)
class ZoneClearance:
    """The room in one zone: its area-weighted mean and 5 and 95 % quantiles, and how much of its
    area is tight or loose. The figures are None where nothing of the zone is compared.
    """

    zone: str
    mean_mm: float | None
    p05_mm: float | None
    p95_mm: float | None
    area_cm2: float
    tight_cm2: float
    loose_cm2: float


def signed_clearance(points: Floats, vertices: Floats, faces: Ints) -> Floats:
    """The room (p,) from points to a surface around them: + inside it, - outside.

    Parameters
    ----------
    points : (p, 3)
    vertices, faces : (n, 3), (m, 3)
        Wound outward.

    Returns
    -------
    (p,)
        NaN where the nearest part is an open rim, which has no inside.

    Examples
    --------
    A wall at x = 0 that looks towards +X:

    >>> wall = np.array([[0.0, -9, -9], [0, 9, -9], [0, 0, 9]])
    >>> signed_clearance(np.array([[-2.0, 0, 0], [3, 0, 0]]), wall, np.array([[0, 1, 2]])).tolist()
    [2.0, -3.0]
    """
    found = nearest_on_surface(points, vertices, faces)
    way = points - found.place
    outside = np.einsum("ij,ij->i", way, outward_at(found, vertices, faces)) > 0.0
    room = np.where(outside, -found.distance, found.distance)
    room[at_rim(found, faces, len(vertices))] = np.nan
    return room


def foot_clearance(foot: Shape, last: Shape, settings: ClearanceSettings = CLEARANCE) -> Floats:
    """The room (n,) at each vertex of a docked foot; NaN where the shoe does not reach.

    That is over the topline, at the foot's own lid (a cut leg), where the last's lid or open rim
    is nearest, and at vertices without a face.
    """
    compared = np.flatnonzero(in_shoe(foot, settings))
    points = foot.vertices_mm[compared]
    found = nearest_on_surface(points, last.vertices_mm, last.faces)
    way = points - found.place
    outward = outward_at(found, last.vertices_mm, last.faces)
    outside = np.einsum("ij,ij->i", way, outward) > 0.0
    room = np.where(outside, -found.distance, found.distance)
    room[last.lid[found.face] | at_rim(found, last.faces, len(last.vertices_mm))] = np.nan
    result = np.full(len(foot.vertices_mm), np.nan)
    result[compared] = room
    return result


def in_shoe(foot: Shape, settings: ClearanceSettings = CLEARANCE) -> Bools:
    """Which vertices (n,) lie under the topline and are no part of a cut leg's lid."""
    share, height = np.array(settings.topline).T
    at = (foot.vertices_mm[:, 0] - foot.x_mm(0.0)) / foot.length_mm
    limit = np.interp(at, share, height, right=np.inf) * foot.length_mm
    inside = foot.vertices_mm[:, 2] <= limit
    used = np.zeros(len(inside), dtype=bool)
    used[foot.faces[~foot.lid]] = True
    return np.asarray(inside & used)


def zone_of(foot: Shape, settings: ClearanceSettings = CLEARANCE) -> Ints:
    """The zone of each vertex (n,): its place in ``ZONES``.

    By where the surface looks: down is bottom, up is dorsal, else medial or lateral; of what
    lies ahead of ``toe_from`` all but the bottom is toe.
    """
    normals = vertex_normals(foot.vertices_mm, foot.faces)
    zone = np.where(normals[:, 1] > 0.0, ZONES.index("medial"), ZONES.index("lateral"))
    zone[normals[:, 2] > settings.facing_up] = ZONES.index("dorsal")
    zone[foot.vertices_mm[:, 0] > foot.x_mm(settings.toe_from)] = ZONES.index("toe")
    zone[normals[:, 2] < -settings.facing_down] = ZONES.index("bottom")
    return zone


def zone_clearances(
    foot: Shape, room_mm: Floats, settings: ClearanceSettings = CLEARANCE
) -> tuple[ZoneClearance, ...]:
    """The room of each zone, from the room (n,) at the foot's vertices."""
    zone, areas = zone_of(foot, settings), vertex_areas(foot.vertices_mm, foot.faces)
    known = np.isfinite(room_mm) & (areas > 0.0)
    return tuple(
        _zone_clearance(name, room_mm[chosen], areas[chosen], settings)
        for index, name in enumerate(ZONES)
        for chosen in (known & (zone == index),)
    )


def _zone_clearance(
    name: str, room_mm: Floats, areas_mm2: Floats, settings: ClearanceSettings
) -> ZoneClearance:
    if not len(room_mm):
        return ZoneClearance(name, None, None, None, 0.0, 0.0, 0.0)
    low, high = (area_quantile(room_mm, areas_mm2, share) for share in (0.05, 0.95))
    tight, loose = room_mm < settings.tight_mm, room_mm > settings.loose_mm
    return ZoneClearance(
        zone=name,
        mean_mm=float(room_mm @ areas_mm2 / areas_mm2.sum()),
        p05_mm=low,
        p95_mm=high,
        area_cm2=float(areas_mm2.sum()) / 100.0,
        tight_cm2=float(areas_mm2[tight].sum()) / 100.0,
        loose_cm2=float(areas_mm2[loose].sum()) / 100.0,
    )
