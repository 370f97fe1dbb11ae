"""Every check that can tell whether a catalogue holds what was stored."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from footfit.catalogue.blocks.block_reading import BLOCKS_ANEW
from footfit.catalogue.blocks.block_writing import wrong_blocks
from footfit.catalogue.checks.plausible_values import implausible, implausible_values
from footfit.catalogue.checks.schema_comparison import expected_objects, stored_objects
from footfit.catalogue.file.dialect import Driver, ServerConnection, column_names, table_names
from footfit.catalogue.file.migrate import Schema
from footfit.catalogue.rows.array_blobs import array_of, definition_text
from footfit.catalogue.rows.columns import FIT, MESH_COPY, REFERENCE, SEALED, SEARCH_BLOCK, TABLES
from footfit.catalogue.rows.reference_last import stored_reference, transform_by
from footfit.catalogue.rows.verified_rows import (
    LastRows,
    last_names,
    row_digest,
    rows,
    shown_name,
    stored_lasts,
)
from footfit.errors import CatalogueDamaged
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.numeric.arrays import Floats
from footfit.results import Finding

TRANSFORM_TOLERANCE = 1e-9
"""Relative: on another machine, the last bits of a computed paper transform may differ."""

HAS_COPY = f"SELECT 1 FROM {MESH_COPY.name} WHERE last_id = ?"

Check = Callable[[Driver], Iterator[Finding]]


def findings(connection: Driver, schema: Schema) -> list[Finding]:
    """What all checks report; empty for a sound catalogue whose tables are those of ``schema``.

    If SQLite cannot carry out a check, because a page is unreadable, that is a finding too.
    """
    reports: list[Finding] = []
    checks: tuple[Check, ...] = (partial(_objects, schema=schema), *OF_FILES, *CHECKS)
    if isinstance(connection, ServerConnection):  # the server looks after its own files
        checks = (_columns, *CHECKS)
    for check in checks:
        try:
            reports.extend(check(connection))
        except (sqlite3.DatabaseError, UnicodeDecodeError) as error:
            reports.append(Finding("unreadable", f"a part cannot be read: {error}"))
        except CatalogueDamaged as error:
            reports.append(Finding("damaged", error.message))
    return reports


def _marks(connection: Driver) -> Iterator[Finding]:
    (mirror,) = connection.execute("PRAGMA user_version").fetchone()
    (revision,) = connection.execute("SELECT version_num FROM alembic_version").fetchone()
    if mirror != int(revision):
        yield Finding("schema_mirror", f"user_version is {mirror} and the schema is {revision!r}")
    (mode,) = connection.execute("PRAGMA journal_mode").fetchone()
    if mode != "delete":
        words = (
            f"the journal is {mode!r}: a copy of the file may lack data; the next write repairs it"
        )
        yield Finding("journal_mode", words, damage=False)


def _pages(connection: Driver) -> Iterator[Finding]:
    for (line,) in connection.execute("PRAGMA integrity_check"):
        if line != "ok":
            yield Finding("integrity", " ".join(str(line).split()))


def _objects(connection: Driver, schema: Schema) -> Iterator[Finding]:
    """Compare tables, indexes and triggers: their text lies in the file too, and is obeyed."""
    assert isinstance(connection, sqlite3.Connection)
    stored, expected = stored_objects(connection), expected_objects(schema)
    for key in sorted(stored.keys() | expected.keys()):
        kind, name = key
        if key not in stored:
            yield Finding("schema", f"the {kind} {name} is missing")
        elif key not in expected:
            yield Finding("schema", f"footfit did not make the {kind} {name}")
        elif stored[key] != expected[key]:
            yield Finding("schema", f"the {kind} {name} is not as footfit made it")


def _columns(connection: Driver) -> Iterator[Finding]:
    """Compare the tables and columns on a server with the table of columns."""
    there = column_names(connection)
    for table in TABLES:
        names = {column.name for column in table.columns}
        for name in sorted(names ^ there.get(table.name, set())):
            known = "is missing" if name in names else "is not footfit's"
            yield Finding("schema", f"the column {name} of the table {table.name} {known}")


def _keys(connection: Driver) -> Iterator[Finding]:
    for table, rowid, parent, _ in connection.execute("PRAGMA foreign_key_check"):
        yield Finding("foreign_key", f"row {rowid} of {table} belongs to no row of {parent}")


def _lasts(connection: Driver) -> Iterator[Finding]:
    for stored in stored_lasts(connection):
        if not stored.intact:
            yield Finding(
                "last",
                "its stored numbers were changed: ingest it again with --replace",
                stored.name,
            )
            continue
        for words in implausible(stored):
            yield Finding("range", words, stored.name)


def _definitions(connection: Driver) -> Iterator[Finding]:
    """A profile of another definition is not damaged, but it cannot be ranked."""
    current = definition_text(FlareDefinition())
    for stored in stored_lasts(connection):
        if stored.flare is not None and not stored.is_current:
            version = stored.flare.get("definition_version")
            words = f"its profile follows {version!r}"
            if stored.definition == current:
                words = f"its profile has not the number of stations of {version!r}"
            cure = "type: footfit upgrade-catalogue"
            if not connection.execute(HAS_COPY, (stored.id,)).fetchone():
                cure = "it has no mesh copy: ingest its file again with --replace"
            yield Finding("definition", f"{words}; {cure}", stored.name, damage=False)


def _sealed_rows(connection: Driver) -> Iterator[Finding]:
    """What ranking does not read, and what has a hash of its own for that."""
    names = last_names(connection)
    there = table_names(connection)
    for table in SEALED:
        if table.name not in there:  # an older schema has none; the schema's check names others
            continue
        noun = table.name.replace("_", " ")
        for row in rows(connection, table):
            name = names.get(row["last_id"], "?")
            if row.get("sha256") != row_digest(table, row):
                yield Finding(table.name, f"its {noun} is not what was stored", name)
                continue
            for words in implausible_values(table, row):
                yield Finding("range", words, name)


def _blocks(connection: Driver) -> Iterator[Finding]:
    """The search blocks against the rows that they are made of; an older schema has none."""
    if SEARCH_BLOCK.name not in table_names(connection):
        return
    try:
        wrong = wrong_blocks(connection)
    except CatalogueDamaged:  # a table lacks a column: the schema's check says so
        return
    for block in wrong:
        words = f"search block {block} does not say what its lasts say; {BLOCKS_ANEW}"
        yield Finding("search_block", words)


def _fits(connection: Driver) -> Iterator[Finding]:
    """The entries of the fit log; an older schema has none."""
    if FIT.name not in table_names(connection):
        return
    for row in rows(connection, FIT):
        if row.get("sha256") != row_digest(FIT, row):
            yield Finding(
                "fit", f"the fit entry {shown_name(row.get('id'))} is not what was stored"
            )
            continue
        for words in implausible_values(FIT, row):
            yield Finding("range", words)


def _reference(connection: Driver) -> Iterator[Finding]:
    reference, lasts = stored_reference(connection), stored_lasts(connection)
    if reference is None:
        if lasts:
            words = "there are lasts but no reference; type: footfit set-reference LAST"
            yield Finding("reference", words)
        return
    for row in rows(connection, REFERENCE):
        for words in implausible_values(REFERENCE, row):
            yield Finding("range", words)
    words = "its paper transform does not follow the reference"
    for stored in lasts:
        if stored.intact and not _agrees(stored, transform_by(reference[1], stored)):
            yield Finding("paper_transform", words, stored.name)


def _agrees(stored: LastRows, expected: Floats) -> bool:
    data = (stored.frame or {})["paper_transform"]
    if data is None:
        return False
    error = np.abs(array_of(data, 4, 4) - expected).max()
    return bool(error <= TRANSFORM_TOLERANCE * np.abs(expected).max())


OF_FILES: tuple[Check, ...] = (_marks, _pages, _keys)
"""What SQLite does not keep sound by itself, before the other checks."""
CHECKS: tuple[Check, ...] = (
    _lasts,
    _definitions,
    _sealed_rows,
    _blocks,
    _fits,
    _reference,
)
"""The checks of what is stored, in the order of their findings."""
