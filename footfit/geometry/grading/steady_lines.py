"""What of a last's chart a step back finds again: the plan's middle, and the cone's top.

Both are read from exact sections. What is read from the vertices, or the faces, that lie in a strip
jumps when one of them changes its strip. Then a step back moves a place by something else.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.deform.chart import Chart, eased
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.top_cut import standing_top
from footfit.geometry.mesh.sections import (
    Planes,
    extremes_below,
    plane_sections,
    sections_across,
)
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import face_components
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.planes import Plane, robust_plane
from footfit.geometry.numeric.smoothing import local_quadratic


@dataclass(frozen=True, slots=True)
class SteadySettings:
    """How the cone's top is read, and how far a held one reaches.

    The plane of the top starts from the faces of the top cut, in ``start_rounds`` with Cauchy
    weights of the width ``flat`` over the arc's length. Then it is fitted to what lies less than
    ``near_mm`` over or under it, in at most ``rounds``.

    A top that is held reaches ``rim_mm`` under its plane, which is more. Its hold ends ``deep``
    under that, and over the stretch ``fade`` in front of its front edge: both over the length of
    the top, which does not change.
    """

    flat: float = 0.004
    near_mm: float = 4.0
    start_rounds: int = 12
    rounds: int = 200
    settled_mm: float = 1e-9
    rim_mm: float = 5.0
    deep: float = 0.5
    fade: tuple[float, float] = (0.07, 0.7)


STEADY = SteadySettings()


@dataclass(frozen=True, slots=True)
class ConeTop:
    """The plane of a cone's top: its slopes (2,) along x and y, and its height over a middle (2,).

    ``face`` (3,) has the corners of a face that lies in it.
    """

    slope: Floats
    middle_mm: Floats
    height_mm: float
    face: Ints

    def over_mm(self, points_mm: Floats) -> Floats:
        """How high points (n, 3) lie straight over the plane, (n,)."""
        flat = (points_mm[:, :2] - self.middle_mm) @ self.slope
        return np.asarray(points_mm[:, 2] - self.height_mm - flat)

    def plane(self, under_mm: float) -> Plane:
        """The plane that lies lower by so much."""
        normal = np.array([*-self.slope, 1.0]) / np.sqrt(1.0 + self.slope @ self.slope)
        offset = (self.height_mm - self.slope @ self.middle_mm - under_mm) * normal[2]
        return Plane(normal, float(offset))


def middle_mm(chart: Chart, shape: Shape) -> Floats:
    """The middle of the plan across, at the chart's stations, (k,).

    It is half-way between the two extremes of each section's lower part, smoothed along the arc.
    """
    settings = chart.settings
    share = (np.arange(settings.cells) + 0.5) / settings.cells
    x_mm, z_mm = chart.arc.line.at(share * chart.arc.length_mm)
    cut = sections_across(chart.standing(shape.vertices_mm), shape.faces, x_mm)
    limit_mm = z_mm + settings.wall * chart.arc.length_mm
    least, most = extremes_below(cut.points[:, :, 1], cut.points[:, :, 2], limit_mm, cut)
    known = np.isfinite(least)
    value = local_quadratic(chart.stations, share[known], settings.smooth)[0]
    return np.asarray(value @ (0.5 * (least + most)[known]))


def cone_top_mm(chart: Chart, top: ConeTop) -> Floats:
    """How high the cone's top lies over the bottom, at the chart's stations, (k,).

    Its plane is drawn on over the whole last, along the middle of the top.
    """
    x_mm, z_mm = chart.arc.line.at(chart.stations * chart.arc.length_mm)
    return np.asarray(top.height_mm + top.slope[0] * (x_mm - top.middle_mm[0]) - z_mm)


def with_top_held(chart: Chart, shape: Shape, top: ConeTop) -> Chart:
    """The chart that holds the cone's top, with its outline."""
    length_mm, standing = chart.arc.length_mm, chart.standing(shape.vertices_mm)
    plane = top.plane(STEADY.rim_mm)
    over_mm = plane.heights(standing)
    level = Planes(np.zeros(1), plane.offset * plane.normal[None], plane.normal[None])
    cut = plane_sections(standing, shape.faces, over_mm, level)
    on_top = np.zeros(len(standing), dtype=bool)
    on_top[_connected(shape.faces, over_mm > 0.0, top.face)] = True
    outline_mm = cut.points[on_top[shape.faces[cut.face]].any(axis=1)].reshape(-1, 3)
    front = outline_mm[outline_mm[:, 0].argmax()]
    top_mm = float(np.ptp(outline_mm[:, 0]))
    start, end = (share * top_mm / length_mm for share in STEADY.fade)
    return replace(
        chart,
        top=plane,
        front=float(chart.arc.line.unrolled(front[None])[0, 0] / length_mm),
        deep_mm=STEADY.deep * top_mm,
        settings=replace(chart.settings, fade=(start, end)),
    )


