"""Measure: from an aligned scan to its measures, with a warning for each that is hardly right."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from footfit.errors import SideUndecided, UnknownUnits
from footfit.geometry.flare.definition import flare_class
from footfit.geometry.measures import measure_table
from footfit.geometry.measures.landmarks import Shape
from footfit.meshes.units import UNIT_NAMES, UNIT_SCALES
from footfit.number_words import plain
from footfit.pipeline.scan.settled_unit import length_notices
from footfit.pipeline.scan.trueness import measured
from footfit.results import (
    AlignedScan,
    Alignment,
    LastLabels,
    LastRecord,
    Measure,
    MeasuredScan,
    MeshInfo,
    Notice,
    PreparedScan,
    Profiled,
)

_ALONG_X = ("length", "functional_length", "tape_length", "ball_length")
_ALONG_THE_GROUND = ("stick_length", "bottom_length", "tread_from", "tread_to")
CHILD_MM = 200.0
"""A shorter foot may be a child's; a fit profile for shorter feet is for children."""
END_MEASURES = frozenset((*_ALONG_X, *_ALONG_THE_GROUND))
"""What is counted from the pternion or to the toes."""


def measured_scan(aligned: AlignedScan) -> MeasuredScan:
    """Measure an aligned scan; a left one as its mirror image.

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    """
    check_side(aligned.alignment)
    return measured_shape(aligned.alignment, scan_measures(aligned.prepared))


def measured_shape(alignment: Alignment, measures: tuple[Measure, ...]) -> MeasuredScan:
    """The measures of a shape, with a warning for each that is hardly right."""
    return MeasuredScan(alignment, measures, unusual_measures(measures, _likely_kind(alignment)))


def _likely_kind(alignment: Alignment) -> str:
    """The kind whose usual measures count: without a sole nothing is sure, and it may be a foot."""
    return alignment.pose.kind if alignment.pose.sole else "foot"


def check_side(alignment: Alignment) -> None:
    """Refuse a shape whose side is undecided: its medial side would be the wrong one.

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    """
    if alignment.side.side is None:
        words = "the shape does not show which side it is: give --side left or --side right"
        raise SideUndecided(words, alignment.info.path)


def scan_measures(prepared: PreparedScan) -> tuple[Measure, ...]:
    """Every measure of a prepared scan, in the table's order.

    If an end was not scanned, the measures that end there have the reason instead of a value that
    would be too short.
    """
    rows = shape_measures(prepared.shape, prepared.info)
    if prepared.length.value is not None:
        return rows
    return tuple(
        replace(row, measured=prepared.length) if row.name in END_MEASURES else row for row in rows
    )


def shape_measures(shape: Shape, info: MeshInfo | None = None) -> tuple[Measure, ...]:
    """Every measure of the table that a kind of shape has, on a canonical right shape.

    Parameters
    ----------
    shape : Shape
    info : MeshInfo, optional
        What is known of its scan: it adds to the total standard deviations.

    Returns
    -------
    tuple of Measure
        In the table's order; one that cannot be taken has a reason instead of a value.
    """
    kind = shape.kind
    return tuple(
        Measure(
            entry.name,
            measured(entry, entry.with_tilt(shape), kind, shape.shape_heel_mm, info),
            entry.definition_id,
        )
        for entry in measure_table.of_kind(kind)
    )


def for_feet_of(scan: MeasuredScan, usual_length_mm: tuple[float, float]) -> MeasuredScan:
    """A measured scan with the warnings for feet of these lengths, such as children's."""
    kind = _likely_kind(scan.alignment)
    return replace(
        scan,
        alignment=usual_alignment(scan.alignment, usual_length_mm),
        unusual=unusual_measures(scan.measures, kind, usual_length_mm),
    )


