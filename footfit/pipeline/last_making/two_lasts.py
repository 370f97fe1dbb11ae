"""How two lasts differ: two files, two revisions, or lasts of the catalogue, in any mix."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from footfit.errors import NoSole, OtherKind
from footfit.geometry.fit.arc_sections import (
    ARC_SIZES,
    ArcSection,
    named_arc_sections,
    places_in_space,
)
from footfit.geometry.fit.laid_bottoms import LAID, laid_bottom
from footfit.geometry.fit.placement import Placement
from footfit.geometry.fit.surface_difference import SurfaceDifference, surface_difference
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.rotations import moved_points
from footfit.geometry.stance.cues import NO_LABELS
from footfit.number_words import plain, signed
from footfit.pipeline.batch.run_manifest import STANDS
from footfit.pipeline.last_making.last_sections import size_measured
from footfit.pipeline.last_making.tolerances import TOLERANCE_MM, kind_of
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.flare import profiled_scan
from footfit.pipeline.scan.measure import check_side, last_record
from footfit.pipeline.scan.standing import heights_by_shape, last_stance
from footfit.results import (
    Comparison,
    LastLabels,
    Measured,
    Notice,
    Profiled,
    SectionComparison,
    SizeDifference,
)
from footfit.results.last_making.last_difference import (
    LastDifference,
    StationDifference,
    ValueDifference,
)
from footfit.results.values import notices_about

OTHER_HEEL_MM = 3.0
"""With heels so different, the bottoms lie on each other at the tread alone."""
COLOUR_STEPS_MM = (0.05, 0.1, 0.25, 0.5, 1.0, 2.0)
"""The finest step is taken whose colours reach as far as nearly all of the differences."""
SIDE_DOUBTS = ("side_contradicted", "low_side_confidence")
"""What is no longer said of a last whose side the other last decided."""
NOT_JUDGED = ("tread_from", "tread_to")
"""Where the tread begins and ends is no length, and a second scan differs by 2 mm."""
MOST_NAMED = 3
"""So many measures are named in the error's line; the table has all."""
FOOT_WORDS = (
    "its shape is a foot's, not a last's: give two lasts; footfit compare lays a foot into a last"
)


def last_difference(
    first: Profiled,
    second: Profiled,
    tolerance_mm: Mapping[str, float] = TOLERANCE_MM,
    notices: tuple[Notice, ...] = (),
) -> LastDifference:
    """Lay a second last on the bottom of a first one, and say how it differs.

    ``notices`` are what is known already, such as of the sides.

    Raises
    ------
    OtherKind
        One is read from a file, and is a foot by its shape.
    SideUndecided
        The shape of one does not show its side.
    NoSole
        The bottoms do not lie together: one of the two has none.
    """
    for last in (first, second):
        info = last.aligned.alignment.info
        if not last.is_last and not info.is_stored_last:
            raise OtherKind(FOOT_WORDS, info.path)
        check_side(last.aligned.alignment)
    said = [_has_labels(last) for last in (first, second)]
    if any(said) and not all(said):
        first, second = _by_shape(first), _by_shape(second)
    here, there = first.aligned.prepared.shape, second.aligned.prepared.shape
    laid = laid_bottom(here, there)
    if laid.share < LAID.least:
        raise NoSole("the bottoms of the two lasts do not lie together: is one of them open?")
    moved = Shape(moved_points(laid.transform, there.vertices_mm), there.faces, there.kind)
    surface = surface_difference(here, moved)
    pairs = list(zip(named_arc_sections(here), named_arc_sections(there), strict=True))
    measures = _measures(first, second, tolerance_mm)
    infos = [last.aligned.alignment.info for last in (first, second)]
    return LastDifference(
        first=first,
        second=second,
        mirrored=first.aligned.alignment.side.side != second.aligned.alignment.side.side,
        laid=laid,
        tolerance_mm=tolerance_mm,
        measures=measures,
        surface=surface,
        sections=tuple(_station(*pair) for pair in pairs),
        resolution_mm=max(info.resolution_mm for info in infos),
        warnings=_warnings(first, second, measures, notices, one_label=any(said) and not all(said)),
        drawn=_drawn(first, second, moved, surface, pairs, laid.transform),
    )


