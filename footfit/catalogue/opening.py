"""How a catalogue file is opened: what it is, which schema it has, and who may write it."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from footfit.catalogue.engine import CatalogueFile, connected, connected_for_reading, worded
from footfit.catalogue.marks import kind_of_file
from footfit.catalogue.migrate import Schema, create, require_current, stored_revision, upgrade
from footfit.errors import CatalogueNotWritable, NoCatalogue

NOTHING_THERE = "there is no catalogue; type: footfit ingest-last FOLDER, or try: footfit demo"


def opened_for_reading(path: Path, schema: Schema, busy_timeout_s: float) -> CatalogueFile:
    """An existing catalogue, read-only; nothing is created, also not beside it.

    Raises
    ------
    NoCatalogue
        There is no file, or one that a killed first ingest left empty.
    NotACatalogue, NewerCatalogue, CatalogueUnusable
        The file is something else, or of another schema.
    """
    with worded(path):
        if kind_of_file(path) == "interrupted":
            connected_for_reading(path, busy_timeout_s).close()  # settles the journal
        if kind_of_file(path) in ("missing", "empty"):
            raise NoCatalogue(NOTHING_THERE, str(path))
        connection = connected_for_reading(path, busy_timeout_s)
        try:
            require_current(connection, schema, path)
        except BaseException:
            connection.close()
            raise
    return CatalogueFile(path, connection, writable=False)


def opened_for_writing(path: Path, schema: Schema, busy_timeout_s: float) -> CatalogueFile:
    """A catalogue to write: made where there is none, upgraded where its schema is older.

    Raises
    ------
    CatalogueNotWritable, CatalogueLocked
        The file, its folder or another program does not let us.
    NotACatalogue, NewerCatalogue, CatalogueDamaged
        The file is something else, or of another schema; it is left as it is.
    """
    with worded(path):
        if kind_of_file(path) == "catalogue":
            connection = _writable(path, schema, busy_timeout_s)
        else:
            _make_folder(path)
            connection = connected(path, "rwc", busy_timeout_s)
            try:
                create(connection, schema)
                require_current(connection, schema, path)
            except BaseException:
                connection.close()
                raise
    return CatalogueFile(path, connection, writable=True)


def _writable(path: Path, schema: Schema, busy_timeout_s: float) -> sqlite3.Connection:
    _require_writable(path, schema, busy_timeout_s)
    return connected(path, "rw", busy_timeout_s)


def _require_writable(path: Path, schema: Schema, busy_timeout_s: float) -> None:
    """Upgrade where needed, and find a read-only file or folder before the work, not after it.

    SQLite opens a file it may not write without a word. Setting a mark to what it is, and
    rolling back, makes it say so, and makes it create its journal in the folder.
    """
    connection = connected(path, "rw", busy_timeout_s)
    try:
        older = stored_revision(connection, schema, path) != schema.head
        if not older:
            connection.execute("BEGIN IMMEDIATE")
            connection.execute(f"PRAGMA user_version = {int(schema.head)}")
            connection.execute("ROLLBACK")
    finally:
        connection.close()
    if older:
        upgrade(path, schema, busy_timeout_s)


def _make_folder(path: Path) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CatalogueNotWritable(
            f"cannot be made: its folder cannot ({error.strerror})", str(path)
        ) from error
