"""What matching reads: the record and the profile of every last, but no mesh."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from footfit.catalogue.rows.array_blobs import definition_text
from footfit.catalogue.rows.records import record_of
from footfit.catalogue.rows.verified_rows import LastRows, last_names, stored_lasts
from footfit.geometry.flare.definition import FlareDefinition
from footfit.results import LastRecord


@dataclass(frozen=True, slots=True)
class SearchRows:
    """The lasts to rank, by name, and the lasts that were left out.

    ``rejected`` counts them by filter. ``damaged`` names the lasts whose rows are not what was
    stored, and ``outdated`` those whose profile follows another flare definition than this
    footfit's (``upgrade-catalogue`` makes a new one): these two cannot be ranked.
    """

    records: tuple[LastRecord, ...]
    rejected: tuple[tuple[str, int], ...]
    damaged: tuple[str, ...]
    outdated: tuple[str, ...]


def sorted_lasts(connection: sqlite3.Connection) -> tuple[list[LastRows], list[str]]:
    """The intact lasts by name, and the names of the damaged ones."""
    lasts = stored_lasts(connection)
    verdicts = [(stored, stored.intact) for stored in lasts]
    intact = sorted((s for s, good in verdicts if good), key=lambda s: s.name)
    return intact, sorted(s.name for s, good in verdicts if not good)


def all_records(connection: sqlite3.Connection) -> list[LastRecord]:
    """The records of all intact lasts, by name."""
    names = last_names(connection)
    return [record_of(stored, names) for stored in sorted_lasts(connection)[0]]


def search_rows(connection: sqlite3.Connection, **filters: str | None) -> SearchRows:
    """The lasts that pass the filters (see :func:`rejection`) and can be ranked."""
    names = last_names(connection)
    intact, damaged = sorted_lasts(connection)
    current = definition_text(FlareDefinition())
    records, outdated, rejected = [], [], []
    for stored in intact:
        record = record_of(stored, names)
        reason = rejection(record, filters)
        if reason is not None:
            rejected.append(reason)
        elif stored.definition != current:
            outdated.append(record.labels.name)
        else:
            records.append(record)
    return SearchRows(
        tuple(records), tuple(sorted(Counter(rejected).items())), tuple(damaged), tuple(outdated)
    )


def rejection(record: LastRecord, filters: Mapping[str, str | None]) -> str | None:
    """The first filter that a last does not pass, or None.

    A filter names a label and what it must be, whatever the case; None lets every last pass.
    """
    for name, wanted in filters.items():
        label = getattr(record.labels, name)
        if wanted is not None and (label is None or label.casefold() != wanted.casefold()):
            return name
    return None