def usual_alignment(alignment: Alignment, usual_length_mm: tuple[float, float]) -> Alignment:
    """An alignment without the warning of a length that is usual for feet of these lengths.

    Raises
    ------
    UnknownUnits
        The unit was detected, and in another unit the length is usual for these feet.
    """
    low, high = usual_length_mm
    _refuse_other_unit(alignment, low, high)
    if alignment.length_mm is None or not low <= alignment.length_mm <= high:
        return alignment
    kept = (notice for notice in alignment.warnings if notice.code != "length_unusual")
    return replace(alignment, warnings=tuple(kept))


def _refuse_other_unit(alignment: Alignment, low_mm: float, high_mm: float) -> None:
    """Ask for the unit if a length is usual in a unit that was not detected, and not in that one:
    a child's foot of 12.5 cm is as long as a man's of 12.5 inches.
    """
    info, length_mm = alignment.info, alignment.length_mm
    if info.units_source != "detected" or length_mm is None or low_mm <= length_mm <= high_mm:
        return
    number = length_mm / UNIT_SCALES[info.units]
    for name, scale in UNIT_SCALES.items():
        if low_mm <= number * scale <= high_mm:
            words = (
                f"is {plain(length_mm)} mm long in {UNIT_NAMES[info.units]}, and"
                f" {plain(number * scale)} mm in {UNIT_NAMES[name]}. The profile is for feet of"
                f" {low_mm:.0f}-{high_mm:.0f} mm: give --units {name} or --units {info.units}"
            )
            raise UnknownUnits(words, info.path)


def unusual_measures(
    measures: Iterable[Measure], kind: str, usual_length_mm: tuple[float, float] | None = None
) -> tuple[Notice, ...]:
    """A warning for each value of a foot that is outside the range of a survey's people.

    The value stays, because a foot may be unusual. Of a last there is no such range. The survey's
    people are adults: for feet of other lengths only the length is compared. A length outside of
    the range that the alignment warns of gets no second warning.
    """
    values = {row.name: row.measured.value for row in measures}
    length_mm = values.get("length")
    if length_mm is None or kind != "foot":
        return ()
    if usual_length_mm is not None:
        low, high = usual_length_mm
        if low <= length_mm <= high:
            return ()
        message = f"length {length_mm:.1f} mm is unusual; feet of this profile have"
        return (Notice("suspect_measure", f"{message} {low:.0f}-{high:.0f} mm"),)
    if length_notices(length_mm):
        del values["length"]
    known = ((entry, values.get(entry.name)) for entry in measure_table.MEASURES)
    words = (
        measure_table.unusual(entry, value, length_mm)
        for entry, value in known
        if value is not None
    )
    said = [message for message in words if message is not None]
    if length_mm < CHILD_MM:
        said.append("is this a child's foot? add --profile child")
    return tuple(Notice("suspect_measure", message) for message in said)


def last_record(shape: Profiled, labels: LastLabels) -> LastRecord:
    """The record of a profiled shape; the catalogue will keep its file's name, but no folder."""
    alignment = shape.aligned.alignment
    kind = alignment.pose.kind
    flare = shape.flare
    # A doubt of the kind is settled: it is stored as a last.
    kept = (notice for notice in alignment.warnings if notice.code != "kind_doubtful")
    notices = (*kept, *shape.unusual)
    if kind == "foot":
        looks = Notice("looks_like_a_foot", "its shape is nearer to a foot's than to a last's")
        notices = (*notices, looks)
        name = flare_class(flare.angle_deg, "last", flare.definition)
        flare = replace(flare, flare_class=name)
    return LastRecord(
        labels=labels,
        info=alignment.info,
        side=alignment.side,
        pose=replace(alignment.pose, kind_confidence=None),
        eigenframe=alignment.eigenframe,
        printed_frame=alignment.printed_frame,
        canonical_transform=alignment.canonical_transform,
        paper_transform=None,
        extent_mm=alignment.extent_mm,
        flare=flare,
        measures=shape.measures,
        warnings=notices,
        standing_transform=alignment.standing_transform if kind == "last" else None,
        ground_sd_deg=None if alignment.stance is None else alignment.stance.ground_sd_deg,
        stance_by=None if alignment.stance is None else alignment.stance.decided_by,
    )
