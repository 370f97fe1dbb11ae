"""A foot in a last as tables for a terminal."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.text import Text

from footfit.number_words import AREA_KEPT, plain, signed
from footfit.report.terminal.scan_tables import lined_table
from footfit.report.wording.comparison_words import (
    SIZE_HEADS,
    change_words,
    lengths_words,
    measures_words,
    swing_words,
)
from footfit.report.wording.fit_words import OTHER_FOOT
from footfit.report.wording.text import difference_text, file_name, visible
from footfit.results import Comparison


def compare_table(comparison: Comparison) -> RenderableType:
    """The lengths, the swing, the clearance by zone and the sections, in 80 columns."""
    first, second = comparison.nouns
    return Group(
        _headline(comparison),
        Text(lengths_words(comparison)),
        *([Text(change_words(comparison))] if change_words(comparison) else []),
        Text(swing_words(comparison)),
        Text(),
        Text(f"Room between {first} and {second}, by zone"),
        _zones_table(comparison),
        Text(measures_words(comparison)),
        Text(),
        Text(f"Sections, {second} minus {first} in mm (+ is room)"),
        _sections_table(comparison),
        Text(
            f"-: not measurable there; --json says why. Edges: how far the {second}'s edge lies "
            f"outside of the {first}'s.",
            "dim",
        ),
    )


def _headline(comparison: Comparison) -> Text:
    alignment = comparison.foot.aligned.alignment
    line = Text(file_name(alignment.info.path), "bold")
    is_last = comparison.foot.is_last
    line.append(f", {alignment.side.side} {'last' if is_last else 'foot'}, in ", "not bold")
    line.append(visible(comparison.last.labels.name), "bold")
    if is_last:
        line.append(f", {comparison.last.side.side or 'undecided'} last", "not bold")
    shown = "shown on its mirror image" if is_last else OTHER_FOOT
    return line.append(f" ({shown})" if comparison.mirrored else "", "not bold")


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
            zone.zone,
            *(signed(value) for value in spread),
            *(plain(area, 0, AREA_KEPT) for area in areas),
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
