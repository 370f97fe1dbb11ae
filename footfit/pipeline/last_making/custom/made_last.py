"""A custom last as its file has it: written, and read again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from footfit import results
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import moved_points
from footfit.geometry.search.pose_search import RoughPose
from footfit.meshes.write import encoded_mesh
from footfit.number_words import plain
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_reading import gain_mm, value_mm
from footfit.pipeline.last_making.tolerances import TOLERANCE_MM
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.preparation import mirror_of, prepared_scan, right_copy
from footfit.pipeline.scan.reading import read
from footfit.pipeline.scan.standing import heights_by_shape, stance_labels
from footfit.results import LastLabels, PreparedScan, SideName

HEEL = "heel_height"


@dataclass(frozen=True)
class MadeLast:
    """A custom last as its file has it.

    ``prepared`` is the file as it was read again, ``vertices_mm`` and ``faces`` are those of the
    file; ``frame`` (4, 4) takes right vertices of the base's frame to the shape's canonical right
    frame.
    """

    base: BaseLast
    prepared: PreparedScan
    labels: LastLabels
    vertices_mm: Floats
    faces: Ints
    frame: Floats

    @property
    def shape(self) -> Shape:
        """The right shape."""
        return self.prepared.shape

    @cached_property
    def record(self) -> results.LastRecord:
        """The record, with every measure and the flare."""
        return last_record(profiled_scan(aligned_scan(self.prepared)), self.labels)

    @cached_property
    def gain_mm(self) -> float:
        """How much longer it is along its bottom than along its length."""
        return gain_mm(self.shape, self.base)

    @cached_property
    def with_sections(self) -> BaseLast:
        """The base with the sections of this last: what a fit reads."""
        return replace(self.base, sections=kept_sections(self.shape))

    def value_mm(self, measure: str) -> float:
        """A measure as :func:`custom_reading.value_mm` reads it."""
        return value_mm(self.shape, measure, self.base, self.gain_mm)

    @property
    def to_file(self) -> Floats:
        """From the shape's canonical right frame to the axes of the file, (4, 4)."""
        return np.asarray(_mirror(self.prepared.side.side) @ np.linalg.inv(self.frame))

    def lying(self, vertices_mm: Floats) -> Floats:
        """Right vertices (n, 3) of the base's frame in the last's canonical frame."""
        return moved_points(self.frame, vertices_mm)


def made_last(base: BaseLast, vertices_mm: Floats, side: SideName, name: str) -> MadeLast:
    """The right vertices (n, 3) of a changed base as a last of one side, read again from its file.

    The pose is known, so it is not searched for, and it is a last, whatever its shape is near to.
    The labels of how the base stands stay.
    """
    vertices_mm, faces = right_copy(vertices_mm, base.shape.faces, side)
    data = encoded_mesh(vertices_mm, faces, "stl")
    scan = read(Source(None, data), ReadingOptions(units="mm"))
    quality = base.record.pose
    length_mm = base.shape.length_mm
    pose = RoughPose(
        np.eye(3), np.zeros(3), length_mm, quality.cost, quality.margin, "last", accepted=True
    )
    old = base.record.labels
    labels = LastLabels(
        name,
        style=old.style,
        family=old.family,
        heel_height_mm=old.heel_height_mm,
        toe_spring_mm=old.toe_spring_mm,
        platform_mm=old.platform_mm,
    )
    prepared = prepared_scan(
        replace(scan, pose=pose), side, labels=stance_labels(labels), kind="last"
    )
    mirror = _mirror(side)
    frame = mirror @ prepared.canonical_transform @ mirror
    return MadeLast(base, prepared, labels, vertices_mm, faces, np.asarray(frame, np.float64))


def heel_notices(made: MadeLast) -> tuple[results.Notice, ...]:
    """A warning if the written file, read without the labels of the base, has another heel.

    The file has no labels, so a command that reads it needs them.
    """
    labels = made.labels
    given = {
        "--heel-height": labels.heel_height_mm,
        "--toe-spring": labels.toe_spring_mm,
        "--platform": labels.platform_mm or None,
    }
    options = " ".join(f"{name} {mm:g}" for name, mm in given.items() if mm is not None)
    by_shape_mm = heights_by_shape(made.shape.stance).get(HEEL)
    reached = {each.name: each.measured.value for each in made.record.measures}.get(HEEL)
    if not options or by_shape_mm is None or reached is None:
        return ()
    if abs(by_shape_mm - reached) <= TOLERANCE_MM["height"]:
        return ()
    words = (
        f"without the label of the base, the heel of the written file reads {plain(by_shape_mm)} mm"
        f" high and not {plain(reached)} mm"
    )
    advice = f"give its heel height with the file ({options})"
    if labels.heel_height_mm is None:
        advice = f"give its toe spring with the file ({options})"
    return (results.Notice("heel_by_label", f"{words}: {advice}"),)


def _mirror(side: SideName | None) -> Floats:
    """What takes a right shape to one of a side, and back, (4, 4)."""
    return np.diag([*mirror_of(side), 1.0])
