"""A foot in a last: as a JSON document, as tables for a terminal, as CSV."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Group
from rich.text import Text

from footfit.report.csv.answers_csv import csv_text
from footfit.report.json.lines import Json, document
from footfit.report.json.numbers import degrees, measured_value, millimetres
from footfit.report.json.parts import mesh_part, side_part, warnings_part
from footfit.report.json.surface_parts import zone_clearance_part
from footfit.report.terminal.scan_tables import lined_table
from footfit.report.wording.comparison_words import (
    SIZE_HEADS,
    flare_delta_deg,
    lengths_words,
    swing_words,
)
from footfit.report.wording.text import difference_text, file_name, plain, signed, visible

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rich.console import RenderableType

    from footfit.report.csv.answers_csv import Cell
    from footfit.results import Comparison, SectionComparison

CSV_COLUMNS = (
    "path",
    "last",
    "part",
    "place",
    "quantity",
    "unit",
    "foot",
    "last_value",
    "difference",
    "sd",
    "reason",
)


# ---------------------------------------------------------------- JSON


def compare_document(comparison: Comparison) -> Json:
    """``footfit.compare/2``: one foot in one last."""
    alignment, way = comparison.foot.aligned.alignment, comparison.docking
    shift = [millimetres(value) for value in way.shift_mm]
    return document(
        "compare",
        {
            "mesh": mesh_part(alignment.info),
            **side_part(alignment.side),
            "last": comparison.last.labels.name,
            "last_side": comparison.last.side.side,
            "mirrored": comparison.mirrored,
            "length_mm": lengths_part(alignment.length_mm, comparison.last.length_mm),
            "extent_mm": lengths_part(alignment.extent_mm, comparison.last.extent_mm),
            "flare_delta_deg": degrees(flare_delta_deg(comparison)),
            "docking": {
                "swing_mm": millimetres(way.swing_mm),
                "pitch_deg": degrees(way.pitch_deg),
                "yaw_deg": degrees(way.yaw_deg),
                "bend_deg": degrees(way.bend_deg),
                "shift_mm": shift,
            },
            "zones": {zone.zone: zone_clearance_part(zone) for zone in comparison.zones},
            "sections": [section_part(section) for section in comparison.sections],
            "warnings": warnings_part(comparison.warnings),
        },
        version=2,
    )


def lengths_part(foot_mm: float | None, last_mm: float | None) -> Json:
    """The lengths of foot and last, and last minus foot; null where one is not known."""
    longer_mm = None if foot_mm is None or last_mm is None else last_mm - foot_mm
    lengths = {"foot": foot_mm, "last": last_mm, "difference": longer_mm}
    return {name: millimetres(value) for name, value in lengths.items()}


def section_part(section: SectionComparison) -> Json:
    """One section's sizes, of foot and last, and their difference."""
    sizes: Json = {
        size.name: {
            "foot": measured_value(size.foot),
            "last": measured_value(size.last),
            "difference": measured_value(size.difference),
        }
        for size in section.sizes
    }
    return {"station": section.station, "x_mm": millimetres(section.x_mm), "sizes": sizes}


# ---------------------------------------------------------------- the terminal


def compare_table(comparison: Comparison) -> RenderableType:
    """The lengths and the swing, the room by zone, the sections: 80 columns."""
    return Group(
        _headline(comparison),
        Text(lengths_words(comparison)),
        Text(swing_words(comparison)),
        Text(),
        Text("Room between foot and last, by zone"),
        _zones_table(comparison),
        Text("Sections, last minus foot in mm (+ is room)"),
        _sections_table(comparison),
        Text(
            "-: not measurable there; --json says why. Edges: how far the last's edge lies "
            "outside of the foot's.",
            "dim",
        ),
    )


def _headline(comparison: Comparison) -> Text:
    alignment = comparison.foot.aligned.alignment
    line = Text(file_name(alignment.info.path), "bold")
    line.append(f", {alignment.side.side} foot, in ", "not bold")
    line.append(visible(comparison.last.labels.name), "bold")
    return line.append(" (mirrored)" if comparison.mirrored else "", "not bold")


def _zones_table(comparison: Comparison) -> RenderableType:
    columns = ("mean mm", "5 %", "95 %", "tight cm2", "loose cm2", "of cm2")
    table = lined_table("zone", *columns, right=frozenset(columns))
    for zone in comparison.zones:
        if zone.mean_mm is None or zone.p05_mm is None or zone.p95_mm is None:
            table.add_row(zone.zone, *["-"] * len(columns))
            continue
        areas = (zone.tight_cm2, zone.loose_cm2, zone.area_cm2)
        spread = (zone.mean_mm, zone.p05_mm, zone.p95_mm)
        table.add_row(
            zone.zone, *(signed(value) for value in spread), *(plain(area, 0) for area in areas)
        )
    return table


def _sections_table(comparison: Comparison) -> RenderableType:
    heads = tuple(SIZE_HEADS.values())
    table = lined_table("section", "at mm", *heads, right=frozenset(("at mm", *heads)))
    for section in comparison.sections:
        cells = {size.name: difference_text(size.difference) for size in section.sizes}
        table.add_row(
            section.station, plain(section.x_mm, 0), *(cells[name] for name in SIZE_HEADS)
        )
    return table


# ---------------------------------------------------------------- CSV


def compare_csv(comparisons: Iterable[Comparison]) -> str:
    """One row per section and size, and one per zone and figure."""
    rows = (row for comparison in comparisons for row in _rows(comparison))
    return csv_text(CSV_COLUMNS, rows, header=True)


def _rows(comparison: Comparison) -> Iterable[list[Cell]]:
    path, last = comparison.foot.aligned.alignment.info.path, comparison.last.labels.name
    for section in comparison.sections:
        for size in section.sizes:
            room = size.difference
            yield [
                *(path, last, "section", section.station, size.name, "mm"),
                *(millimetres(one.value) for one in (size.foot, size.last, room)),
                millimetres(room.sd),
                room.reason,
            ]
    for zone in comparison.zones:
        for name, value in zone_clearance_part(zone).items():
            quantity, unit = str(name).rsplit("_", 1)
            room_value = value if isinstance(value, float) else None
            yield [
                *(path, last, "zone", zone.zone, quantity, unit),
                None,
                None,
                room_value,
                None,
                None,
            ]