# ---------------------------------------------------------------- how they stand


def _has_labels(last: Profiled) -> bool:
    """Whether a label says how the last stands."""
    labels = last.aligned.prepared.shape.labels
    return labels.heel_height_mm is not None or labels.toe_spring_mm is not None


def _by_shape(last: Profiled) -> Profiled:
    """The last as its shape stands, measured anew if a label said how it stands.

    A label moves the ground, and with it each height and each upright plane. Two lasts are
    compared by one rule.
    """
    if not _has_labels(last):
        return last
    prepared = last.aligned.prepared
    shape = replace(prepared.shape, labels=NO_LABELS)
    alone = replace(
        prepared,
        shape=shape,
        stance=last_stance(shape, prepared.info),
        standing_transform=shape.standing_transform,
    )
    return profiled_scan(aligned_scan(alone))


# ---------------------------------------------------------------- measures


def _measures(
    first: Profiled, second: Profiled, tolerance_mm: Mapping[str, float]
) -> tuple[ValueDifference, ...]:
    """Every measure that one of the two has, and the flare angle."""
    theirs = {measure.name: measure.measured for measure in second.measures}
    angles = (measure.name for measure in first.measures if measure.name.endswith("_deg"))
    unjudged = {*NOT_JUDGED, *angles}
    missing = Measured(None, reason="the other one is measured as a foot")
    rows = [
        _value(
            measure.name,
            "deg" if measure.name.endswith("_deg") else "mm",
            measure.measured,
            theirs.get(measure.name, missing),
            None if measure.name in unjudged else tolerance_mm[kind_of(measure.name)],
        )
        for measure in first.measures
    ]
    here, there = (
        Measured(last.flare.angle_deg, last.flare.angle_sd_deg) for last in (first, second)
    )
    return (*rows, _value("flare_angle", "deg", here, there))


def _value(
    name: str, unit: str, first: Measured, second: Measured, tolerance: float | None = None
) -> ValueDifference:
    """The difference of two values; its standard deviation is that of two second scans.

    A bias that a measure has is in both values, so it is in no difference.
    """
    if first.value is None or second.value is None:
        reason = first.reason if first.value is None else second.reason
        difference = Measured(None, reason=reason)
    else:
        spread = math.hypot(first.sd or 0.0, second.sd or 0.0)
        difference = Measured(second.value - first.value, spread)
    return ValueDifference(name, unit, first, second, difference, tolerance)


# ---------------------------------------------------------------- sections


def _station(first: ArcSection, second: ArcSection) -> StationDifference:
    sizes = (
        _value(name, "mm", size_measured(name, first.sizes[name]), other)
        for name in ARC_SIZES
        for other in (size_measured(name, second.sizes[name]),)
    )
    return StationDifference(first.station.name, first.share, second.share, tuple(sizes))


# ---------------------------------------------------------------- what is said and shown


def _warnings(
    first: Profiled,
    second: Profiled,
    measures: tuple[ValueDifference, ...],
    known: tuple[Notice, ...],
    *,
    one_label: bool,
) -> tuple[Notice, ...]:
    notices = list(known)
    decided = {notice.path for notice in known if notice.code == "side_from_other_last"}
    if one_label:
        words = (
            "only one of the two has labels of its heel or its toe spring: both stand, and are"
            " measured, as their shapes say"
        )
        notices.append(Notice("stance_by_shape", words))
    for last in (first, second):
        alignment = last.aligned.alignment
        path = alignment.info.path
        doubts = {*(SIDE_DOUBTS if path in decided else ()), *([STANDS] if one_label else [])}
        own = (notice for notice in alignment.warnings if notice.code not in doubts)
        notices += notices_about(path, own)
        if not last.is_last:
            words = "its shape is nearer to a foot's than to a last's: it is measured as a foot"
            notices += notices_about(alignment.info.path, (Notice("looks_like_a_foot", words),))
    notices += _shapes_otherwise(first, second, measures)
    heel = next((row for row in measures if row.name == "heel_height"), None)
    more = None if heel is None else heel.difference.value
    if more is not None and abs(more) > OTHER_HEEL_MM:
        words = (
            f"the heel of the second last is {plain(abs(more))} mm"
            f" {'higher' if more > 0 else 'lower'}: behind the tread the surfaces show that too;"
            " measures and sections go along the bottom"
        )
        notices.append(Notice("other_heel", words))
    unique = {(notice.path, notice.code, notice.message): notice for notice in notices}
    return tuple(unique.values())


