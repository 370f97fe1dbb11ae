"""How a catalogue file is opened: what it is, which schema it has, and who may write it."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from footfit.catalogue.file.engine import CatalogueFile, connected, connected_for_reading, worded
from footfit.catalogue.file.file_signature import FileKind, has_live_journal, kind_of_file
from footfit.catalogue.file.migrate import (
    Revisions,
    Schema,
    create,
    require_current,
    stored_revision,
    upgrade,
)
from footfit.errors import CatalogueNotWritable, NoCatalogue

NOTHING_THERE = "there is no catalogue; type: footfit ingest-last FOLDER, or try: footfit demo"


def settled_kind(path: Path, busy_timeout_s: float) -> FileKind:
    """What lies at ``path`` once a journal that a kill or a power cut left is played back.

    Before it, a catalogue may look like no catalogue (its first page is torn) and one whose
    making was cut short like a catalogue (its first page was written first).

    Raises
    ------
    NotACatalogue, CatalogueNotWritable
        It is something else; it may not be read.
    sqlite3.Error
        Where SQLite cannot play it back; see ``engine.worded``.
    """
    kind = kind_of_file(path)
    if kind in ("catalogue", "interrupted") and has_live_journal(path):
        connected_for_reading(path, busy_timeout_s).close()
        kind = kind_of_file(path)
    return kind


def opened_for_reading(
    path: Path, schema: Schema, busy_timeout_s: float, *, older: bool = False
) -> tuple[CatalogueFile, Revisions]:
    """An existing catalogue, read-only; nothing is created, also not beside it.

    ``older`` accepts one of an older schema, to be checked or copied as it is.

    Raises
    ------
    NoCatalogue
        There is no file, or one that a killed first ingest left empty.
    NotACatalogue, NewerCatalogue, CatalogueUnusable
        The file is something else, or of another schema.
    """
    with worded(path):
        if settled_kind(path, busy_timeout_s) in ("missing", "empty"):
            raise NoCatalogue(NOTHING_THERE, str(path))
        connection = connected_for_reading(path, busy_timeout_s)
        try:
            if not older:
                require_current(connection, schema, path)
            revision = stored_revision(connection, schema, path)
        except BaseException:
            connection.close()
            raise
    return CatalogueFile(path, connection, writable=False), Revisions(revision, revision)


def opened_for_writing(
    path: Path, schema: Schema, busy_timeout_s: float, *, may_create: bool = True
) -> tuple[CatalogueFile, Revisions]:
    """A catalogue to write: made where there is none, upgraded where its schema is older.

    Raises
    ------
    NoCatalogue
        There is none, and it may not be made.
    CatalogueNotWritable, CatalogueLocked
        The file, its folder or another program does not let us.
    NotACatalogue, NewerCatalogue, CatalogueDamaged
        The file is something else, or of another schema; it is left as it is.
    """
    with worded(path):
        if settled_kind(path, busy_timeout_s) == "catalogue":
            revisions = _brought_up_to_date(path, schema, busy_timeout_s)
            connection = connected(path, "rw", busy_timeout_s)
        elif may_create:
            revisions = Revisions(schema.head, schema.head)
            connection = _made(path, schema, busy_timeout_s)
        else:
            raise NoCatalogue(NOTHING_THERE, str(path))
    return CatalogueFile(path, connection, writable=True), revisions


def _brought_up_to_date(path: Path, schema: Schema, busy_timeout_s: float) -> Revisions:
    """Upgrade where needed, and find a read-only file or folder before the work, not after it.

    SQLite opens a file it may not write without a word. Setting a mark to what it is, and
    rolling back, makes it say so, and makes it create its journal in the folder.
    """
    connection = connected(path, "rw", busy_timeout_s)
    try:
        revision = stored_revision(connection, schema, path)
        if revision == schema.head:
            connection.execute("BEGIN IMMEDIATE")
            connection.execute(f"PRAGMA user_version = {int(schema.head)}")
            connection.execute("ROLLBACK")
            return Revisions(revision, revision)
    finally:
        connection.close()
    return upgrade(path, schema, busy_timeout_s)


def _made(path: Path, schema: Schema, busy_timeout_s: float) -> sqlite3.Connection:
    _make_folder(path)
    connection = connected(path, "rwc", busy_timeout_s)
    try:
        create(connection, schema)
        require_current(connection, schema, path)
    except BaseException:
        connection.close()
        raise
    return connection


def _make_folder(path: Path) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CatalogueNotWritable(
            f"cannot be made: its folder cannot ({error.strerror})", str(path)
        ) from error
