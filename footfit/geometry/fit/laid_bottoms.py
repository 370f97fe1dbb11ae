"""One last laid on another: bottom to bottom, so that what differs above the bottom can be seen.

Only the bottom and the lowest part of the walls count. Both lasts are right shapes. They start as
they stand, heel at heel. Then the distances from the second bottom to the first are made small:
point to plane, with Tukey's weights, so that a place where the two differ does not move the rest.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.nearest import at_rim, nearest_on_surface, part_middles
from footfit.geometry.mesh.surface import area_vectors, face_normals
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct, row_dots
from footfit.geometry.numeric.rotations import rotations_about


@dataclass(frozen=True, slots=True)
class BottomSettings:
    """What of a last is laid on the other, and how; places and heights over the bottom's arc.

    Attributes
    ----------
    high : float
        Higher parts over the bottom do not count.
    facing_down : float
        The cosine from which on a face is of the bottom.
    heel_to : float
        Walls up to here count in every direction: they hold the heel at the heel.
    walls_to, sideways : float
        In front of that, walls up to here count that look sideways: they hold the direction. The
        toe's front does not count, since a longer last is laid heel on heel.
    spacing_mm, points : float, int
        The samples of the second bottom: the parts of a face are so large, about, and of all
        samples so many are taken.
    reach_mm : tuple of float
        Tukey's weights are 0 from here on, narrower round by round.
    rounds, settled_mm : int, float
        Of each reach, until a step moves the bottom by less.
    same_mm : float
        Bottoms that lie so close are one surface: then the way along is found by them too, and not
        by the heel alone.
    cosine : float
        The two surfaces must look the same way at a pair.
    least : float
        With a smaller share of the samples near the first bottom the two do not lie together.
    """

    high: float = 0.06
    facing_down: float = 0.6
    heel_to: float = 0.35
    walls_to: float = 0.85
    sideways: float = 0.8
    spacing_mm: float = 4.0
    points: int = 2_000
    reach_mm: tuple[float, ...] = (12.0, 6.0, 3.0)
    rounds: int = 12
    settled_mm: float = 1e-3
    same_mm: float = 0.05
    cosine: float = 0.5
    least: float = 0.1


LAID = BottomSettings()


@dataclass(frozen=True, slots=True)
class LaidBottom:
    """How the second last lies on the first.

    Attributes
    ----------
    transform : (4, 4)
        From the second's canonical frame to the first's; it turns and shifts, and never scales.
    rms_mm : float
        The weighted root mean square of the distances that are left between the bottoms.
    share : float
        How much of the second's bottom lies within the last reach of the first's.
    """

    transform: Floats
    rms_mm: float
    share: float


def laid_bottom(first: Shape, second: Shape, settings: BottomSettings = LAID) -> LaidBottom:
    """Lay the bottom of a last on that of another one."""
    faces = first.faces[_counts(first, settings)]
    points, areas = _samples(second, settings)
    laid = LaidBottom(_start(first, second), float("inf"), 0.0)
    for reach_mm in (*settings.reach_mm, settings.reach_mm[-1]):
        free = laid.rms_mm < settings.same_mm
        for _ in range(settings.rounds):
            pairs = _Pairs.at(first.vertices_mm, faces, points, laid.transform, settings.cosine)
            weight = areas * pairs.sound * _tukey(pairs.distance_mm, reach_mm)
            near = areas @ (pairs.sound & (np.abs(pairs.distance_mm) < reach_mm))
            share = float(near / areas.sum())
            if share < settings.least:
                return replace(laid, share=share)
            rms_mm = float(np.sqrt(weight @ pairs.distance_mm**2 / weight.sum()))
            step = pairs.step(weight, free=free)
            laid = LaidBottom(step @ laid.transform, rms_mm, share)
            moved = np.abs(pairs.places @ (step[:3, :3] - np.eye(3)).T + step[:3, 3])
            if moved.max() < settings.settled_mm:
                break
    return laid


def _start(first: Shape, second: Shape) -> Floats:
    """The second in the first's frame as both stand, the rearmost places together."""
    here, there = first.standing_transform, second.standing_transform
    if here is None or there is None:
        return np.eye(4)
    return np.linalg.inv(here) @ there


