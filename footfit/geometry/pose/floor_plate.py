"""A floor plate that was scanned with the foot: a piece of its own, or grown to the foot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import boundary_edges
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct
from footfit.geometry.numeric.planes import robust_plane
from footfit.geometry.pose.extents import principal_extents


@dataclass(frozen=True, slots=True)
class PlateSettings:
    """Everything numeric of a floor plate; distances over the mesh's size, if nothing else is said.

    The first part is about plates that are a piece of their own, in a surface of any kind.
    """

    thickness: float = 0.025  # over its longest extent: a plate is thinner
    foot_thickness: float = 0.12  # and what stands on it is thicker
    cover: float = (
        0.80  # of the foot on it: a plate reaches this far both ways, a leg's lid does not
    )
    side: float = 0.95  # of the foot's vertices lie on one side of the plate
    sinking: float = 0.01  # of its extent: a vertex that has sunk in less counts, soles are noisy
    least_share: float = 0.10  # of the largest piece's area: a smaller piece is no plate
    most_pieces: int = 16  # a scan with more pieces of this area is no foot on a plate
    flat: float = 0.04  # thickness over length: beside a foot, a thinner piece is no part of it
    rounds: int = 12  # of the plane through the boundary of a foot with a plate grown to it
    scale: float = 0.01
    near: float = 0.015  # so near this plane lie
    boundary_share: float = 0.60  # so much of the boundary
    area_share: float = 0.10  # and so much of the area,
    parallel: float = 0.95  # which faces the plane by this cosine
    beyond_share: float = 0.10  # of a plate reaches beyond the foot; of a sole with holes: none
    cut: float = 0.02  # what lies nearer to the plane goes with the plate


PLATE = PlateSettings()


def plate_pieces(vertices: Floats, faces: Ints, labels: Ints, areas: Floats) -> Bools:
    """Which pieces are a flat plate that the largest thick piece stands on, (k,).

    ``labels`` (m,) is the piece of each face, ``areas`` (k,) are the pieces' areas.
    """
    plates = np.zeros(len(areas), dtype=bool)
    big = np.flatnonzero(areas >= PLATE.least_share * areas.max())
    points = {
        piece: vertices[distinct(faces[labels == piece])] for piece in big[: PLATE.most_pieces]
    }
    shapes = {piece: principal_extents(found) for piece, found in points.items()}
    thickness = {piece: _thickness(extents) for piece, (extents, _) in shapes.items()}
    thick = [piece for piece in thickness if thickness[piece] > PLATE.foot_thickness]
    if not thick:
        return plates
    foot = points[max(thick, key=lambda piece: float(areas[piece]))]
    for piece, (_, axes) in shapes.items():
        if thickness[piece] < PLATE.thickness:
            plates[piece] = _carries(points[piece], axes, foot)
    return plates


def _carries(plate: Floats, axes: Floats, foot: Floats) -> bool:
    """Whether the foot stands on one side of the plate and within its reach."""
    centre = plate.mean(axis=0)
    on_plate, above = (plate - centre) @ axes.T, (foot - centre) @ axes.T
    covered = np.ptp(on_plate[:, :2], axis=0) >= PLATE.cover * np.ptp(above[:, :2], axis=0)
    sunk = PLATE.sinking * np.ptp(on_plate[:, 0])
    side = max(np.mean(above[:, 2] > -sunk), np.mean(above[:, 2] < sunk))
    return bool(covered.all() and side >= PLATE.side)


def without_plate(vertices: Floats, faces: Ints) -> Bools:
    """Which faces are left, (m,) bool, when a floor plate is cut away; all where there is none.

    A plate is a plane on which most of an open mesh's boundary lies, which holds a good part of
    the area, and which reaches beyond the rest: the sole of a last with holes in it does not.
    Everything near the plane goes with it.
    """
    every = np.ones(len(faces), dtype=bool)
    rim = distinct(boundary_edges(faces))
    if len(rim) < 3:
        return every
    size = float(np.ptp(vertices, axis=0).max())
    points = vertices[rim]
    plane = robust_plane(points, np.ones(len(rim)), PLATE.scale * size, PLATE.rounds)
    on_plane = np.abs(plane.heights(points)) < PLATE.near * size
    if on_plane.mean() < PLATE.boundary_share:
        return every
    vectors = area_vectors(vertices, faces)
    areas = np.linalg.norm(vectors, axis=1)
    away = np.abs(plane.heights(vertices))[faces].max(axis=1)
    flat = np.abs(vectors @ plane.normal) > PLATE.parallel * areas
    held = areas[flat & (away < PLATE.near * size)].sum()
    left = away >= PLATE.cut * size
    if held < PLATE.area_share * areas.sum() or not left.any():
        return every
    beyond = _beyond(vertices[faces].mean(axis=1), left, plane.normal)
    if areas[beyond].sum() < PLATE.beyond_share * areas[~left].sum():
        return every
    return np.asarray(left)


def is_flat(points: Floats) -> bool:
    """Whether points (n, 3) of one piece are a plate by themselves: thin in one direction."""
    return _thickness(principal_extents(points)[0]) < PLATE.flat


def _thickness(extents: Floats) -> float:
    return float(extents[2] / extents[0])


def _beyond(middles: Floats, left: Bools, normal: Floats) -> Bools:
    """Which faces near the plane lie outside the box of what is left, seen along the normal."""
    across = np.linalg.svd(normal[None])[2][1:]
    plan = middles @ across.T
    centre = plan[left].mean(axis=0)
    plan = (plan - centre) @ np.linalg.eigh(np.cov(plan[left].T))[1]
    low, high = plan[left].min(axis=0), plan[left].max(axis=0)
    outside = ((plan < low) | (plan > high)).any(axis=1)
    return np.asarray(outside & ~left)
