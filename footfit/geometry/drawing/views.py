"""The views of a shape in true size: its bottom laid flat, plan, side, and named sections.

All are of the right shape; a left one is the mirror image, which `View.mirrored` gives. x runs to
the right of the paper and y up.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.drawing.bottom_outline import bottom_outline, flat_frame
from footfit.geometry.drawing.lower_part import below
from footfit.geometry.drawing.shadow import shadow_outlines
from footfit.geometry.drawing.thinned import thinned_loop
from footfit.geometry.fit.paired_sections import station_plane
from footfit.geometry.fit.stations import STATIONS, Station
from footfit.geometry.measures.landmarks import LANDMARKS, Shape
from footfit.geometry.mesh.outlines import TAPE_OUTLINES, Outline, steady_loop
from footfit.geometry.numeric.arrays import Floats, Ints

LEG_HEIGHT = 0.60
"""A foot is drawn from the side up to this height over its length: higher parts are leg."""
SOLE_HEIGHT_MM = 10.0
"""The bottom of a foot is what lies lower than this over the ground."""
LEAST_PIECE = 0.02
"""A piece of a shadow with a smaller share of the largest one's area is not drawn."""
SOLE_LEAST = 0.5
"""So much of the length must lie so low: a scan without its sole has no bottom."""


@dataclass(frozen=True, slots=True)
class Mark:
    """A straight line on a view that says where something is: from ``points_mm[0]`` to ``[1]``."""

    name: str
    points_mm: Floats


@dataclass(frozen=True, slots=True)
class View:
    """A shape in true size, seen from one direction or cut by one plane.

    Attributes
    ----------
    name : str
        "bottom", "plan", "side", or the name of a station.
    outlines_mm : tuple of (k, 2)
        Closed, counter-clockwise: the last point is followed by the first. Toes, and the sole of
        a foot, may have several.
    marks : tuple of Mark
    at_mm : float or None
        Of a section, how far from the pternion along X it is cut.
    symmetric : bool
        Whether the mirror image of the shape has the same view.
    """

    name: str
    outlines_mm: tuple[Floats, ...]
    marks: tuple[Mark, ...] = ()
    at_mm: float | None = None
    symmetric: bool = False

    @property
    def bounds_mm(self) -> tuple[Floats, Floats]:
        """The lower left and the upper right corner of all outlines, (2,) each."""
        points = np.concatenate(self.outlines_mm)
        return points.min(axis=0), points.max(axis=0)

    @property
    def size_mm(self) -> tuple[float, float]:
        """How wide and how high it is."""
        low, high = self.bounds_mm
        return float(high[0] - low[0]), float(high[1] - low[1])

    def mirrored(self) -> View:
        """The view of the mirror image of the shape."""
        if self.symmetric:
            return self
        flip = np.array([-1.0, 1.0])
        marks = tuple(replace(mark, points_mm=mark.points_mm * flip) for mark in self.marks)
        outlines = tuple(outline[::-1] * flip for outline in self.outlines_mm)
        return replace(self, outlines_mm=outlines, marks=marks)


@dataclass(frozen=True, slots=True)
class _Cut:
    """A named section: its loops (k, 2), across to the medial side and up.

    ``flat`` (n, 2) are the points of all loops, ``points`` (n, 3) the same in the canonical frame.
    """

    station: Station
    loops: tuple[Floats, ...]
    flat: Floats
    points: Floats
    at_mm: float

    def edges(self, up: float) -> Floats:
        """The medial and the lateral edge (2, 3): what lies farthest to a side, and ``up``."""
        across = self.flat @ np.array([[1.0, -1.0], [up, up]])
        return np.asarray(self.points[np.argmax(across, axis=0)])

    @property
    def ends(self) -> Floats:
        """The lowest and the highest point, (2, 3)."""
        up = self.flat[:, 1]
        return np.asarray(self.points[[np.argmin(up), np.argmax(up)]])


def views(shape: Shape) -> tuple[tuple[View, ...], tuple[str, ...]]:
    """The views of a canonical right shape, and the names of those that cannot be drawn.

    A section that is open, or that runs over a hole which a program closed, is left out, and so is
    a bottom that is open. The other outlines are of what was scanned.
    """
    cuts = tuple(_cuts(shape))
    bottom = _sole(shape, cuts) if shape.kind == "foot" else _bottom(shape, cuts)
    drawn = [_plan(shape, cuts), _side(shape, cuts), *map(_section, cuts)]
    drawn = drawn if bottom is None else [bottom, *drawn]
    names = ("bottom", *(station.name for station in STATIONS))
    known = {view.name for view in drawn}
    return tuple(drawn), tuple(name for name in names if name not in known)


def _cuts(shape: Shape) -> Iterator[_Cut]:
    """The named sections, as `compare` cuts them, with the corners of a feather edge."""
    for station in STATIONS:
        origin, axes = station_plane(shape, station)
        section: Outline = shape.cut(origin, axes, TAPE_OUTLINES)
        if not (shape.opened(section) or shape.unscanned(section)):
            at_mm = float(origin[0]) - shape.x_mm(0.0)
            flat = section.points
            yield _Cut(station, section.loops, flat, origin + flat @ axes, at_mm)


def _marks(outlines: Sequence[Floats], ends: Iterator[tuple[str, Floats]]) -> tuple[Mark, ...]:
    """Marks through two points (2, 2) each, as long as the outlines are wide there."""
    marks = ((name, chord(outlines, points)) for name, points in ends)
    return tuple(Mark(name, points) for name, points in marks if points is not None)