def _shapes_otherwise(
    first: Profiled, second: Profiled, measures: tuple[ValueDifference, ...]
) -> Iterator[Notice]:
    """A warning for each height whose difference the labels hold otherwise than the shapes."""
    if not (_has_labels(first) and _has_labels(second)):
        return
    here, there = (heights_by_shape(last.aligned.prepared.shape.stance) for last in (first, second))
    for row in (row for row in measures if row.name in here.keys() & there.keys()):
        by_shape, by_label = there[row.name] - here[row.name], row.difference.value
        if by_label is not None and abs(by_shape - by_label) > TOLERANCE_MM["height"]:
            words = (
                f"by their shapes alone the {row.name.replace('_', ' ')} differs by"
                f" {signed(by_shape)} mm, and by their labels by {signed(by_label)} mm: a label or"
                " a shape is wrong. If the bottom was held in grading, the labels are right"
            )
            yield Notice("shapes_differ_otherwise", words)


def outside_words(difference: LastDifference) -> str:
    """What is outside of its tolerance: "ball girth +3.1 mm (2.0)"."""
    outside = sorted(difference.outside, key=_overrun, reverse=True)
    rows = [
        f"{row.name.replace('_', ' ')} {signed(row.difference.value or 0.0)} mm"
        f" (tolerance {plain(row.tolerance or 0.0)})"
        for row in outside[:MOST_NAMED]
    ]
    most = "" if len(outside) <= MOST_NAMED else "most of all "
    return (
        f"{len(outside)} of {len(difference.judged)} judged measures are outside of their"
        f" tolerance: {most}{', '.join(rows)}"
    )


def _overrun(row: ValueDifference) -> float:
    """How many mm a measure is outside of its tolerance."""
    return abs(row.difference.value or 0.0) - (row.tolerance or 0.0)


def _drawn(
    first: Profiled,
    second: Profiled,
    moved: Shape,
    surface: SurfaceDifference,
    pairs: list[tuple[ArcSection, ArcSection]],
    transform: Floats,
) -> Comparison:
    """Both lasts as a page and pictures show a comparison: the first in the second."""
    shape, info = first.aligned.prepared.shape, second.aligned.alignment.info
    sections = tuple(_drawn_section(*pair, transform) for pair in pairs)
    sizes = (size for size in COLOUR_STEPS_MM if 4.0 * size >= (surface.p95_mm or 0.0))
    return Comparison(
        foot=first,
        last=last_record(second, LastLabels(info.path or "-")),
        mirrored=first.aligned.alignment.side.side != second.aligned.alignment.side.side,
        placement=Placement(np.zeros(2), 1.0),
        vertices_mm=shape.vertices_mm,
        faces=shape.faces,
        last_vertices_mm=moved.vertices_mm,
        last_faces=moved.faces,
        clearance_mm=surface.at_first_mm,
        zones=(),
        sections=sections,
        warnings=(),
        toe_room=Measured(None, reason="two lasts are compared"),
        step_mm=next(sizes, COLOUR_STEPS_MM[-1]),
        is_difference=True,
    )


def _drawn_section(first: ArcSection, second: ArcSection, transform: Floats) -> SectionComparison:
    """Both outlines in the plane of the first; each is cut at its own station."""
    loops = tuple(
        (moved_points(transform, places_in_space(second, loop)) - first.origin) @ first.axes.T
        for loop in second.outline.loops
    )
    known = (
        SizeDifference(row.name, row.first, row.second, row.difference)
        for row in _station(first, second).sizes
    )
    return SectionComparison(
        first.station.name, float(first.origin[0]), first.outline.loops, loops, tuple(known)
    )
