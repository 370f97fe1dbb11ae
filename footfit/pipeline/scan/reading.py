"""From a source to a scan, an aligned scan, a profiled scan."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from typing import Literal, cast

from footfit.errors import UnknownUnits
from footfit.meshes.file_bytes import file_bytes
from footfit.meshes.read import scan_from_bytes
from footfit.meshes.read_limits import LIMITS
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.align import aligned
from footfit.pipeline.scan.curvature import surface_curvature
from footfit.pipeline.scan.flare import profiled
from footfit.results import AlignedScan, Method, Profiled, Reference, Scan, SurfaceCurvature

ANY_LENGTH_MM = 250.0
"""What a shape of unknown scale is taken to be, to look at the shape alone."""


def source_bytes(source: Source) -> bytes:
    """The bytes of a source, behind the guards of ``meshes.read``."""
    return source.data if source.data is not None else file_bytes(source.path or "", LIMITS)


def content_hash(source: Source) -> str:
    """SHA-256 of the source's bytes: what a last is known by."""
    return hashlib.sha256(source_bytes(source)).hexdigest()


def read(source: Source, reading: ReadingOptions) -> Scan:
    """Read one mesh, whichever way it came."""
    return scan_from_bytes(
        source_bytes(source),
        path=source.path,
        format=source.format,
        units=reading.units,
        known_length_mm=reading.known_length_mm,
    )


def aligned_source(
    source: Source,
    reading: ReadingOptions,
    method: Method = "footfit",
    reference: Reference | None = None,
) -> AlignedScan:
    """Read and align one mesh.

    Where no unit makes it a foot's length, its shape is asked first: half a foot, a cube or two
    feet in one file is refused as what it is, and only a foot or last as of an unknown unit.
    """
    try:
        scan = read(source, reading)
    except UnknownUnits:
        aligned(read(source, replace(reading, known_length_mm=ANY_LENGTH_MM)))
        raise
    return aligned(
        scan,
        method=method,
        side=cast(Literal["auto", "left", "right"], reading.side),
        reference=reference,
        known_length_mm=reading.known_length_mm,
    )


def profiled_source(source: Source, reading: ReadingOptions) -> Profiled:
    """Read, align, measure and profile one mesh."""
    return profiled(aligned_source(source, reading))


def curvature_source(
    source: Source, reading: ReadingOptions, radius_mm: float | None, output: str | None = None
) -> SurfaceCurvature:
    """Read one mesh and estimate its curvature at a scale; None is the default scale.

    ``output`` is the name of the file that will hold the values, for the document.
    """
    return replace(surface_curvature(read(source, reading), radius_mm), output=output)