def chord(outlines: Sequence[Floats], points: Floats) -> Floats | None:
    """The piece (2, 2) of the line through two points that closed outlines (k, 2) cut out.

    From the first to the last place where they meet; None if they do not.

    Examples
    --------
    >>> square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    >>> chord([square], np.array([[1.0, 1], [2, 1]])).tolist()
    [[0.0, 1.0], [4.0, 1.0]]
    """
    start, along = points[0], points[1] - points[0]
    places = np.concatenate([_meetings(outline, start, along) for outline in outlines])
    order = np.argsort((places - start) @ along)
    return np.asarray(places[order[[0, -1]]]) if len(places) else None


def _meetings(outline: Floats, start: Floats, along: Floats) -> Floats:
    """Where a line meets a closed outline (k, 2), (j, 2)."""
    aside = (outline - start) @ np.array([-along[1], along[0]])
    after, ahead = np.roll(outline, -1, axis=0), np.roll(aside, -1)
    met = (aside > 0.0) != (ahead > 0.0)
    share = aside[met] / (aside[met] - ahead[met])
    return np.asarray(outline[met] + share[:, None] * (after[met] - outline[met]))


def _section(cut: _Cut) -> View:
    """A section as it is seen from the heel: the medial side of a right shape is on the left."""
    outlines = tuple(thinned_loop(loop[::-1] * (-1.0, 1.0)) for loop in cut.loops)
    return View(cut.station.name, outlines, at_mm=cut.at_mm)


def _toe_up(points: Floats) -> Floats:
    """Points (n, 2 or 3) on paper: x, to the toe, goes up, and y, to the medial side, left."""
    return np.column_stack([-points[:, 1], points[:, 0]])


def _bottom(shape: Shape, cuts: tuple[_Cut, ...]) -> View | None:
    """A last's bottom laid flat; None if it is open."""
    frame = flat_frame(shape)
    outline = None if frame is None else bottom_outline(shape, frame)
    if frame is None or outline is None:
        return None
    outline = thinned_loop(_toe_up(outline))
    flat = (
        (cut.station.name, _toe_up(frame.flat(cut.edges(-1.0))[:, :2] - (frame.rear_mm, 0.0)))
        for cut in cuts
    )
    return View("bottom", (outline,), _marks((outline,), flat))


def _standing(shape: Shape, points: Floats) -> Floats:
    """Points (n, 3) of the canonical frame as the shape stands; as it rests if that is unknown."""
    stands = shape.standing_transform
    return points if stands is None else points @ stands[:3, :3].T + stands[:3, 3]


def _scanned(shape: Shape) -> Ints:
    """The faces (k, 3) without those that a program closed a hole with."""
    return np.asarray(shape.faces[~shape.filled])


def _sole(shape: Shape, cuts: tuple[_Cut, ...]) -> View | None:
    """The sole of a foot: the shadow of what lies low; None if little of it was scanned."""
    vertices, faces = below(shape.vertices_mm, _scanned(shape), SOLE_HEIGHT_MM)
    x = vertices[faces, 0]
    if not len(faces) or np.ptp(x) < SOLE_LEAST * shape.length_mm:
        return None
    return _from_above("bottom", vertices, faces, cuts)


def _plan(shape: Shape, cuts: tuple[_Cut, ...]) -> View:
    """A standing last from above, or what is no ankle of a foot."""
    if shape.kind == "foot":
        low = below(shape.vertices_mm, _scanned(shape), LANDMARKS.width_height * shape.length_mm)
        return _from_above("plan", *low, cuts)
    return _from_above("plan", _standing(shape, shape.vertices_mm), _scanned(shape), cuts, shape)


def _shadow(points: Floats, faces: Ints) -> tuple[Floats, ...]:
    """The outlines of a shadow without a scanner's noise; those of a clean mesh stay as they are.

    A foot may lie on the ground with its heel and its ball only.
    """
    outlines = shadow_outlines(points, faces, least=LEAST_PIECE)
    length = float(np.ptp(points[faces, 0]))
    return tuple(steady_loop(outline, length, TAPE_OUTLINES) for outline in outlines)


def _from_above(
    name: str, vertices: Floats, faces: Ints, cuts: tuple[_Cut, ...], last: Shape | None = None
) -> View:
    """The shadow from above, with the marks of the sections; those of a ``last`` stand as it."""
    shadow = _shadow(vertices[:, :2], faces)
    outlines = tuple(thinned_loop(_toe_up(outline)) for outline in shadow)
    edges = ((cut.station.name, cut.edges(0.0)) for cut in cuts)
    seen = ((mark, at if last is None else _standing(last, at)) for mark, at in edges)
    return View(name, outlines, _marks(outlines, ((mark, _toe_up(at)) for mark, at in seen)))


def _side(shape: Shape, cuts: tuple[_Cut, ...]) -> View:
    """The shadow from the side as the shape stands, the toe to the right, on the ground z = 0."""
    vertices, faces = _standing(shape, shape.vertices_mm), _scanned(shape)
    if shape.kind == "foot":
        vertices, faces = below(vertices, faces, LEG_HEIGHT * shape.length_mm)
    outlines = tuple(map(thinned_loop, _shadow(vertices[:, [0, 2]], faces)))
    seen = ((cut.station.name, _standing(shape, cut.ends)[:, [0, 2]]) for cut in cuts)
    return View("side", outlines, _marks(outlines, seen), symmetric=True)
