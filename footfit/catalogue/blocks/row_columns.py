"""Lasts by column from their rows, one by one: those that no block has."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.catalogue.blocks.record_columns import Kept, columns_of
from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.rows.columns import SECTION
from footfit.catalogue.rows.records import record_of, sections_of
from footfit.catalogue.rows.verified_rows import LastRows, row_digest, rows, shown_name
from footfit.results import LastRecord
from footfit.results.columns.last_columns import NOT_KEPT, SPOILT, LastColumns
from footfit.results.columns.vocabulary import Vocabulary


def columns_of_rows(
    connection: Driver, lasts: Sequence[LastRows], words: Vocabulary
) -> LastColumns:
    """Lasts whose rows are intact, by column, with all columns."""
    read = [last_of_rows(connection, stored) for stored in lasts]
    return columns_of(
        [record for record, _ in read],
        [kept for _, kept in read],
        words,
        keys=[stored.id for stored in lasts],
        profiles=[stored.definition for stored in lasts],
    )


def last_of_rows(connection: Driver, stored: LastRows) -> tuple[LastRecord, Kept]:
    """The record and the kept sections of a last whose rows are intact."""
    select = "SELECT id, name FROM last NOT INDEXED WHERE id = ?"
    parents = connection.execute(select, (stored.last.get("parent_id"),)).fetchall()
    record = record_of(stored, {key: shown_name(name) for key, name in parents})
    kept = rows(connection, SECTION, stored.id)
    if not kept:
        return record, NOT_KEPT
    intact = kept[0].get("sha256") == row_digest(SECTION, kept[0])
    return record, sections_of(kept[0]) if intact else SPOILT
