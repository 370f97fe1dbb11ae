"""From a source to a scan, a prepared scan, an aligned scan, a profiled scan; or to its parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, cast

from footfit import results
from footfit.errors import BadOption, FootfitError, UnknownUnits, errors_at
from footfit.meshes.read import file_mesh
from footfit.meshes.units import check_unit_options
from footfit.pipeline.batch.phases import begin
from footfit.pipeline.batch.side_words import side_of_file
from footfit.pipeline.batch.sources import (
    ReadingOptions,
    Source,
    lies_beside_a_manifest,
    source_bytes,
)
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.cleaning import scan_of
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.one_shape import scans_in
from footfit.pipeline.scan.preparation import prepared_scan
from footfit.pipeline.scan.settled_unit import length_windows
from footfit.pipeline.scan.standing import check_stance_labels
from footfit.pipeline.scan.trueness import check_scanner

AS_FOUND = ReadingOptions()
ANY_LENGTH_MM = 250.0
"""What a shape of unknown scale is taken to be, to look at the shape alone."""


def read(source: Source, reading: ReadingOptions = AS_FOUND) -> results.Scan:
    """Read one mesh, whichever way it came: in mm, welded, cleaned, its faces outward.

    Raises
    ------
    InputError
        UnreadableFile, UnknownFormat, DamagedMesh, EmptyMesh, TooLarge or UnknownUnits.
    BadOption
        The options contradict each other, or the source's format.
    """
    if source.stored is not None:
        return stored_scan(profiled_source(source, reading))
    check_unit_options(reading.units, reading.known_length_mm)
    check_stance_labels(reading.stance_labels)
    check_scanner(reading.scanner)
    if source.scan is not None:
        return source.scan
    with errors_at(source.path):
        return _read(source, reading)


def _read(source: Source, reading: ReadingOptions) -> results.Scan:
    file = file_mesh(source_bytes(source), source.path, source.format)
    return scan_of(file, source.path, reading.units, reading.known_length_mm)


def prepared_source(source: Source, reading: ReadingOptions) -> results.PreparedScan:
    """Read and prepare one mesh; an error names its file.

    How a last of a run stands is taken from the run's manifest, if that lies beside the file. If no
    unit makes it as long as a foot, its shape is looked at first. Half a foot, a cube or two
    feet in one file is then refused for what it is, and only a foot or last for its unknown unit.
    """
    said: tuple[results.Notice, ...] = ()
    with errors_at(source.path):
        if source.said is not None or lies_beside_a_manifest(source):
            from footfit.pipeline.batch.run_manifest import as_said

            reading, said = as_said(source, reading)
        try:
            begin("reading")
            scan = read(source, reading)
        except UnknownUnits:
            prepared_scan(read(source, replace(reading, known_length_mm=ANY_LENGTH_MM)))
            raise
        side = cast(Literal["auto", "left", "right"], reading.side)
        scan = replace(scan, info=replace(scan.info, scanner=reading.scanner))
        kind = cast(Literal["auto", "foot", "last"], reading.kind)
        begin("pose")
        prepared = prepared_scan(
            scan,
            side,
            reading.known_length_mm,
            reading.stance_labels,
            force_side=reading.force_side,
            kind=kind,
        )
        begin("measures")
        prepared = replace(prepared, warnings=(*prepared.warnings, *said))
        return _with_name_checked(prepared)


def _with_name_checked(prepared: results.PreparedScan) -> results.PreparedScan:
    """A foot with a warning if its file's name says another side than the shape surely shows."""
    side, named = prepared.side, side_of_file(prepared.info.path)
    sure = side.source == "detected" and side.confidence == "sure" and prepared.pose.kind == "foot"
    if named is None or not sure or named == side.side:
        return prepared
    words = f"the name says {named}, but the shape is surely a {side.side} one: check the file"
    notice = results.Notice("side_name_differs", f"{words} (score {side.score:+.1f})")
    return replace(prepared, warnings=(*prepared.warnings, notice))


def aligned_source(
    source: Source,
    reading: ReadingOptions,
    method: results.Method = "footfit",
    reference: results.Reference | None = None,
) -> results.AlignedScan:
    """Read, prepare and align one mesh; of a stored last its copy."""
    if source.stored is not None:
        aligned = profiled_source(source, reading).aligned
        return aligned if method == "footfit" else aligned_scan(aligned.prepared, method, reference)
    return aligned_scan(prepared_source(source, reading), method, reference)


def profiled_source(source: Source, reading: ReadingOptions) -> results.Profiled:
    """Read, align, measure and profile one mesh; a stored last comes with its stored measures.

    Raises
    ------
    BadOption
        Options for reading a file are given for a stored last.
    """
    if source.stored is None:
        return profiled_scan(aligned_source(source, reading))
    with errors_at(source.path):
        shape = source.stored()
        if reading != AS_FOUND:
            raise BadOption(
                "is a last of the catalogue, whose unit, side and heel are stored: leave out the"
                " options that set them"
            )
        return shape


def stored_scan(shape: results.Profiled) -> results.Scan:
    """The mesh of a stored last as a scan: in mm, in the canonical frame."""
    aligned = shape.aligned
    alignment = aligned.alignment
    return results.Scan(alignment.info, aligned.vertices_mm, aligned.faces, alignment.warnings)


def split_sources(sources: Sequence[Source], reading: ReadingOptions) -> list[Source]:
    """Each foot of each source, named ``both.stl#1``, ``both.stl#2``, largest first.

    A source with one foot stays as it is, and so does one that cannot be read: its own line says
    why.
    """
    return [part for source in sources for part in _parts(source, reading)]


def _parts(source: Source, reading: ReadingOptions) -> list[Source]:
    if source.stored is not None:
        return [source]
    try:
        scan = read(source, reading)
        scans = scans_in(scan, length_windows(scan.info, reading.known_length_mm))
    except FootfitError:
        return [source]
    return [Source(each.info.path, scan=each) for each in scans] or [source]
