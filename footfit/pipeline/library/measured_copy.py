"""A stored last, measured again from its mesh copy, with the labels that say how it stands."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.flare.definition import FlareProfile
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.rotations import moved_points
from footfit.pipeline.scan.flare import shape_flare
from footfit.pipeline.scan.kept_sections import kept_sections
from footfit.pipeline.scan.measure import END_MEASURES, shape_measures
from footfit.pipeline.scan.preparation import level_turn, mirror_of, stored_shape
from footfit.pipeline.scan.standing import last_stance, stance_labels, stance_notices
from footfit.results import (
    LastRecord,
    LastStance,
    Measure,
    MeshCopy,
    Notice,
    ShapeSections,
    SideName,
)


@dataclass(frozen=True, slots=True)
class MeasuredCopy:
    """What is measured from a mesh copy; no ``flare`` if the stored profile is to stay.

    ``notices`` are those of its stance.
    """

    measures: tuple[Measure, ...]
    flare: FlareProfile | None
    sections: ShapeSections
    stance: LastStance | None
    standing_transform: Floats | None
    notices: tuple[Notice, ...]


def measured_copy(record: LastRecord, copy: MeshCopy, *, reprofile: bool = True) -> MeasuredCopy:
    """Measure a last again. Its total standard deviations hold how far the copy is from the scan.

    A last that an older version left rolled is turned level first, as a scan would be today.

    Raises
    ------
    CatalogueDamaged, HalfScan
        The copy is not sound, or does not show enough of the bottom.
    """
    vertices_mm, faces = stored_shape(copy.data, record.side.side)
    turn = level_turn(vertices_mm, faces) if record.pose.kind == "last" else np.eye(4)
    right = moved_points(turn, vertices_mm), faces
    shape = Shape(*right, record.pose.kind, stance_labels(record.labels))
    info = replace(record.info, step=copy.error_mm / record.info.unit_scale)
    measures = shape_measures(shape, info)
    if record.length_mm is None:  # an end was not scanned
        measures = tuple(
            replace(row, measured=record.length) if row.name in END_MEASURES else row
            for row in measures
        )
    return MeasuredCopy(
        measures=measures,
        flare=shape_flare(shape) if reprofile else None,
        sections=kept_sections(shape),
        stance=last_stance(shape, info),
        standing_transform=_standing(shape, turn, record.side.side),
        notices=stance_notices(shape),
    )


def _standing(shape: Shape, turn: Floats, side: SideName | None) -> Floats | None:
    """From the frame of the copy to that in which the last stands; None of a foot."""
    stands = None if shape.kind == "foot" else shape.standing_transform
    if stands is None:
        return None
    mirror = np.diag([*mirror_of(side), 1.0])  # the shape is a right one
    return np.asarray(stands @ mirror @ turn @ mirror)


def with_measured(record: LastRecord, new: MeasuredCopy) -> LastRecord:
    """A record with what was measured again; a profile says which definition it replaces."""
    record = replace(
        record,
        measures=new.measures,
        standing_transform=new.standing_transform,
        ground_sd_deg=None if new.stance is None else new.stance.ground_sd_deg,
        stance_by=None if new.stance is None else new.stance.decided_by,
    )
    if new.flare is None:
        return record
    old = record.flare.definition.version
    upgraded_from = record.upgraded_from if old == new.flare.definition.version else old
    return replace(record, flare=new.flare, upgraded_from=upgraded_from)
