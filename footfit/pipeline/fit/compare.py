"""Compare: one foot in one last, surface against surface and section by section."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

from footfit import results
from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged, NoSole, UnknownLast, errors_at
from footfit.geometry.fit.clearance import ZoneClearance, foot_clearance, zone_clearances
from footfit.geometry.fit.foot_in_heel import foot_in_heel
from footfit.geometry.fit.paired_sections import SIZES, SectionPair, section_pairs
from footfit.geometry.fit.placement import Placement, placed, placement
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.numeric.arrays import Floats
from footfit.locations import Location
from footfit.number_words import plain
from footfit.pipeline.batch.run_manifest import said_notices, with_said
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.fit.heels import Heels, heel_change, heels_of, share_sd, surface_change
from footfit.pipeline.fit.judging.clearances import measured_clearances, toe_room
from footfit.pipeline.fit.worn_shifts import with_unknown_load
from footfit.pipeline.scan.measure import last_record
from footfit.pipeline.scan.preparation import stored_shape
from footfit.pipeline.scan.reading import profiled_source
from footfit.pipeline.scan.standing import stance_notices
from footfit.results.compare import comparison_nouns

SD_FROM = {
    "width": "heel_width",
    "medial": "heel_width",
    "lateral": "heel_width",
    "height": "instep_height",
}
"""The measure that is taken like a section's size, and so has the same repeatability."""
HEEL_SD_FROM = {
    "width": "ball_width",
    "medial": "ball_width",
    "lateral": "ball_width",
    "height": "arch_height",
}
"""The rule of the heel model whose standard deviation a section's size of the foot has."""
FAR_MM = 40.0
"""Six sizes: with such a difference a comparison says nothing of a fit."""


@dataclass(frozen=True, slots=True)
class LastShape:
    """A last to compare with: its record, and its right shape, canonical mm, holes closed."""

    record: results.LastRecord
    shape: Shape


def stored_last(path: Location, name: str) -> LastShape:
    """A last of the catalogue with its mesh copy.

    Raises
    ------
    NoCatalogue, UnknownLast, CatalogueDamaged
        It is not there, or its copy is not sound.
    """
    with open_catalogue(path) as catalogue:
        record = catalogue.record(name)
        mesh = stored_shape(catalogue.mesh_copy(name).data, record.side.side)
        return LastShape(record, Shape(*mesh, "last"))


def scanned_last(source: Source, reading: ReadingOptions, nameless: str = "last") -> LastShape:
    """A last in a file of its own; its name is the file's, ``reading`` says how it stands.

    Its other labels are those of the run's manifest beside it. What comes from no file has the name
    ``nameless``.

    Raises
    ------
    InputError, GeometryRefused
        As in reading, aligning and profiling any last.
    """
    source = with_said(source)
    shape = profiled_source(source, reading)
    row = None if source.said is None else source.said.row
    own = results.LastLabels("") if row is None else row.labels
    stands = shape.aligned.prepared.shape.labels
    labels = replace(
        own,
        name=Path(source.path or nameless).stem,
        heel_height_mm=stands.heel_height_mm,
        toe_spring_mm=stands.toe_spring_mm,
        platform_mm=stands.platform_mm or None,
    )
    record = last_record(shape, labels)
    return LastShape(record, replace(shape.aligned.prepared.shape, kind="last"))


@dataclass(frozen=True, slots=True)
class PlacedFoot:
    """A foot in the last's frame, a right shape, with the ``clearance_mm`` (n,) at its vertices
    and the clearance by zone.
    """

    foot: Shape
    placement: Placement
    clearance_mm: Floats
    zones: tuple[ZoneClearance, ...]


def placed_foot(foot: results.Profiled, last: LastShape, heels: Heels) -> PlacedFoot:
    """A foot, placed in a last as it is in the last's heel, which is the first of ``heels``.

    Raises
    ------
    NoSole
        One of the two has no bottom to rest on.
    """
    vertices_mm, faces = foot.aligned.prepared.vertices_mm, foot.aligned.prepared.faces
    if heels.share[0]:
        vertices_mm = foot_in_heel(Shape(vertices_mm, faces), surface_change(heels, 0))
    place = placement(Shape(vertices_mm, faces), last.shape)
    inside = Shape(placed(vertices_mm, place), faces)
    clearance_mm = foot_clearance(inside, last.shape)
    return PlacedFoot(inside, place, clearance_mm, zone_clearances(inside, clearance_mm))


def compared(
    foot: results.Profiled, last: LastShape, heel: results.HeelQuestion | None = None
) -> results.Comparison:
    """Place a foot in a last and measure the clearance around it, by surface and by section.

    Without a ``heel`` question the foot was scanned flat, and is taken as it is in the last's heel.
    A last in place of the foot has its own heel: it is compared as it is.

    Raises
    ------
    NoSole
        One of the two has no bottom to rest on.
    """
    asked = heel_question(as_scanned=True) if foot.is_last else heel or heel_question()
    heels = heels_of(asked, [last.record])
    with errors_at(foot.aligned.alignment.info.path):
        inside = placed_foot(foot, last, heels)
    pairs = section_pairs(inside.foot, last.shape)
    measures = foot.measures, last.record.measures
    room = with_unknown_load(toe_room(foot, last.record, heels), "length", measures)
    return results.Comparison(
        foot=foot,
        last=last.record,
        mirrored=last.record.side.side != foot.aligned.alignment.side.side,
        placement=inside.placement,
        vertices_mm=inside.foot.vertices_mm,
        faces=inside.foot.faces,
        last_vertices_mm=last.shape.vertices_mm,
        last_faces=last.shape.faces,
        clearance_mm=inside.clearance_mm,
        zones=inside.zones,
        sections=tuple(_section(pair, heels) for pair in pairs),
        warnings=(
            *_unused_heel(foot, heel),
            *_warnings(foot, last.record, room),
            *said_notices(last.record.warnings, last.record.info.path),
            *stance_notices(last.shape),
        ),
        toe_room=room,
        measured_clearance=tuple(
            (name, with_unknown_load(clearance, name, measures))
            for name, clearance in measured_clearances(foot, last.record, heels)
        ),
        heel=heel_change(heels, 0, foot),
    )


