"""Every way in which a stored value can be told from what was stored."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from footfit.catalogue.blobs import array_of
from footfit.catalogue.reading import (
    StoredLast,
    hashed_row,
    last_names,
    rows,
    stored_lasts,
)
from footfit.catalogue.references import expressed, stored_reference
from footfit.errors import CatalogueDamaged

TRANSFORM_TOLERANCE = 1e-9
"""Relative; a paper transform computed on another machine may differ in its last bits."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is not as it was stored; ``last`` names the last it is about, if any."""

    code: str
    message: str
    last: str | None = None


Check = Callable[[sqlite3.Connection], Iterator[Finding]]


def findings(connection: sqlite3.Connection) -> list[Finding]:
    """What all checks find; empty for a sound catalogue.

    A check that SQLite cannot carry out, because a page is unreadable, is a finding itself.
    """
    found: list[Finding] = []
    for check in CHECKS:
        try:
            found.extend(check(connection))
        except (sqlite3.DatabaseError, UnicodeDecodeError) as error:
            found.append(Finding("unreadable", f"a part cannot be read: {error}"))
        except CatalogueDamaged as error:
            found.append(Finding("damaged", error.message))
    return found


def _marks(connection: sqlite3.Connection) -> Iterator[Finding]:
    (mirror,) = connection.execute("PRAGMA user_version").fetchone()
    (revision,) = connection.execute("SELECT version_num FROM alembic_version").fetchone()
    if mirror != int(revision):
        yield Finding("schema_mirror", f"user_version is {mirror} and the schema is {revision!r}")
    (mode,) = connection.execute("PRAGMA journal_mode").fetchone()
    if mode != "delete":
        yield Finding("journal_mode", f"the journal is {mode!r}: a copy of the file may lack data")


def _pages(connection: sqlite3.Connection) -> Iterator[Finding]:
    for (line,) in connection.execute("PRAGMA integrity_check"):
        if line != "ok":
            yield Finding("integrity", " ".join(str(line).split()))


def _columns(connection: sqlite3.Connection) -> Iterator[Finding]:
    """The text of the schema is bytes of the file too."""
    from footfit.catalogue.schema import Base

    for name, table in Base.metadata.tables.items():
        stored = {row[1] for row in connection.execute(f"PRAGMA table_info({name})")}
        for column in sorted(set(table.columns.keys()) - stored):
            yield Finding("column", f"the table {name} lacks the column {column}")


def _keys(connection: sqlite3.Connection) -> Iterator[Finding]:
    for table, rowid, parent, _ in connection.execute("PRAGMA foreign_key_check"):
        yield Finding("foreign_key", f"row {rowid} of {table} points to no row of {parent}")


def _lasts(connection: sqlite3.Connection) -> Iterator[Finding]:
    for stored in stored_lasts(connection):
        if not stored.intact:
            yield Finding("last", "its rows are not what was stored", stored.name)


def _mesh_copies(connection: sqlite3.Connection) -> Iterator[Finding]:
    names = last_names(connection)
    for row in rows(connection, "mesh_copy"):
        if row.get("sha256") != hashed_row(row):
            name = names.get(row["last_id"], "?")
            yield Finding("mesh_copy", "its mesh copy is not what was stored", name)


def _reference(connection: sqlite3.Connection) -> Iterator[Finding]:
    found = stored_reference(connection)
    lasts = stored_lasts(connection)
    if found is None and lasts:
        yield Finding("reference", "there are lasts and no reference; see footfit set-reference")
    if found is None:
        return
    for stored in lasts:
        if stored.intact and not _agrees(stored, expressed(stored, found[1])):
            yield Finding("paper_transform", "is not expressed by the reference", stored.name)


def _agrees(stored: StoredLast, transform: np.ndarray) -> bool:
    assert stored.frame is not None
    data = stored.frame["paper_transform"]
    scale = np.abs(transform).max()
    return data is not None and bool(
        np.abs(array_of(data, 4, 4) - transform).max() <= TRANSFORM_TOLERANCE * scale
    )


CHECKS: tuple[Check, ...] = (_marks, _columns, _pages, _keys, _lasts, _mesh_copies, _reference)
"""All checks, in the order of their findings; a new one is one more function here."""