def free_of_top(chart: Chart, points_mm: Floats) -> Floats:
    """How free of a held top points (n, 3) of the standing frame are, (n,): 0 on it, 1 far away.

    The chart says it by the bottom's arc. Here it is said by places that stay when the bottom
    becomes longer.
    """
    if chart.top is None:
        return np.ones(len(points_mm))
    length_mm = chart.arc.length_mm
    front_mm = chart.arc.line.at(np.array([chart.front * length_mm]))[0]
    start_mm, end_mm = (share * length_mm for share in chart.settings.fade)
    fade = eased((points_mm[:, 0] - front_mm - start_mm) / (end_mm - start_mm))
    return 1.0 - (1.0 - eased(-chart.top.heights(points_mm) / chart.deep_mm)) * (1.0 - fade)


def cone_top(chart: Chart, shape: Shape) -> ConeTop | None:
    """The plane of the cone's top, fitted to what a held top keeps; None if nothing there is flat.

    A face counts by its area in the plan and by how near its three corners are to the plane. So the
    plane is the same one after the top moved rigidly, or became longer, wider and higher.
    """
    standing, faces = chart.standing(shape.vertices_mm), shape.faces
    lid = standing_top(standing, faces)
    if not len(lid):
        return None
    start, face = _lid_plane(chart, standing, lid)
    own = _connected(faces, start.heights(standing) > -2.0 * STEADY.rim_mm, face)
    corners = standing[own]
    middles = corners.mean(axis=1)
    areas = np.maximum(area_vectors(standing, own)[:, 2], 0.0)
    slope, height_mm = -start.normal[:2] / start.normal[2], start.offset / start.normal[2]
    top = ConeTop(slope, np.zeros(2), float(height_mm), face)
    for _ in range(STEADY.rounds):
        off = np.array([top.over_mm(corner) for corner in corners.transpose(1, 0, 2)])
        near = np.maximum(1.0 - (off / STEADY.near_mm) ** 2, 0.0) ** 2
        weight = areas * near.prod(axis=0)
        middle_mm = weight @ middles[:, :2] / weight.sum()
        basis = np.column_stack([middles[:, :2] - middle_mm, np.ones(len(middles))])
        plane = np.linalg.solve((weight * basis.T) @ basis, (weight * basis.T) @ middles[:, 2])
        before, top = top, ConeTop(plane[:2], middle_mm, float(plane[2]), face)
        if np.abs(before.over_mm(middles) - top.over_mm(middles)).max() < STEADY.settled_mm:
            break
    return top


def _lid_plane(chart: Chart, standing: Floats, lid: Ints) -> tuple[Plane, Ints]:
    """Roughly the plane of the top cut's faces (m, 3), and the corners (3,) of one in it."""
    middles, vectors = standing[lid].mean(axis=1), area_vectors(standing, lid)
    areas = np.linalg.norm(vectors, axis=1)
    normal = vectors.sum(axis=0) / np.linalg.norm(vectors.sum(axis=0))
    start = Plane(normal, float(areas @ (middles @ normal) / areas.sum()))
    flat_mm = STEADY.flat * chart.arc.length_mm
    plane = robust_plane(middles, areas, flat_mm, STEADY.start_rounds, start)
    return plane, lid[np.abs(plane.heights(middles)).argmin()]


def _connected(faces: Ints, high: Bools, face: Ints) -> Ints:
    """The faces whose corners are all high, and that are connected with one of them."""
    above = faces[high[faces].all(axis=1)]
    labels = face_components(above, len(high))
    own = labels[(above == face).all(axis=1)]
    return above[np.isin(labels, own)]
