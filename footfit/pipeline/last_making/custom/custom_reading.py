"""How the aims of a custom last are read from a mesh, and where its tapes lie."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from footfit.errors import OutOfReach
from footfit.geometry.deform.probes import DIRECTIONS, Probe, girth_probe, span_probe
from footfit.geometry.measures.heel_girths import angle_to_deg, cone_edge
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.least_tape import (
    TAPE,
    RoughGirths,
    Tape,
    heel_tape,
    tape_about,
    tape_over,
    tilted,
)
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.widths import WIDTHS
from footfit.geometry.mesh.outermost_point import tip
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.fit.judging.bottom_gains import LENGTHS, bottom_gain
from footfit.pipeline.fit.judging.cells import ZoneShape
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import (
    BALL_LENGTH,
    HEEL_GIRTH,
    LENGTH,
    CustomAim,
)
from footfit.results import GirthPlane, Measure, Measured

LEVEL = np.array([1.0, 1.0, 0.0])
BALL = ("ball_girth_least", "ball_girth", "ball_width", BALL_LENGTH)
MIDDLE_MM, LOW = 15.0, 0.04
"""Places so near to the middle, and so low over the bottom over the arc's length, say how far the
bottom moved ahead."""
BALL_REACH, BALL_UP = 0.08, 0.06
"""So far along and up from a joint it is looked for again, over the length."""


@dataclass(frozen=True, slots=True)
class TapePlane:
    """The plane in which a girth is taken: a point (3,), and the axes across and up, (2, 3).

    What lies farther across than ``reach_mm`` is not within the tape.
    """

    origin: Floats
    axes: Floats
    reach_mm: float = np.inf

    @property
    def normal(self) -> Floats:
        """The plane's normal, (3,)."""
        return cross(*self.axes)


def _around_ball(shape: Shape) -> Tape:
    assert shape.joints is not None
    return tape_about(shape, *shape.joints, shape.upright)


def _over_waist(shape: Shape) -> Tape:
    assert shape.waist_crown is not None
    return tape_over(shape, shape.waist_crown.place)


TAPES: dict[str, Callable[[Shape], Tape]] = {
    "ball_girth_least": _around_ball,
    "waist_girth_least": _over_waist,
    "instep_girth_least": lambda shape: tape_over(shape, shape.instep_crown.place),
    "heel_girth_instep": heel_tape,
}


def tape_plane(shape: Shape, measure: str) -> TapePlane | None:
    """The plane of a girth on a shape that has it; None of a measure that is no girth."""
    if measure in TAPES:
        tape = TAPES[measure](shape)
        return TapePlane(tape.origin, tape.axes, tape.reach_mm + TAPE.beyond * shape.length_mm)
    if measure == "ball_girth":
        assert shape.ball_plane is not None
        return TapePlane(*shape.ball_plane)
    if measure == "instep_girth":
        return TapePlane(shape.instep, AXES[1:])
    if measure == HEEL_GIRTH:
        rise = np.radians(angle_to_deg(shape, cone_edge(shape)))
        forward = np.cos(rise) * AXES[0] + np.sin(rise) * AXES[2]
        return TapePlane(shape.heel_base, np.stack([AXES[1], forward]))
    return None


def file_plane(shape: Shape, measure: str, to_file: Floats) -> GirthPlane | None:
    """The plane of a girth in the axes of a file; None of a measure that is no girth.

    ``to_file`` (4, 4) leads there from the shape's frame.
    """
    plane = tape_plane(shape, measure)
    if plane is None:
        return None
    x, y, z = (to_file[:3, :3] @ plane.origin + to_file[:3, 3]).tolist()
    normal = to_file[:3, :3] @ plane.normal
    a, b, c = (normal / np.linalg.norm(normal)).tolist()
    return GirthPlane((x, y, z), (a, b, c))


def value_mm(shape: Shape, measure: str, base: BaseLast, longer_mm: float | None = None) -> float:
    """A measure of a shape; of the length, that which the toe room goes by.

    ``longer_mm`` is its :func:`gain_mm`, if that is known. NaN if the shape does
    not have the measure.
    """
    if measure == LENGTH:
        return _functional_mm(shape) + (gain_mm(shape, base) if longer_mm is None else longer_mm)
    value = measure_named(measure).taken_of(shape).value
    return np.nan if value is None else value


