"""How the aims of a custom last are read from a mesh, and where its tapes lie."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.deform.probes import Probe, girth_probe, span_probe
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.least_tape import TAPE, Tape, heel_tape, tape_about, tape_over
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.widths import WIDTHS
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.fit.judging.bottom_gains import LENGTHS, bottom_gain
from footfit.pipeline.fit.judging.cells import ZoneShape
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom_aims import LENGTH, CustomAim
from footfit.results import Measure, Measured

LEVEL = np.array([1.0, 1.0, 0.0])


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
    return None


def value_mm(shape: Shape, measure: str, base: BaseLast) -> float:
    """A measure of a shape; of the length, that which the toe room goes by.

    NaN if the shape does not have it.
    """
    if measure == LENGTH:
        return _toe_room_length_mm(shape, base)
    value = measure_named(measure).value_of(shape).value
    return np.nan if value is None else value


def _toe_room_length_mm(shape: Shape, base: BaseLast) -> float:
    """The length that counts for the toe room: the functional length, along the bottom."""
    names = ("functional_length", LENGTH, "heel_height", *LENGTHS)
    values = {name: measure_named(name).value_of(shape).value for name in names}
    measures = {
        name: Measure(name, Measured(value), measure_named(name).definition_id)
        for name, value in values.items()
    }
    labels = base.record.labels
    last = ZoneShape(base.record.extent_mm, base.record.flare, measures, labels.heel_height_mm)
    return (values["functional_length"] or shape.length_mm) + bottom_gain(last)[0]


def probe_of(shape: Shape, measure: str) -> Probe:
    """What answers for a measure when the shape changes a little."""
    vertices_mm, faces = shape.vertices_mm, shape.faces
    plane = tape_plane(shape, measure)
    if plane is not None:
        return girth_probe(vertices_mm, faces, plane.origin, plane.axes, plane.reach_mm)
    if measure == LENGTH:
        rear, front = shape.ends
        return span_probe(vertices_mm, rear.place, front.place, AXES[0])
    if measure == "ball_width":
        assert shape.mt1 is not None
        assert shape.mt5 is not None
        across = (shape.mt1 - shape.mt5) * LEVEL
        return span_probe(vertices_mm, shape.mt5, shape.mt1, across / np.linalg.norm(across))
    section = shape.across(WIDTHS.heel).points
    low = section[section[:, 1] < section[:, 1].min() + WIDTHS.height * shape.length_mm]
    ends = (low[np.argmin(low[:, 0])], low[np.argmax(low[:, 0])])
    lateral, medial = (np.array([shape.x_mm(WIDTHS.heel), *end]) for end in ends)
    return span_probe(vertices_mm, lateral, medial, AXES[1])


def values_mm(
    vertices_mm: Floats, faces: Ints, aims: Sequence[CustomAim], base: BaseLast
) -> Floats:
    """The aims' measures of a moved base, (aims,)."""
    shape = Shape(vertices_mm, faces, "last", base.shape.labels)
    return np.array([value_mm(shape, aim.measure, base) for aim in aims])
