"""Two lines of a last's chart that a step back finds again: the plan's middle and the cone's top.

Both are read from exact sections. What is read from the vertices, or the faces, that lie in a strip
jumps when one of them changes its strip. Then a step back moves a place by something else.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.deform.chart import Chart
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.sections import extremes_below, highest, sections_across
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.smoothing import local_quadratic


@dataclass(frozen=True, slots=True)
class SteadySettings:
    """Where the cone's top is read, as shares of the arc, and how its line is fitted.

    ``cone`` has ``places`` of it from end to end. The line has Cauchy weights of the width
    ``flat``, over the arc's length, and ``rounds`` of them.
    """

    cone: tuple[float, float] = (0.10, 0.28)
    places: int = 19
    flat: float = 0.004
    rounds: int = 25


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

    The top is a straight line in the side view, through the highest places of the rear sections. It
    is drawn on over the whole last.
    """
    length_mm = chart.arc.length_mm
    share = np.linspace(*STEADY.cone, STEADY.places)
    at_mm = chart.arc.line.at(share * length_mm)[0]
    cut = sections_across(chart.standing(shape.vertices_mm), shape.faces, at_mm)
    top_mm = highest(cut.points[:, :, 2], cut)
    known = np.isfinite(top_mm)
    basis, top_mm = np.column_stack([at_mm, np.ones(len(at_mm))])[known], top_mm[known]
    weight = np.ones(len(top_mm))
    for _ in range(STEADY.rounds):
        root = np.sqrt(weight)
        slope, height = np.linalg.lstsq(basis * root[:, None], top_mm * root, rcond=None)[0]
        weight = 1.0 / (1.0 + ((basis @ [slope, height] - top_mm) / (STEADY.flat * length_mm)) ** 2)
    x_mm, z_mm = chart.arc.line.at(chart.stations * length_mm)
    return np.asarray(slope * x_mm + height - z_mm)
