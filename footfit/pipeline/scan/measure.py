"""Measure: from an aligned mesh, or a source, to its measures and what is hardly right of them."""

from __future__ import annotations

from collections.abc import Iterable

from footfit.geometry.measures.measure_table import MEASURES, unusual
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.flare import believed, check_side, measured
from footfit.pipeline.scan.reading import aligned_source
from footfit.results import AlignedScan, Measure, MeasuredScan, Notice


def measured_scan(aligned: AlignedScan) -> MeasuredScan:
    """Measure an aligned mesh; a left one as its mirror image.

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    """
    alignment = aligned.alignment
    check_side(alignment)
    measures = measured(aligned.prepared.vertices_mm, aligned.prepared.faces, alignment.pose.kind)
    measures = believed(measures, alignment.warnings)
    return MeasuredScan(alignment, measures, suspects(measures, alignment.pose.kind))


def measured_source(source: Source, reading: ReadingOptions) -> MeasuredScan:
    """Read, align and measure one mesh."""
    return measured_scan(aligned_source(source, reading))


STEEPEST_HEEL = 0.30
"""Heel height over length: a last steeper than this may come to rest on its shank."""


def suspects(measures: Iterable[Measure], kind: str) -> tuple[Notice, ...]:
    """A warning for each value of a foot that is outside what a survey's people have.

    The value stays: a foot may be unusual. A last is no foot: of its values only a heel is
    suspect that is steeper than the frame was tried on.
    """
    values = {row.name: row.measured.value for row in measures}
    length_mm = values.get("length")
    if length_mm is None:
        return ()
    if kind != "foot":
        return steep_heel(values.get("heel_height"), length_mm)
    found = []
    for entry in MEASURES:
        value = values.get(entry.name)
        words = None if value is None else unusual(entry, value, length_mm)
        if words is not None:
            found.append(Notice("suspect_measure", words))
    return tuple(found)


def steep_heel(heel_mm: float | None, length_mm: float) -> tuple[Notice, ...]:
    """What to say of a last that may rest on its shank instead of on its ball and its seat.

    Examples
    --------
    >>> steep_heel(50.0, 250.0)
    ()
    >>> print(steep_heel(80.0, 250.0)[0].message)
    heel height 80.0 mm is 0.32 of the length: above 0.30 check length and flare on the last itself
    """
    share = 0.0 if heel_mm is None else heel_mm / length_mm
    if heel_mm is None or share <= STEEPEST_HEEL:
        return ()
    words = (
        f"heel height {heel_mm:.1f} mm is {share:.2f} of the length: above {STEEPEST_HEEL:.2f}"
        " check length and flare on the last itself"
    )
    return (Notice("steep_heel", words),)
