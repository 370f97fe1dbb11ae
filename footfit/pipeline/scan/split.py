"""Two feet in one file: each as a source of its own."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.errors import FootfitError
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.one_shape import scans_in
from footfit.pipeline.scan.reading import read
from footfit.pipeline.scan.settled_unit import length_windows


def split_sources(sources: Sequence[Source], reading: ReadingOptions) -> list[Source]:
    """Each foot of each source, named ``both.stl#1``, ``both.stl#2``, largest first.

    A source with one foot stays as it is, and so does one that cannot be read: its own line says
    why.
    """
    return [part for source in sources for part in _parts(source, reading)]


def _parts(source: Source, reading: ReadingOptions) -> list[Source]:
    try:
        scan = read(source, reading)
        scans = scans_in(scan, length_windows(scan.info, reading.known_length_mm))
    except FootfitError:
        return [source]
    return [Source(each.info.path, scan=each) for each in scans] or [source]
