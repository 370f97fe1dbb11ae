"""What of a last's chart a step back finds again: the plan's middle, and the cone's top.

Both are read from exact sections. What is read from the vertices, or the faces, that lie in a strip
jumps when one of them changes its strip. Then a step back moves a place by something else.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.deform.chart import Chart, eased
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.sections import (
    Planes,
    extremes_below,
    highest,
    plane_sections,
    sections_across,
)
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.planes import Plane
from footfit.geometry.numeric.smoothing import local_quadratic


@dataclass(frozen=True, slots=True)
class SteadySettings:
    """Where the cone's top is read, as shares of the arc, and how its line is fitted.

    ``cone`` has ``places`` of it from end to end. The line has Cauchy weights of the width
    ``flat``, over the arc's length, and ``rounds`` of them. A top that is held reaches ``rim_mm``
    under its line. Its hold ends ``deep`` under that, and over the stretch ``fade`` in front of its
    front edge: both over the length of the top, which does not change.
    """

    cone: tuple[float, float] = (0.10, 0.28)
    places: int = 19
    flat: float = 0.004
    rounds: int = 25
    rim_mm: float = 5.0
    deep: float = 0.5
    fade: tuple[float, float] = (0.07, 0.7)


STEADY = SteadySettings()


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


def cone_top_mm(chart: Chart, shape: Shape) -> Floats:
    """How high the cone's top lies over the bottom, at the chart's stations, (k,).

    It is drawn on over the whole last.
    """
    slope, start_mm = _top_line(chart, shape)
    x_mm, z_mm = chart.arc.line.at(chart.stations * chart.arc.length_mm)
    return np.asarray(slope * x_mm + start_mm - z_mm)


def with_top_held(chart: Chart, shape: Shape) -> Chart:
    """The chart that holds the cone's top, with its outline."""
    length_mm, standing = chart.arc.length_mm, chart.standing(shape.vertices_mm)
    slope, start_mm = _top_line(chart, shape)
    normal = np.array([-slope, 0.0, 1.0]) / np.hypot(slope, 1.0)
    top = Plane(normal, float(start_mm * normal[2] - STEADY.rim_mm))
    level = Planes(np.array([top.offset]), top.offset * normal[None], normal[None])
    outline = plane_sections(standing, shape.faces, standing @ normal, level).points.reshape(-1, 3)
    front = outline[outline[:, 0].argmax()]
    top_mm = float(np.ptp(outline[:, 0]))
    start, end = (share * top_mm / length_mm for share in STEADY.fade)
    return replace(
        chart,
        top=top,
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


def _top_line(chart: Chart, shape: Shape) -> tuple[float, float]:
    """The cone's top in the side view: its slope, and its height in mm where x is 0.

    A straight line through the highest places of the rear sections.
    """
    share = np.linspace(*STEADY.cone, STEADY.places)
    at_mm = chart.arc.line.at(share * chart.arc.length_mm)[0]
    top_mm = _highest_mm(chart, shape, at_mm)
    known = np.isfinite(top_mm)
    basis, top_mm = np.column_stack([at_mm, np.ones(len(at_mm))])[known], top_mm[known]
    weight, flat_mm = np.ones(len(top_mm)), STEADY.flat * chart.arc.length_mm
    for _ in range(STEADY.rounds):
        root = np.sqrt(weight)
        line = np.linalg.lstsq(basis * root[:, None], top_mm * root, rcond=None)[0]
        weight = 1.0 / (1.0 + ((basis @ line - top_mm) / flat_mm) ** 2)
    return float(line[0]), float(line[1])


def _highest_mm(chart: Chart, shape: Shape, x_mm: Floats) -> Floats:
    """How high a last's sections at places along the ground are, (n,); NaN where it has none."""
    cut = sections_across(chart.standing(shape.vertices_mm), shape.faces, x_mm)
    return highest(cut.points[:, :, 2], cut)
