"""Measure: from an aligned mesh, or a source, to its measures and what is hardly right of them."""

from __future__ import annotations

from collections.abc import Iterable

from footfit.errors import SideUndecided
from footfit.geometry.measures import MEASURES, unusual
from footfit.pipeline.flare import measured, right_shape
from footfit.pipeline.reading import aligned_source
from footfit.pipeline.sources import ReadingOptions, Source
from footfit.results import AlignedScan, Measure, MeasuredScan, Notice


def measured_scan(aligned: AlignedScan) -> MeasuredScan:
    """Measure an aligned mesh; a left one as its mirror image.

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is: the joints would be the wrong ones.
    """
    alignment = aligned.alignment
    if alignment.side.side is None:
        raise SideUndecided(
            "the shape does not tell left from right: say --side left or --side right",
            alignment.info.path,
        )
    measures = measured(*right_shape(aligned), alignment.pose.kind)
    return MeasuredScan(alignment, measures, suspects(measures, alignment.pose.kind))


def measured_source(source: Source, reading: ReadingOptions) -> MeasuredScan:
    """Read, align and measure one mesh."""
    return measured_scan(aligned_source(source, reading))


def suspects(measures: Iterable[Measure], kind: str) -> tuple[Notice, ...]:
    """A warning for each value of a foot that is outside what a survey's people have.

    The value stays: a foot may be unusual. A last is no foot; its values are never suspect.
    """
    values = {row.name: row.measured.value for row in measures}
    length_mm = values.get("length")
    if kind != "foot" or length_mm is None:
        return ()
    found = []
    for entry in MEASURES:
        value = values.get(entry.name)
        words = None if value is None else unusual(entry, value, length_mm)
        if words is not None:
            found.append(Notice("suspect_measure", words))
    return tuple(found)