def asked_mm(aim: CustomAim, length_mm: float) -> float:
    """What an aim's measure should read on the changed base. A length goes by the toe room: it
    reads ``length_mm`` on the base.
    """
    return aim.target if aim.measure != LENGTH else length_mm + aim.target - aim.base


def _functional_mm(shape: Shape) -> float:
    """The functional length; the length of a shape that has none."""
    return measure_named("functional_length").taken_of(shape).value or shape.length_mm


def gain_mm(shape: Shape, base: BaseLast) -> float:
    """How much longer a changed base is along its bottom, which counts for the toe room."""
    names = ("functional_length", LENGTH, "heel_height", *LENGTHS)
    values = {name: measure_named(name).taken_of(shape).value for name in names}
    measures = {
        name: Measure(name, Measured(value), measure_named(name).definition_id)
        for name, value in values.items()
    }
    labels = base.record.labels
    last = ZoneShape(base.record.extent_mm, base.record.flare, measures, labels.heel_height_mm)
    return bottom_gain(last)[0]


def probe_of(shape: Shape, measure: str) -> Probe:
    """What answers for a measure when the shape changes a little."""
    vertices_mm, faces = shape.vertices_mm, shape.faces
    if measure in BALL:
        return _ball_probe(shape, measure)
    plane = tape_plane(shape, measure)
    if plane is not None:
        return girth_probe(vertices_mm, faces, plane.origin, plane.axes, plane.reach_mm)
    if measure == LENGTH:
        rear, front = shape.ends
        return span_probe(vertices_mm, rear.place, front.place, AXES[0])
    section = shape.across(WIDTHS.heel).points
    low = section[section[:, 1] < section[:, 1].min() + WIDTHS.height * shape.length_mm]
    ends = (low[np.argmin(low[:, 0])], low[np.argmax(low[:, 0])])
    lateral, medial = (np.array([shape.x_mm(WIDTHS.heel), *end]) for end in ends)
    return span_probe(vertices_mm, lateral, medial, AXES[1])


def _ball_probe(shape: Shape, measure: str) -> Probe:
    """A girth, the width or the place of the ball. When widths change, the joints move: they are
    found anew.

    The tilt of the tape stays.
    """
    least = measure == "ball_girth_least"
    joints = shape.joints if least else (shape.mt5, shape.mt1)
    assert joints is not None
    x = shape.vertices_mm[shape.faces, 0]
    ends = [joint[0] for joint in joints if joint is not None]
    reach_mm = BALL_REACH * shape.length_mm
    kept = (x.max(axis=1) > min(ends) - reach_mm) & (x.min(axis=1) < max(ends) + reach_mm)
    rows, near = np.unique(shape.faces[kept], return_inverse=True)
    faces = near.reshape(-1, 3).astype(np.int64)
    middles = shape.vertices_mm[rows][faces].mean(axis=1)
    windows = []
    for joint in joints:
        assert joint is not None
        by_mm = np.abs(middles - joint) / shape.length_mm
        windows.append(faces[(by_mm[:, 0] < BALL_REACH) & (by_mm[:, 2] < BALL_UP)])
    tilt_deg = _around_ball(shape).tilt_deg if least else 0.0
    upright = shape.upright if least else AXES[2]

    def value(points: Floats) -> float:
        outer, inner = (
            tip(points, window, side * AXES[1], shape.length_mm).place
            for window, side in zip(windows, (-1.0, 1.0), strict=True)
        )
        if measure == BALL_LENGTH:
            return float(inner[0])
        across = inner - outer if least else (inner - outer) * LEVEL
        width_mm = float(np.linalg.norm(across))
        if measure == "ball_width":
            return width_mm
        axes = tilted(across / width_mm, upright, tilt_deg)
        middle = Shape(points, faces)
        return RoughGirths(middle, 0.5 * (outer + inner), DIRECTIONS).at(axes)

    return Probe(rows.astype(np.int64), value)


