"""The chart of a last: where each place lies along its bottom's arc, across it and over it.

All coordinates are those of the standing frame: x along the ground from the rearmost point, y to
the medial side, z over the ground, in mm. The rays of the chart are upright. So a place has the
station of the bottom straight below it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.measures.bottom_arc import BottomArc
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.top_cut import standing_top
from footfit.geometry.mesh.surface import area_vectors, face_normals
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.planes import Plane, robust_plane
from footfit.geometry.numeric.smoothing import cubic_splines, local_quadratic


@dataclass(frozen=True, slots=True)
class ChartSettings:
    """How a last is charted; places over the arc's length, heights over it too.

    Attributes
    ----------
    knots : int
        How many splines a curve along the arc has; the first and the last lie beyond its ends.
    cells : int
        In so many strips along the arc the middle, the bottom's edge and the height are read.
    smooth : float
        The standard deviation of the local parabolas that smooth these three along the arc.
    wall : float
        What lies lower over the bottom belongs to the section whose middle is read.
    faces_down : float
        Faces whose normal looks down by this cosine are bottom.
    low : float
        From the bottom's highest edge on, heights come to their full change over this share of the
        section's height.
    low_widths : float
        The same for widths, if the bottom keeps its outline.
    gentle : bool
        Whether the slope of that change rises smoothly and then stays. It never overshoots; else
        the change itself rises, and its slope is steepest half-way.
    thin : float
        A section counts as at least so high.
    deep : float
        What lies so deep under the top plane moves in full, over the plane's height over the
        bottom; the top plane does not move.
    fade : tuple of float
        In front of the top plane's front edge its hold ends over this stretch.
    behind, flat, rounds : float, float, int
        The top plane is fitted to what lies behind this place, with Cauchy weights of this width,
        so often.
    rim : tuple of float
        What lies so little under the top plane still belongs to it, at least and at most: a top may
        be domed.
    """

    knots: int = 19
    cells: int = 48
    smooth: float = 0.035
    wall: float = 0.13
    faces_down: float = 0.5
    low: float = 0.35
    low_widths: float = 1.0
    gentle: bool = True
    thin: float = 0.02
    deep: float = 1.0
    fade: tuple[float, float] = (0.02, 0.40)
    behind: float = 0.33
    flat: float = 0.004
    rounds: int = 12
    rim: tuple[float, float] = (0.005, 0.02)


CHART = ChartSettings()


def eased(share: Floats) -> Floats:
    """The quintic that rises from 0 at 0 to 1 at 1 with two level derivatives; flat outside.

    Examples
    --------
    >>> eased(np.array([-1.0, 0.5, 2.0])).tolist()
    [0.0, 0.5, 1.0]
    """
    t = np.clip(share, 0.0, 1.0)
    return np.asarray(t**3 * (10.0 - 15.0 * t + 6.0 * t**2))


def eased_sum(share: Floats) -> Floats:
    """The integral of :func:`eased` from 0 on: it ends as a straight line.

    Examples
    --------
    >>> eased_sum(np.array([-1.0, 1.0, 2.0])).tolist()
    [0.0, 0.5, 1.5]
    """
    t = np.clip(share, 0.0, 1.0)
    return np.asarray(t**4 * (2.5 - 3.0 * t + t**2) + np.maximum(share - 1.0, 0.0))


@dataclass(frozen=True, slots=True)
class Places:
    """Points of a last in its chart: what a field needs to move them.

    Attributes
    ----------
    points_mm : (n, 3)
        In the standing frame.
    share : (n,)
        Where they lie along the arc.
    splines : (n, knots)
        The splines along the arc at each point; a row times a curve's coefficients is its value.
    across_mm, over_mm : (n,)
        From the middle line of the plan, and over the bottom's line.
    risen : (n,)
        0 on the bottom, 1 where widths change in full though the bottom keeps its outline.
    scaled_mm : (n,)
        The height that scales of heights change; 0 on the bottom.
    free : (n,)
        0 on the top plane, 1 where nothing holds a point.
    """

    points_mm: Floats
    share: Floats
    splines: Floats
    across_mm: Floats
    over_mm: Floats
    risen: Floats
    scaled_mm: Floats
    free: Floats


@dataclass(frozen=True)
class Chart:
    """The chart of one last.

    Attributes
    ----------
    arc : BottomArc
        The bottom's line in the side view; its ``stands`` leads into the standing frame.
    stations : (k,)
        Shares of the arc at which the three curves below are given.
    middle_mm, edge_mm, height_mm : (k,)
        The middle of the plan across, the bottom's highest edge over its line, and the last's
        height over that.
    top : Plane or None
        What lies over this plane belongs to the cone's top; None if there is none, or if it is not
        held.
    front, deep_mm : float
        Where along the arc the top plane ends, and how deep under it its hold reaches.
    """

    arc: BottomArc
    stations: Floats
    middle_mm: Floats
    edge_mm: Floats
    height_mm: Floats
    top: Plane | None
    front: float
    deep_mm: float
    settings: ChartSettings = CHART

    def standing(self, points_mm: Floats) -> Floats:
        """Points (n, 3) of the resting frame in the standing frame."""
        return np.asarray(points_mm @ self.arc.stands[:3, :3].T + self.arc.stands[:3, 3])

    def resting(self, points_mm: Floats) -> Floats:
        """Points (n, 3) of the standing frame in the resting frame."""
        return np.asarray((points_mm - self.arc.stands[:3, 3]) @ self.arc.stands[:3, :3])

    def splines(self, share: Floats) -> Floats:
        """The splines (n, knots) at shares of the arc (n,); beyond its ends they stay level."""
        return cubic_splines(np.clip(share, 0.0, 1.0), self.settings.knots)[0]

    def centres(self) -> Floats:
        """Where along the arc each spline is highest, (knots,)."""
        knots = self.settings.knots
        return np.asarray((np.arange(knots) - 1.0) / (knots - 3.0), dtype=np.float64)

    def places(self, points_mm: Floats) -> Places:
        """Points (n, 3) of the standing frame in the chart."""
        arc_mm, y, over_mm = self.arc.line.unrolled(points_mm).T
        share = arc_mm / self.arc.length_mm
        middle, edge, height = (
            np.interp(share, self.stations, curve)
            for curve in (self.middle_mm, self.edge_mm, self.height_mm)
        )
        ramp_mm = self.settings.low * height
        share_up = (over_mm - edge) / ramp_mm
        risen = eased((over_mm - edge) / (self.settings.low_widths * height))
        gentle = self.settings.gentle
        return Places(
            points_mm=points_mm,
            share=share,
            splines=self.splines(share),
            across_mm=y - middle,
            over_mm=over_mm,
            risen=risen,
            scaled_mm=ramp_mm * eased_sum(share_up) if gentle else over_mm * eased(share_up),
            free=self._free(points_mm, share),
        )

    def _free(self, points_mm: Floats, share: Floats) -> Floats:
        """How free of the top plane points (n, 3) are, (n,): 0 on it, 1 deep under it."""
        if self.top is None:
            return np.ones(len(points_mm))
        deep = np.clip(-self.top.heights(points_mm) / self.deep_mm, 0.0, 1.0)
        held = 1.0 - deep**2 * (3.0 - 2.0 * deep)  # the cubic shears least
        start, end = self.settings.fade
        held *= 1.0 - eased((share - self.front - start) / (end - start))
        free: Floats = 1.0 - held
        return free


def chart_of(shape: Shape, *, hold_top: bool = True, settings: ChartSettings = CHART) -> Chart:
    """The chart of a last whose stance is known.

    Parameters
    ----------
    shape : Shape
        A canonical right last.
    hold_top : bool
        Whether the plane of the cone's top stays where it is.

    Raises
    ------
    ValueError
        It has no stance: its bottom is open.
    """
    arc = shape.bottom_arc
    if arc is None:
        raise ValueError("a shape without a bottom's arc has no chart")
    standing = shape.vertices_mm @ arc.stands[:3, :3].T + arc.stands[:3, 3]
    along, over = arc.shares(shape.vertices_mm)
    faces = shape.faces
    stations = np.linspace(0.0, 1.0, 401)
    cells = _Cells(along, stations, settings)
    low = over < settings.wall
    middle = 0.5 * (cells.greatest(standing[:, 1], low) - cells.greatest(-standing[:, 1], low))
    normals = face_normals(standing, faces)
    down = faces[normals[:, 2] < -settings.faces_down].ravel()
    bottom = np.zeros(len(standing), dtype=bool)
    bottom[down] = True
    edge = np.maximum(cells.greatest(over, bottom & low), 0.0) * arc.length_mm
    height = cells.greatest(over, np.ones(len(over), dtype=bool)) * arc.length_mm - edge
    height = np.maximum(height, settings.thin * arc.length_mm)
    plain = Chart(arc, stations, middle, edge, height, None, 0.0, 0.0, settings)
    lid = standing_top(standing, faces) if hold_top else faces[:0]
    behind = lid[along[lid].mean(axis=1) < settings.behind]
    if not len(behind):
        return plain
    top = _top_plane(standing, behind, settings, arc)
    under_mm = -top.heights(standing[np.unique(behind)])
    low_mm, high_mm = (share * arc.length_mm for share in settings.rim)
    rim_mm = float(np.clip(under_mm.max(), low_mm, high_mm))
    corners = np.unique(lid)
    corners = corners[-top.heights(standing[corners]) <= max(rim_mm, float(under_mm.min()))]
    return replace(
        plain,
        top=replace(top, offset=top.offset - rim_mm),
        front=float(along[corners].max()),
        deep_mm=settings.deep * float(over[corners].mean()) * arc.length_mm,
    )


def _top_plane(standing: Floats, lid: Ints, settings: ChartSettings, arc: BottomArc) -> Plane:
    """The plane of most of the faces (k, 3) of a cone's top."""
    middles, vectors = standing[lid].mean(axis=1), area_vectors(standing, lid)
    areas = np.linalg.norm(vectors, axis=1)
    normal = vectors.sum(axis=0) / np.linalg.norm(vectors.sum(axis=0))
    start = Plane(normal, float(areas @ (middles @ normal) / areas.sum()))
    return robust_plane(middles, areas, settings.flat * arc.length_mm, settings.rounds, start)


class _Cells:
    """The greatest value in strips along the arc, as a smooth curve over ``stations``."""

    def __init__(self, along: Floats, stations: Floats, settings: ChartSettings) -> None:
        self._cell = np.clip((along * settings.cells).astype(np.int64), 0, settings.cells - 1)
        self._count = settings.cells
        centre = (np.arange(settings.cells) + 0.5) / settings.cells
        self._value = local_quadratic(stations, centre, settings.smooth)[0]
        self._centre = centre

    def greatest(self, values: Floats, chosen: Bools) -> Floats:
        """The greatest of the chosen values (n,) along the arc, smoothed."""
        most = np.full(self._count, -np.inf)
        np.maximum.at(most, self._cell[chosen], values[chosen])
        known = np.isfinite(most)
        filled = np.interp(self._centre, self._centre[known], most[known])
        return np.asarray(self._value @ filled)
