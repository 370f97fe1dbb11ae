"""Compare: one foot laid into one last, surface against surface and section by section."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.geometry.fit.clearance import ZoneClearance, foot_clearance, zone_clearances
from footfit.geometry.fit.paired_sections import SectionPair, SectionSizes, section_pairs
from footfit.geometry.fit.placement import Docking, docked, docking
from footfit.geometry.measures import measure_table
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import Reading
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.copies.compact_copy import expanded
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.library.ingest import last_record
from footfit.pipeline.scan.flare import as_right, right_shape
from footfit.pipeline.scan.reading import profiled_source
from footfit.results import (
    Comparison,
    LastLabels,
    LastRecord,
    Match,
    Measured,
    Notice,
    Profiled,
    SectionComparison,
    SizeDifference,
)

SIZES = ("width", "medial", "lateral", "height", "girth")
"""What is compared of each section, in this order."""
SD_FROM = {
    "width": "heel_width",
    "medial": "heel_width",
    "lateral": "heel_width",
    "height": "instep_height",
    "girth": "instep_girth",
}
"""The measure whose repeatability a section's size has: it is taken the same way."""


@dataclass(frozen=True, slots=True)
class LastShape:
    """A last to compare with: what is known of it, and its mesh, canonical mm, on its own side."""

    record: LastRecord
    vertices_mm: Floats
    faces: Ints


def stored_last(path: Path, name: str) -> LastShape:
    """A last of the catalogue with its mesh copy.

    Raises
    ------
    NoCatalogue, UnknownLast, CatalogueDamaged
        It is not there, or its copy is not sound.
    """
    with open_catalogue(path) as catalogue:
        return LastShape(catalogue.record(name), *expanded(catalogue.mesh_copy(name).data))


def scanned_last(source: Source, reading: ReadingOptions) -> LastShape:
    """A last that stands in a file of its own; its name is the file's.

    Raises
    ------
    InputError, GeometryRefused
        As in reading, aligning and profiling any last.
    """
    shape = profiled_source(source, reading)
    name = Path(source.path or "last").stem
    return LastShape(
        last_record(shape, LastLabels(name)), shape.aligned.vertices_mm, shape.aligned.faces
    )


@dataclass(frozen=True, slots=True)
class Laid:
    """A foot in a last, both right shapes in the last's frame: the way it went in, the room (n,)
    at its vertices, and the room by zone.
    """

    inside: Shape
    around: Shape
    way: Docking
    room_mm: Floats
    zones: tuple[ZoneClearance, ...]


def laid(foot: Profiled, last: LastShape) -> Laid:
    """Lay a foot into a last.

    Raises
    ------
    NoSole
        One of the two has no bottom to rest on.
    """
    around = Shape(*as_right(last.vertices_mm, last.faces, last.record.side.side), "last")
    vertices_mm, faces = right_shape(foot.aligned)
    way = docking(Shape(vertices_mm, faces, "foot"), around)
    inside = Shape(docked(vertices_mm, way), faces, "foot")
    room_mm = foot_clearance(inside, around)
    return Laid(inside, around, way, room_mm, zone_clearances(inside, room_mm))


def compared(foot: Profiled, last: LastShape) -> Comparison:
    """Lay a foot into a last and measure the room around it, surface and sections.

    Raises
    ------
    NoSole
        One of the two has no bottom to rest on.
    """
    found = laid(foot, last)
    return Comparison(
        foot=foot,
        last=last.record,
        mirrored=last.record.side.side != foot.aligned.alignment.side.side,
        docking=found.way,
        vertices_mm=found.inside.vertices_mm,
        faces=found.inside.faces,
        last_vertices_mm=found.around.vertices_mm,
        last_faces=found.around.faces,
        room_mm=found.room_mm,
        zones=found.zones,
        sections=tuple(_section(pair) for pair in section_pairs(found.inside, found.around)),
        warnings=_warnings(foot, last.record),
    )


def best_comparison(path: Path, match: Match, foot: int = 0) -> Comparison | None:
    """One foot of a match in its best last, or in the nearest where none fits; None where the
    catalogue has no sound copy of that last, or the two have no bottom in common.
    """
    from footfit.errors import CatalogueDamaged, NoSole, UnknownLast

    lasts = match.candidates or match.nearest
    if not lasts:
        return None
    try:
        return compared(match.feet[foot], stored_last(path, lasts[0].last))
    except (CatalogueDamaged, NoSole, UnknownLast):
        return None


def _warnings(foot: Profiled, last: LastRecord) -> tuple[Notice, ...]:
    notices = list(foot.aligned.alignment.warnings)
    if not foot.aligned.alignment.pose.sole:
        words = (
            "the foot's scan has no sole: the room under it and its height are not to be trusted"
        )
        notices.append(Notice("no_sole", words))
    longer = last.extent_mm - foot.aligned.alignment.extent_mm
    if foot.length_mm is not None and last.length_mm is not None:
        longer = last.length_mm - foot.length_mm
    if abs(longer) > FAR_MM:
        words = f"the last is {abs(longer):.0f} mm {'longer' if longer > 0 else 'shorter'}"
        notices.append(Notice("far_size", f"{words} than the foot: no shoe for it in any zone"))
    return tuple(notices)


FAR_MM = 40.0
"""Six sizes: what is compared then says nothing of a fit."""


# ---------------------------------------------------------------- sections


def _section(pair: SectionPair) -> SectionComparison:
    return SectionComparison(
        station=pair.station.name,
        x_mm=pair.x_mm,
        foot_outline=pair.foot.loops,
        last_outline=pair.last.loops,
        sizes=tuple(_size(name, pair.foot_sizes, pair.last_sizes) for name in SIZES),
    )


def _size(name: str, foot: SectionSizes, last: SectionSizes) -> SizeDifference:
    sd = repeatability_mm(name)
    here, there = (_measured(getattr(sizes, name), sd) for sizes in (foot, last))
    if here.value is None or there.value is None:
        reason = here.reason if here.value is None else there.reason
        return SizeDifference(name, here, there, Measured(None, reason=reason))
    room = there.value - here.value
    if name == "lateral":  # + is room here too: the last's edge lies further out, at -Y
        room = -room
    return SizeDifference(name, here, there, Measured(room, math.hypot(sd, sd)))


def _measured(reading: Reading, sd: float) -> Measured:
    if reading.value is None:
        return Measured(None, reason=reading.reason)
    return Measured(reading.value, sd)


def repeatability_mm(size: str) -> float:
    """The standard deviation of a section's size between two scans of one shape."""
    known = {measure.name: measure.sd for measure in measure_table.MEASURES}
    return known[SD_FROM[size]]
