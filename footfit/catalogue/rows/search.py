"""What matching reads: every last's record and profile, and no mesh."""

from __future__ import annotations

import sqlite3
from collections import Counter
from dataclasses import dataclass

from footfit.catalogue.rows.array_blobs import definition_text
from footfit.catalogue.rows.records import definition_of_rows, record_of
from footfit.catalogue.rows.verified_rows import StoredLast, last_names, stored_lasts
from footfit.geometry.flare.flare_profile import FlareDefinition
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


def sorted_lasts(connection: sqlite3.Connection) -> tuple[list[StoredLast], list[str]]:
    """The intact lasts by name, and the names of the damaged ones."""
    lasts = stored_lasts(connection)
    verdicts = [(stored, stored.intact) for stored in lasts]
    intact = sorted((s for s, good in verdicts if good), key=lambda s: s.name)
    return intact, sorted(s.name for s, good in verdicts if not good)


def all_records(connection: sqlite3.Connection) -> list[LastRecord]:
    """The records of all intact lasts, by name."""
    names = last_names(connection)
    return [record_of(stored, names) for stored in sorted_lasts(connection)[0]]


def search_rows(connection: sqlite3.Connection, filters: Filters) -> SearchRows:
    """The lasts that pass the filters and can be ranked."""
    names = last_names(connection)
    intact, damaged = sorted_lasts(connection)
    current = definition_text(FlareDefinition())
    records, outdated, rejected = [], [], []
    for stored in intact:
        record = record_of(stored, names)
        reason = rejection(record, filters)
        if reason is not None:
            rejected.append(reason)
        elif definition_of_rows(stored) != current:
            outdated.append(record.labels.name)
        else:
            records.append(record)
    return SearchRows(
        tuple(records), tuple(sorted(Counter(rejected).items())), tuple(damaged), tuple(outdated)
    )


def rejection(record: LastRecord, filters: Filters) -> str | None:
    """The first filter that a last does not pass, or None."""
    labels = record.labels
    passes = {
        "style": _same(labels.style, filters.style),
        "size_system": _same(labels.size_system, filters.size_system),
        "sizes": _within(_size(labels.size), filters.sizes),
        "length_mm": _within(record.length_mm, filters.length_mm),
    }
    return next((name for name, passed in passes.items() if not passed), None)


def _same(label: str | None, asked: str | None) -> bool:
    return asked is None or (label is not None and label.casefold() == asked.casefold())


def _within(value: float | None, asked: Range | None) -> bool:
    return asked is None or (value is not None and asked[0] <= value <= asked[1])


def _size(label: str | None) -> float | None:
    try:
        return None if label is None else float(label.replace(",", "."))
    except ValueError:
        return None