def best_comparison(
    path: Location, match: results.Match, foot: int = 0
) -> results.Comparison | None:
    """One foot of a match in its best last, or in the nearest if none fits.

    None if the catalogue has no sound copy of that last, or the two share no bottom to rest on.
    """
    lasts = match.candidates or match.nearest
    if not lasts:
        return None
    try:
        return compared(match.feet[foot], stored_last(path, lasts[0].last), match.heel)
    except (CatalogueDamaged, NoSole, UnknownLast):
        return None


def _unused_heel(
    foot: results.Profiled, heel: results.HeelQuestion | None
) -> tuple[results.Notice, ...]:
    """A drop in the scanner that is given for a last in the foot's place."""
    if not foot.is_last or heel is None or not heel.scanned_at_drop_mm:
        return ()
    words = "the drop in the scanner is of no use: the first shape is a last, with its own heel"
    return (results.Notice("scanned_at_drop_unused", words),)


def _warnings(
    foot: results.Profiled, last: results.LastRecord, room: results.Measured
) -> tuple[results.Notice, ...]:
    notices = list(foot.aligned.alignment.warnings)
    first, second = comparison_nouns(foot)
    if not foot.aligned.alignment.pose.sole:
        words = (
            f"the {first}'s scan has no sole: do not trust the clearance under it, nor its height"
        )
        notices.append(results.Notice("no_sole", words))
    longer = last.extent_mm - foot.aligned.alignment.extent_mm if room.value is None else room.value
    if abs(longer) > FAR_MM:
        words = f"the {second} is {plain(abs(longer))} mm {'longer' if longer > 0 else 'shorter'}"
        notices.append(results.Notice("far_size", f"{words} than the {first}: it fits in no zone"))
    return tuple(notices)


# ---------------------------------------------------------------- the lasts of an answer


def with_surface_clearance(match: results.Match, path: Location) -> results.Match:
    """The same answer with the clearance in each last that it shows.

    It needs the lasts' meshes, which ranking does not read. So it is taken only if it is asked
    for, and only of the lasts that are shown. It judges nothing.
    """
    return replace(
        match,
        candidates=tuple(_with_clearance(last, match, path) for last in match.candidates),
        nearest=tuple(_with_clearance(last, match, path) for last in match.nearest),
    )


def _with_clearance(
    candidate: results.Candidate, match: results.Match, path: Location
) -> results.Candidate:
    try:
        last = stored_last(path, candidate.last)
    except (CatalogueDamaged, UnknownLast) as error:
        surfaces = tuple(_unknown(foot, str(error)) for foot in match.feet)
    else:
        surfaces = tuple(surface_clearance(foot, last, match.heel) for foot in match.feet)
    return replace(candidate, surfaces=surfaces)


def surface_clearance(
    foot: results.Profiled, last: LastShape, heel: results.HeelQuestion
) -> results.SurfaceClearance:
    """The clearance by zone of one foot in one last, as ``compare`` says it."""
    try:
        inside = placed_foot(foot, last, heels_of(heel, [last.record]))
    except NoSole as error:
        return _unknown(foot, str(error))
    side = foot.aligned.alignment.side.side
    return results.SurfaceClearance(side, inside.placement.swing_mm, inside.zones)


def _unknown(foot: results.Profiled, reason: str) -> results.SurfaceClearance:
    return results.SurfaceClearance(foot.aligned.alignment.side.side, None, (), reason)


# ---------------------------------------------------------------- sections


def _section(pair: SectionPair, heels: Heels) -> results.SectionComparison:
    sizes = (_size(name, pair.foot_sizes[name], pair.last_sizes[name], heels) for name in SIZES)
    return results.SectionComparison(
        station=pair.station.name,
        x_mm=pair.x_mm,
        foot_outline=pair.foot.loops,
        last_outline=pair.last.loops,
        sizes=tuple(sizes),
    )


def _size(
    name: str, foot: MeasureValue, last: MeasureValue, heels: Heels
) -> results.SizeDifference:
    """One size of a section; + is space, so a lateral edge's difference is towards -Y."""
    sd = repeatability_mm(name)
    model_sd = share_sd(heels, 0, HEEL_SD_FROM[name]) * abs(foot.value or 0.0)
    here, there = _measured(foot, math.hypot(sd, model_sd)), _measured(last, sd)
    if here.value is None or there.value is None:
        reason = here.reason if here.value is None else there.reason
        return results.SizeDifference(name, here, there, results.Measured(None, reason=reason))
    more = there.value - here.value
    outward = -more if name == "lateral" else more
    spread = math.hypot(sd, sd, model_sd)
    return results.SizeDifference(name, here, there, results.Measured(outward, spread))


def _measured(value: MeasureValue, sd: float) -> results.Measured:
    return results.Measured(value.value, None if value.value is None else sd, value.reason)


def repeatability_mm(size: str) -> float:
    """The standard deviation of a section's size between two scans of one shape."""
    return measure_named(SD_FROM[size]).sd
