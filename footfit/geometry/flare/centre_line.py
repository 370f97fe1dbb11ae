"""The centre line of a bottom: in every section normal to it, it lies midway between the edges.

The line is a cubic spline y(x). The condition is solved by Gauss-Newton steps: each step cuts the
sections across the line of the step before, and takes into account that a turned section meets the
outline at another place. Sections across X instead would give a quarter too little bend.

Lengths are shares of L throughout.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.errors import HalfScan
from footfit.geometry.flare.band_edges import band_edges
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.levelled_bottom import BottomShape, section_places
from footfit.geometry.mesh.sections import (
    Planes,
    Segments,
    lowest,
    plane_sections,
)
from footfit.geometry.numeric.arrays import Bools, Floats
from footfit.geometry.numeric.smoothing import cubic_splines


@dataclass(frozen=True, slots=True)
class _Graph:
    """A line tabulated at ``x``: ``y``, its ``slope`` and ``bend`` (second derivative), (g,)."""

    x: Floats
    y: Floats
    slope: Floats
    bend: Floats


@dataclass(frozen=True, slots=True)
class Bands:
    """The sections of the last step: ``across`` and ``height`` (m, 2) in their planes.

    ``x`` (k,) is where the line meets them, ``floor`` (k,) their lowest points. ``offset`` (k,) is
    how far the mid-points lie beside the line, ``half_width`` (k,) half the widths; NaN where a
    section has no band.
    """

    segments: Segments
    across: Floats
    height: Floats
    x: Floats
    floor: Floats
    offset: Floats
    half_width: Floats


@dataclass(frozen=True, slots=True)
class CentreLine:
    """The line: cubic splines y(x) with these ``coefficients``, and a table of it.

    The table is ``x``, ``y``, ``slope`` (g,) and ``station`` (g,), the share of the line's own
    length between the ends of the shape; ``arc_length`` is that length. ``response`` (splines, k)
    says how the coefficients follow the mid-points of the ``bands``. ``scatter`` (k,) is how far
    the mid-points lie beside the line (0 where there is none), and ``freedom`` how many of them the
    line leaves free.
    """

    coefficients: Floats
    x: Floats
    y: Floats
    slope: Floats
    station: Floats
    arc_length: float
    response: Floats
    scatter: Floats
    freedom: float
    bands: Bands

    def x_at(self, station: Floats) -> Floats:
        """Where the line is at ``station`` (n,)."""
        return np.interp(station, self.station, self.x)

    def station_at(self, x: Floats) -> Floats:
        """The station of the line at ``x`` (n,)."""
        return np.interp(x, self.x, self.station)


def centre_line(shape: BottomShape, definition: FlareDefinition) -> CentreLine:
    """The line whose normal sections it halves.

    Parameters
    ----------
    shape : BottomShape
    definition : FlareDefinition

    Returns
    -------
    CentreLine

    Raises
    ------
    HalfScan
        Too few sections have a band.
    """
    axis = _settled_axis(shape, definition)
    count = len(axis.offset)
    stiff = _stiffness(2, definition.axis_stiffness, definition)
    lighter = _stiffness(3, definition.line_stiffness, definition)
    first, last = _solution(axis.design, stiff), _solution(axis.design, lighter)
    step = _step(axis, stiff)
    step = step + last @ (axis.offset - axis.design @ step)
    response = first + last @ (np.eye(count) - axis.design @ first)
    scatter = np.where(axis.seen, axis.offset - axis.design @ step, 0.0)
    line = _tabulated(shape, axis.coefficients + step, definition)
    freedom = float(axis.seen.sum() - np.trace(axis.design @ response))
    return CentreLine(*line, response, scatter, freedom, axis.bands)


@dataclass(frozen=True, slots=True)
class _Axis:
    """The line of ``coefficients`` that ``bands`` are normal to, and how the bands lie beside it.

    ``offset`` (k,) are the mid-points' offsets, 0 if not ``seen``; ``design`` (k, splines) is how
    they follow the coefficients.
    """

    coefficients: Floats
    bands: Bands
    seen: Bools
    offset: Floats
    design: Floats


def _settled_axis(shape: BottomShape, definition: FlareDefinition) -> _Axis:
    """Cut across the line, move the line to the mid-points, until it no longer moves."""
    x = section_places(definition)
    basis = cubic_splines(x, definition.splines)
    places = np.linspace(*definition.table)
    table = cubic_splines(places, definition.splines)
    stiff = _stiffness(2, definition.axis_stiffness, definition)
    smooth_width = _stiffness(2, definition.width_stiffness, definition)
    coefficients = np.zeros(definition.splines)
    beyond = np.maximum(x - definition.trusted_to, 0.0) / definition.trust_bandwidth
    trust = np.exp(-0.5 * beyond**2)
    for turn in range(definition.passes):
        graph = _Graph(places, *(t @ coefficients for t in table))
        bands = _normal_bands(shape, graph, x, definition)
        seen = _seen(bands, definition)
        design = trust[:, None] * _design(bands, seen, basis, coefficients, smooth_width)
        offset = trust * np.where(seen, bands.offset, 0.0)
        axis = _Axis(coefficients, bands, seen, offset, design)
        step = _step(axis, stiff)
        if np.abs(basis[0] @ step).max() < definition.settled:
            break
        coefficients = coefficients + (step if turn < definition.full_steps else 0.5 * step)
    return axis


def _step(axis: _Axis, stiff: Floats) -> Floats:
    """The Gauss-Newton step of the coefficients, under a penalty on the line itself."""
    normal = axis.design.T @ axis.design + stiff.T @ stiff
    pull = stiff.T @ (stiff @ axis.coefficients)
    step = np.linalg.solve(normal, axis.design.T @ axis.offset - pull)
    return np.asarray(step, dtype=np.float64)


def _seen(bands: Bands, definition: FlareDefinition) -> Bools:
    seen = np.isfinite(bands.offset)
    if seen.mean() < definition.found_least:
        raise HalfScan(
            f"the scan shows only {100 * seen.mean():.0f} % of the bottom's length: "
            "scan the whole foot again"
        )
    return seen


def _stiffness(order: int, strength: float, definition: FlareDefinition) -> Floats:
    """Rows that penalise the mean square of a spline's derivative of this order.

    In front of ``toe_from`` they weigh ``toe_stiffness`` times as much. There a section may step
    from one toe to the next, which turns the line, and a turned line steps over more toes.
    """
    pieces = definition.splines - 3
    rows = np.diff(np.eye(definition.splines), order, axis=0) * float(pieces) ** order
    place = (np.arange(len(rows)) + 0.5 * order - 1.0) / pieces
    weight = np.where(place > definition.toe_from, definition.toe_stiffness, 1.0)
    weight = weight * strength * definition.sections / len(rows)
    return np.asarray(rows * np.sqrt(weight)[:, None], dtype=np.float64)


def _normal_bands(
    shape: BottomShape, graph: _Graph, x: Floats, definition: FlareDefinition
) -> Bands:
    """The bands of the sections normal to a line."""
    y, slope = (np.interp(x, graph.x, values) for values in (graph.y, graph.slope))
    length = np.hypot(1.0, slope)
    origins = np.column_stack([x, y, np.zeros_like(x)])
    normals = np.column_stack([1.0 / length, slope / length, np.zeros_like(x)])
    levels = _projected(shape.vertices, graph, definition)
    segments = plane_sections(shape.vertices, shape.faces, levels, Planes(x, origins, normals))
    run = segments.points[:, :, :2] - origins[segments.plane][:, None, :2]
    across = run[:, :, 1] * normals[segments.plane, 0, None]
    across = across - run[:, :, 0] * normals[segments.plane, 1, None]
    height = segments.points[:, :, 2]
    floor = lowest(height, segments)
    # At a gap in the sole the lowest part is a leg, which is not a band.
    limit = np.where(floor <= definition.length_height, floor + definition.band_height, np.nan)
    least, most = band_edges(across, height, limit, segments, definition.edge_depth)
    return Bands(
        segments, across, height, x, floor, offset=(least + most) / 2, half_width=(most - least) / 2
    )


def _projected(points: Floats, graph: _Graph, definition: FlareDefinition) -> Floats:
    """The x of the line's point in whose normal plane each point (n, 2 or 3) lies, (n,)."""
    x = points[:, 0].copy()
    for _ in range(definition.projections):
        y, slope, bend = (np.interp(x, graph.x, t) for t in (graph.y, graph.slope, graph.bend))
        aside = points[:, 1] - y
        value = points[:, 0] - x + slope * aside
        x = x + value / np.maximum(1.0 + slope**2 - bend * aside, definition.turn_least)
    return x


