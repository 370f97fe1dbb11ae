"""How two lasts differ, as tables for a terminal."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit.number_words import plain, signed
from footfit.report.terminal.scan_tables import lined_table
from footfit.report.wording.difference_words import (
    SECTION_GIRTHS,
    ZONE_NAMES,
    laid_words,
    last_names,
    surface_difference_words,
    value_cells,
    value_name,
    verdict_words,
)
from footfit.report.wording.text import difference_text
from footfit.results import LastDifference


def compare_lasts_table(difference: LastDifference) -> RenderableType:
    """The verdict, every measure, the surfaces by zone and the sections, in 80 columns."""
    first, second = last_names(difference)
    head = Text(first, "bold").append(" and ", "not bold").append(second, "bold")
    return Group(
        head,
        Text(laid_words(difference)),
        Text(verdict_words(difference), "" if not difference.outside else "bold"),
        Text(),
        Text("Measures in mm, second minus first (± of two second scans)"),
        _measures_table(difference),
        Text(surface_difference_words(difference)),
        _zones_table(difference),
        Text("Sections at the same places of both bottoms, second minus first in mm"),
        _sections_table(difference),
        Text(SECTION_GIRTHS, "dim"),
        Text("-: not measurable there; --json says why.", "dim"),
    )


def _measures_table(difference: LastDifference) -> RenderableType:
    columns = ("first", "second", "difference", "tolerance", "")
    table = lined_table("measure", *columns, right=frozenset(columns[:4]))
    for row in difference.measures:
        table.add_row(value_name(row), *value_cells(row))
    return table


def _zones_table(difference: LastDifference) -> RenderableType:
    columns = ("mean mm", "5 %", "95 %")
    table = lined_table("zone", *columns, right=frozenset(columns))
    for zone in difference.surface.zones:
        values = (zone.mean_mm, zone.p05_mm, zone.p95_mm)
        cells = ("-" if value is None else signed(value, 2) for value in values)
        table.add_row(ZONE_NAMES.get(zone.zone, zone.zone), *cells)
    return table


def _sections_table(difference: LastDifference) -> RenderableType:
    names = tuple(size.name for size in difference.sections[0].sizes)
    heads = ("at", *names)
    table = lined_table("section", *heads, right=frozenset(heads))
    for section in difference.sections:
        cells = (difference_text(size.difference) for size in section.sizes)
        table.add_row(section.station, plain(section.first_share, 2), *cells)
    return table