class Carried:
    """Shapes that a base becomes while its bottom's heights stay: each lies and stands as a shape
    does that was read.

    A frame and a stance that are found anew would waver by some tenths of a degree from step to
    step, and take longer. ``known`` is that shape, with the base's vertices (n, 3) in their order;
    ``frame`` (4, 4) leads from the base's resting frame to its own.
    """

    def __init__(
        self,
        known: Shape,
        base: BaseLast,
        frame: Floats | None = None,
        base_length_mm: float | None = None,
        longer_mm: float | None = None,
    ) -> None:
        assert known.bottom_arc is not None
        along, over = known.bottom_arc.shares(known.vertices_mm)
        middle = np.abs(known.vertices_mm[:, 1] - np.median(known.vertices_mm[:, 1])) < MIDDLE_MM
        low = np.flatnonzero((over < LOW) & middle)
        self._rows = low[np.argsort(along[low])]
        self._along = known.bottom_arc.stands[0, :3]
        self._known = known
        self._frame = np.eye(4) if frame is None else frame
        self._base = base
        self._gain_mm = gain_mm(known, base) if longer_mm is None else longer_mm
        self._base_length_mm = base_length_mm

    @property
    def base_length_mm(self) -> float:
        """What the length reads on the base."""
        if self._base_length_mm is None:
            self._base_length_mm = value_mm(self._base.shape, LENGTH, self._base)
        return self._base_length_mm

    def lying(self, vertices_mm: Floats) -> Floats:
        """Vertices (n, 3) of the base's resting frame as the known shape lies."""
        return np.asarray(vertices_mm @ self._frame[:3, :3].T + self._frame[:3, 3])

    def shape(self, vertices_mm: Floats) -> Shape:
        """The base with moved vertices (n, 3) of its resting frame."""
        known, rows, vertices_mm = self._known, self._rows, self.lying(vertices_mm)
        stance = known.stance
        assert stance is not None
        start_mm = known.vertices_mm[rows] @ self._along - stance.rear_mm
        shift_mm = (vertices_mm[rows] - known.vertices_mm[rows]) @ self._along
        middle_mm = stance.middle_mm.copy()
        middle_mm[:, 0] += np.interp(middle_mm[:, 0], start_mm, shift_mm)
        by_mm = float(np.interp(stance.touching_x_mm, start_mm, shift_mm))
        x_mm, z_mm = stance.touching_mm
        moved = replace(
            stance,
            touching_mm=(x_mm + by_mm * self._along[0], z_mm + by_mm * self._along[2]),
            length_mm=stance.length_mm + float(shift_mm[-1]),
            middle_mm=middle_mm,
        )
        shape = Shape(vertices_mm, known.faces, "last", known.labels)
        known_parts = {"stance": moved, "filled": known.filled, "top_cut": known.top_cut}
        if not known.cone_cut:  # where nothing was cut away, nothing is
            known_parts["cone_cut"] = known.cone_cut
        vars(shape).update(known_parts)  # they need not be found
        return shape

    def probes(self, vertices_mm: Floats, aims: Sequence[CustomAim]) -> list[Probe]:
        """What answers for each aim when moved vertices (n, 3) of the base move a little more.

        Raises
        ------
        OutOfReach
            Its ball is not found.
        """
        shape = self.shape(vertices_mm)
        places = shape.joints, shape.mt1, shape.mt5, shape.waist_crown
        if any(place is None for place in places):
            raise OutOfReach("the base cannot be changed so far that its ball is still found")
        return [self._lying_probe(probe_of(shape, aim.measure)) for aim in aims]

    def _lying_probe(self, own: Probe) -> Probe:
        return Probe(own.rows, lambda points_mm: own.value(self.lying(points_mm)))

    def values_mm(self, vertices_mm: Floats, aims: Sequence[CustomAim]) -> Floats:
        """The aims' measures (aims,) of moved vertices (n, 3) of the base."""
        shape = self.shape(vertices_mm)
        return np.array(
            [
                self._heel_mm(shape)
                if aim.measure == HEEL_GIRTH
                else value_mm(shape, aim.measure, self._base, self._gain_mm)
                for aim in aims
            ]
        )

    def _heel_mm(self, shape: Shape) -> float:
        """The short heel girth of a shape: in the plane in which the known one has it."""
        more_mm, probe = self._heel
        return more_mm + probe.value(shape.vertices_mm[probe.rows])

    @cached_property
    def _heel(self) -> tuple[float, Probe]:
        """How much more the short heel girth reads than its probe, and that probe."""
        probe = probe_of(self._known, HEEL_GIRTH)
        own_mm = value_mm(self._known, HEEL_GIRTH, self._base)
        return own_mm - probe.value(self._known.vertices_mm[probe.rows]), probe
