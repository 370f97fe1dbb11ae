"""The clearance between a foot and the last around it: signed, by direction, in mm and cm2.

Both shapes are canonical right ones, and the foot lies in the last (``placement.py``). + is space
to spare, - is where the foot would reach through the last's surface.
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
        not in the shoe (back, under the ankles, at the throat). In front of the last place
        everything is in the shoe.
    toe_from : float
        A share of the length: in front of it, everything but the sole counts as toe.
    facing_down, facing_up : float
        From this Z part of its normal on, a place is bottom or dorsal.
    tight_mm, loose_mm : float
        An area with less clearance than the first is tight, with more than the second loose. A foot
        yields by the first without pressure (the spread of a soft foot's scans).
    pressed_mm, pressed_cm2 : float
        More than this area with less clearance than this is worth a word, although the girths fit.
    worth_saying : float
        A zone is said to be tight, or loose, if more than this share of its area is.
    quantiles : (share, share)
        The low and the high quantile that stand for a zone's tightest and loosest places.
    """

    topline: tuple[tuple[float, float], ...] = ((0.0, 0.22), (0.22, 0.19), (0.50, 0.30))
    toe_from: float = 0.85
    facing_down: float = 0.60
    facing_up: float = 0.60
    tight_mm: float = -2.0
    loose_mm: float = 8.0
    pressed_mm: float = -5.0
    pressed_cm2: float = 20.0
    worth_saying: float = 0.10
    quantiles: tuple[float, float] = (0.05, 0.95)


CLEARANCE = ClearanceSettings()


@dataclass(frozen=True, slots=True)
class ZoneClearance:
    """The clearance in one zone: its area-weighted mean, its 5 and 95 % quantiles, and how much of
    the area is tight, loose or pressed. The figures are None if nothing of the zone is compared.
    """

    zone: str
    mean_mm: float | None
    p05_mm: float | None
    p95_mm: float | None
    area_cm2: float
    tight_cm2: float
    loose_cm2: float
    pressed_cm2: float = 0.0

    @property
    def is_tight(self) -> bool:
        """Is so much of it tight that it is worth a word?"""
        return self.p05_mm is not None and self.tight_cm2 > CLEARANCE.worth_saying * self.area_cm2


def signed_clearance(
    points: Floats, vertices: Floats, faces: Ints, open_faces: Bools | None = None
) -> Floats:
    """The clearance (p,) from points to a surface around them: + inside it, - outside.

    Parameters
    ----------
    points : (p, 3)
    vertices, faces : (n, 3), (m, 3)
        Wound outward.
    open_faces : (m,), optional
        Faces that close an opening, as a last's top does.

    Returns
    -------
    (p,)
        NaN where the nearest place is on an open rim, which has no inside, or on an open face.

    Examples
    --------
    A wall at x = 0 that looks towards +X:

    >>> wall = np.array([[0.0, -9, -9], [0, 9, -9], [0, 0, 9]])
    >>> signed_clearance(np.array([[-2.0, 0, 0], [3, 0, 0]]), wall, np.array([[0, 1, 2]])).tolist()
    [2.0, -3.0]
    """
    nearest = nearest_on_surface(points, vertices, faces)
    way = points - nearest.place
    outside = np.einsum("ij,ij->i", way, outward_at(nearest, vertices, faces)) > 0.0
    clearance = np.where(outside, -nearest.distance, nearest.distance)
    unknown = at_rim(nearest, faces, len(vertices))
    if open_faces is not None:
        unknown |= open_faces[nearest.face]
    clearance[unknown] = np.nan
    return clearance


def foot_clearance(foot: Shape, last: Shape) -> Floats:
    """The clearance (n,) at each vertex of a foot that lies in a last, mm.

    NaN where the shoe does not reach: over the topline, at the foot's own top cut, where the last's
    top or an open rim is nearest, and at vertices without a face that was scanned.
    """
    return clearance_at(foot, last, in_shoe(foot))


def clearance_at(shape: Shape, other: Shape, compared: Bools) -> Floats:
    """How deep each vertex (n,) of a shape lies in another one, mm; NaN where not ``compared``."""
    clearance_mm = np.full(len(shape.vertices_mm), np.nan)
    clearance_mm[compared] = signed_clearance(
        shape.vertices_mm[compared], other.vertices_mm, other.faces, other.top_cut
    )
    return clearance_mm


def in_shoe(foot: Shape) -> Bools:
    """Which vertices (n,) lie under the topline and are scanned, not part of a leg's top cut."""
    share, height = np.array(CLEARANCE.topline).T
    at = (foot.vertices_mm[:, 0] - foot.x_mm(0.0)) / foot.length_mm
    limit = np.interp(at, share, height, right=np.inf) * foot.length_mm
    inside = foot.vertices_mm[:, 2] <= limit
    used = np.zeros(len(inside), dtype=bool)
    used[foot.faces[~foot.top_cut & ~foot.filled]] = True
    return np.asarray(inside & used)


def zone_of(foot: Shape) -> Ints:
    """The zone of each vertex (n,): its place in ``ZONES``.

    By where the surface looks: down is bottom, up is dorsal, else medial or lateral. In front of
    ``toe_from`` everything but the bottom is toe.
    """
    normals = vertex_normals(foot.vertices_mm, foot.faces[~foot.filled])
    zone = np.where(normals[:, 1] > 0.0, ZONES.index("medial"), ZONES.index("lateral"))
    zone[normals[:, 2] > CLEARANCE.facing_up] = ZONES.index("dorsal")
    zone[foot.vertices_mm[:, 0] > foot.x_mm(CLEARANCE.toe_from)] = ZONES.index("toe")
    zone[normals[:, 2] < -CLEARANCE.facing_down] = ZONES.index("bottom")
    return zone


def zone_clearances(foot: Shape, clearance_mm: Floats) -> tuple[ZoneClearance, ...]:
    """The clearance of each zone, from the clearance (n,) at the foot's vertices."""
    scanned = foot.faces[~foot.filled]
    zone, areas = zone_of(foot), vertex_areas(foot.vertices_mm, scanned)
    known = np.isfinite(clearance_mm) & (areas > 0.0)
    return tuple(
        _zone_clearance(name, clearance_mm[chosen], areas[chosen])
        for index, name in enumerate(ZONES)
        for chosen in (known & (zone == index),)
    )


def _zone_clearance(name: str, clearance_mm: Floats, areas_mm2: Floats) -> ZoneClearance:
    if not len(clearance_mm):
        return ZoneClearance(name, None, None, None, 0.0, 0.0, 0.0)
    low, high = (area_quantile(clearance_mm, areas_mm2, share) for share in CLEARANCE.quantiles)
    tight, loose = clearance_mm < CLEARANCE.tight_mm, clearance_mm > CLEARANCE.loose_mm
    return ZoneClearance(
        zone=name,
        mean_mm=float(clearance_mm @ areas_mm2 / areas_mm2.sum()),
        p05_mm=low,
        p95_mm=high,
        area_cm2=float(areas_mm2.sum()) / 100.0,
        tight_cm2=float(areas_mm2[tight].sum()) / 100.0,
        loose_cm2=float(areas_mm2[loose].sum()) / 100.0,
        pressed_cm2=float(areas_mm2[clearance_mm < CLEARANCE.pressed_mm].sum()) / 100.0,
    )