def _counts(shape: Shape, settings: BottomSettings) -> Bools:
    """Which faces (m,) are laid on each other."""
    normals = face_normals(shape.vertices_mm, shape.faces)
    middles = shape.vertices_mm[shape.faces].mean(axis=1)
    if shape.bottom_arc is None:
        along = (middles[:, 0] - shape.x_mm(0.0)) / shape.length_mm
        over = middles[:, 2] / shape.length_mm
    else:
        along, over = shape.bottom_arc.shares(middles)
    down = normals @ shape.upright < -settings.facing_down
    beside = (along < settings.walls_to) & (np.abs(normals[:, 1]) > settings.sideways)
    counted = down | (along < settings.heel_to) | beside
    return np.asarray((over < settings.high) & counted & ~shape.top_cut)


def _samples(shape: Shape, settings: BottomSettings) -> tuple[Floats, Floats]:
    """Points (k, 3) of what counts of a shape, and the area (k,) that each stands for.

    A face gives the middles of its parts. Of these every so manyth is taken, so that no mesh costs
    more than another; its area is that of all.
    """
    faces = shape.faces[_counts(shape, settings)]
    area = 0.5 * np.linalg.norm(area_vectors(shape.vertices_mm, faces), axis=1)
    splits = np.clip(np.ceil(np.sqrt(2.0 * area) / settings.spacing_mm), 1, 8).astype(np.int64)
    points, areas = [], []
    for split in distinct(splits).tolist():
        chosen = splits == split
        corners = shape.vertices_mm[faces[chosen]]
        points.append((part_middles(split) @ corners).reshape(-1, 3))
        areas.append(np.repeat(area[chosen] / split**2, split**2))
    all_points, all_areas = np.concatenate(points), np.concatenate(areas)
    stride = 1 + len(all_points) // settings.points
    return all_points[::stride], all_areas[::stride]


def _tukey(distance_mm: Floats, reach_mm: float) -> Floats:
    """Tukey's biweight."""
    return np.asarray((1.0 - np.minimum((distance_mm / reach_mm) ** 2, 1.0)) ** 2)


@dataclass(frozen=True, slots=True)
class _Pairs:
    """Moved points ``places`` (k, 3), the nearest faces' ``normals`` (k, 3), the distances (k,)
    along these, and which pairs are ``sound`` (k,).
    """

    places: Floats
    normals: Floats
    distance_mm: Floats
    sound: Bools

    @classmethod
    def at(
        cls, vertices: Floats, faces: Ints, points: Floats, pose: Floats, cosine: float
    ) -> _Pairs:
        places = points @ pose[:3, :3].T + pose[:3, 3]
        nearest = nearest_on_surface(places, vertices, faces)
        normals = face_normals(vertices, faces)[nearest.face]
        away = places - nearest.place
        distance_mm = row_dots(away, normals)
        straight = np.abs(distance_mm) >= cosine * nearest.distance - 1e-9
        return cls(places, normals, distance_mm, straight & ~at_rim(nearest, faces, len(vertices)))

    def step(self, weight: Floats, *, free: bool) -> Floats:
        """The small motion (4, 4) that makes the weighted distances least; along X if ``free``."""
        middle = weight @ self.places / weight.sum()
        turns = np.cross(self.places - middle, self.normals)
        rows = np.column_stack([turns, self.normals * [float(free), 1.0, 1.0]])
        scaled = rows * np.sqrt(weight)[:, None]
        target = -self.distance_mm * np.sqrt(weight)
        solved = np.linalg.lstsq(scaled, target, rcond=1e-10)[0]
        motion = np.eye(4)
        motion[:3, :3] = rotations_about(solved[None, :3])[0]
        motion[:3, 3] = middle - motion[:3, :3] @ middle + solved[3:]
        return motion