def _design(
    bands: Bands,
    seen: Bools,
    basis: tuple[Floats, Floats, Floats],
    coefficients: Floats,
    stiff: Floats,
) -> Floats:
    """How the mid-points follow the line's coefficients, (k, splines); zero rows where unseen.

    A line that moves by dn and turns by dphi leaves the mid-point offset m - dn - w w' dphi, with
    w the half width: a turned section meets the outline further forward on one side.
    """
    value, slope, _ = basis
    half = _solution(value * seen[:, None], stiff) @ np.where(seen, bands.half_width, 0.0)
    turn = (value @ half) * (slope @ half)
    length = np.hypot(1.0, slope @ coefficients)
    rows = value / length[:, None] + (turn / length**2)[:, None] * slope
    return np.asarray(rows * seen[:, None], dtype=np.float64)


def _solution(design: Floats, stiff: Floats) -> Floats:
    """The penalised least-squares solution as a matrix, (splines, k)."""
    normal = design.T @ design + stiff.T @ stiff
    return np.asarray(np.linalg.solve(normal, design.T), dtype=np.float64)


def _tabulated(
    shape: BottomShape, coefficients: Floats, definition: FlareDefinition
) -> tuple[Floats, Floats, Floats, Floats, Floats, float]:
    """The first six fields of a :class:`CentreLine`."""
    x = np.linspace(*definition.table)
    graph = _Graph(x, *(t @ coefficients for t in cubic_splines(x, len(coefficients))))
    mean_slope = 0.5 * (graph.slope[1:] + graph.slope[:-1])
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(1.0, mean_slope) * np.diff(x))])
    start, end = np.interp([_exit(shape, graph, at) for at in definition.straight_ends], x, arc)
    length = float(end - start)
    return coefficients, x, graph.y, graph.slope, (arc - start) / length, length


def _exit(shape: BottomShape, graph: _Graph, at: float) -> float:
    """The x at which the line, straight on from x = ``at``, leaves the shape.

    The shape is cut exactly along the line. The outermost point of a square toe is at another
    place if the line points a degree or two aside.
    """
    y, slope = (float(np.interp(at, graph.x, values)) for values in (graph.y, graph.slope))
    ahead = np.array([1.0, slope, 0.0]) / np.hypot(1.0, slope)
    origin = np.array([at, y, 0.0])
    aside = np.array([-ahead[1], ahead[0], 0.0])
    corners = shape.tips.reshape(-1, 3)
    plane = Planes(np.zeros(1), origin[None], aside[None])
    numbers = np.arange(len(corners)).reshape(-1, 3)
    cut = plane_sections(corners, numbers, (corners - origin) @ aside, plane).points.reshape(-1, 3)
    reach = (cut - origin) @ ahead if len(cut) else (corners - origin) @ ahead
    furthest = reach.max() if at > 0.5 else reach.min()
    return at + float(furthest) * float(ahead[0])
