"""The sections of a last along its bottom, for the bench and for other programs."""

from __future__ import annotations

from footfit.geometry.fit.arc_sections import (
    ARC_SIZES,
    ArcSection,
    arc_sections,
    places_in_space,
    plane_normal,
)
from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.scan.preparation import mirror_of
from footfit.results import Measured, Profiled
from footfit.results.last_making.section_table import LastSection, SectionTable

SD_FROM = {"width": "heel_width", "height": "instep_height", "girth": "waist_girth"}
"""The measure that is taken like a section's size, and so has the same repeatability."""


def section_table(last: Profiled, count: int) -> SectionTable:
    """``count`` sections in equal steps along the bottom of a last, and the named ones."""
    shape = last.aligned.prepared.shape
    arc = shape.bottom_arc
    length_mm = shape.length_mm if arc is None else arc.length_mm
    own_side = mirror_of(last.aligned.alignment.side.side)
    name = last.aligned.alignment.info.path or ""
    made = arc_sections(shape, count)
    return SectionTable(name, tuple(_section(one, length_mm, own_side) for one in made))


def _section(section: ArcSection, length_mm: float, own_side: Floats) -> LastSection:
    """A section of the right shape, on the side of the last itself."""
    return LastSection(
        place=section.station.name,
        share=section.share,
        along_mm=section.share * length_mm,
        point_mm=section.origin * own_side,
        normal=plane_normal(section.axes) * own_side,
        sizes=tuple((name, size_measured(name, section.sizes[name])) for name in ARC_SIZES),
        loops=tuple(places_in_space(section, loop) * own_side for loop in section.outline.loops),
    )


def size_measured(name: str, value: MeasureValue) -> Measured:
    """A size of a section with its repeatability."""
    sd = None if value.value is None else measure_named(SD_FROM[name]).sd
    return Measured(value.value, sd, value.reason)
