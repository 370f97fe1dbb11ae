"""What matching reads: every last's record and profile, and no mesh."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from footfit.catalogue.blobs import definition_text
from footfit.catalogue.reading import last_names, stored_lasts
from footfit.catalogue.records import record_of
from footfit.geometry.flare import FlareDefinition
from footfit.results import LastRecord

Range = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Filters:
    """What is asked of a last's labels and length; None asks nothing.

    Labels compare without regard to case; ``sizes`` and ``length_mm`` are closed ranges, and a
    size that is no number is in no range.
    """

    style: str | None = None
    size_system: str | None = None
    sizes: Range | None = None
    length_mm: Range | None = None


@dataclass(frozen=True, slots=True)
class SearchRows:
    """The lasts to rank, by name, and those left out with the reason.

    ``rejected`` counts by filter; ``damaged`` names the lasts whose rows are not what was
    stored, ``outdated`` those whose profile follows another flare definition than this
    footfit's (``upgrade-catalogue`` makes it anew): neither can be ranked.
    """

    records: tuple[LastRecord, ...]
    rejected: tuple[tuple[str, int], ...]
    damaged: tuple[str, ...]
    outdated: tuple[str, ...]


def all_records(connection: sqlite3.Connection) -> tuple[list[LastRecord], list[str]]:
    """The records of all intact lasts, by name, and the names of the damaged ones."""
    names = last_names(connection)
    records, damaged = [], []
    for stored in stored_lasts(connection):
        if stored.intact:
            records.append(record_of(stored, names))
        else:
            damaged.append(stored.name)
    return sorted(records, key=lambda record: record.labels.name), sorted(damaged)


def search_rows(connection: sqlite3.Connection, filters: Filters) -> SearchRows:
    """The lasts that pass the filters and can be ranked."""
    records, damaged = all_records(connection)
    reasons = [rejection(record, filters) for record in records]
    passed = [r for r, reason in zip(records, reasons, strict=True) if reason is None]
    current = definition_text(FlareDefinition())
    comparable = [definition_text(record.flare.definition) == current for record in passed]
    return SearchRows(
        records=tuple(r for r, good in zip(passed, comparable, strict=True) if good),
        rejected=tuple(sorted(Counter(reason for reason in reasons if reason).items())),
        damaged=tuple(damaged),
        outdated=tuple(
            r.labels.name for r, good in zip(passed, comparable, strict=True) if not good
        ),
    )


def rejection(record: LastRecord, filters: Filters) -> str | None:
    """The first filter that a last does not pass, or None."""
    passes: dict[str, Callable[[], bool]] = {
        "style": lambda: _same(record.labels.style, filters.style),
        "size_system": lambda: _same(record.labels.size_system, filters.size_system),
        "sizes": lambda: _within(_size(record.labels.size), filters.sizes),
        "length_mm": lambda: _within(record.length_mm, filters.length_mm),
    }
    return next((name for name, passed in passes.items() if not passed()), None)


def _same(label: str | None, asked: str | None) -> bool:
    return asked is None or (label is not None and label.casefold() == asked.casefold())


def _within(value: float | None, asked: Range | None) -> bool:
    return asked is None or (value is not None and asked[0] <= value <= asked[1])


def _size(label: str | None) -> float | None:
    try:
        return None if label is None else float(label.replace(",", "."))
    except ValueError:
        return None
