"""A floor plate that was scanned with the foot: found by its plane, and cut away."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import boundary_edges
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.planes import robust_plane


@dataclass(frozen=True, slots=True)
class PlateSettings:
    """Everything numeric of the plate; distances over the mesh's size."""

    rounds: int = 12
    scale: float = 0.01
    near: float = 0.015
    boundary_share: float = 0.60
    parallel: float = 0.95
    area_share: float = 0.10
    cut: float = 0.02
    beyond_share: float = 0.10  # of a plate that reaches beyond the foot; of a holed sole: none
    flat: float = 0.04  # thickness over length of a piece that is a plate by itself


PLATE = PlateSettings()


def without_plate(vertices: Floats, faces: Ints, settings: PlateSettings = PLATE) -> Bools:
    """Which faces are left, (m,) bool, when a floor plate is cut away; all where there is none.

    A plate is a plane on which most of an open mesh's boundary lies, which holds a good part of
    the area, and which reaches beyond the rest: the sole of a last with holes in it does not.
    Everything near the plane goes with it.
    """
    every = np.ones(len(faces), dtype=bool)
    rim = np.unique(boundary_edges(faces))
    if len(rim) < 3:
        return every
    size = float(np.ptp(vertices, axis=0).max())
    points = vertices[rim]
    plane = robust_plane(points, np.ones(len(rim)), settings.scale * size, settings.rounds)
    on_plane = np.abs(plane.heights(points)) < settings.near * size
    if on_plane.mean() < settings.boundary_share:
        return every
    vectors = area_vectors(vertices, faces)
    areas = np.linalg.norm(vectors, axis=1)
    away = np.abs(plane.heights(vertices))[faces].max(axis=1)
    flat = np.abs(vectors @ plane.normal) > settings.parallel * areas
    held = areas[flat & (away < settings.near * size)].sum()
    left = away >= settings.cut * size
    if held < settings.area_share * areas.sum() or not left.any():
        return every
    beyond = _beyond(vertices[faces].mean(axis=1), left, plane.normal)
    if areas[beyond].sum() < settings.beyond_share * areas[~left].sum():
        return every
    return np.asarray(left)


def is_flat(vertices: Floats, settings: PlateSettings = PLATE) -> bool:
    """Whether points (n, 3) of one piece are a plate by themselves: thin in one direction."""
    away = vertices - vertices.mean(axis=0)
    directions = np.linalg.eigh(away.T @ away)[1]
    extents = np.ptp(away @ directions, axis=0)
    return bool(extents[0] < settings.flat * extents[2])


def _beyond(middles: Floats, left: Bools, normal: Floats) -> Bools:
    """Which faces near the plane lie outside the box of what is left, seen along the normal."""
    across = np.linalg.svd(normal[None])[2][1:]
    plan = middles @ across.T
    centre = plan[left].mean(axis=0)
    plan = (plan - centre) @ np.linalg.eigh(np.cov(plan[left].T))[1]
    low, high = plan[left].min(axis=0), plan[left].max(axis=0)
    outside = ((plan < low) | (plan > high)).any(axis=1)
    return np.asarray(outside & ~left)
