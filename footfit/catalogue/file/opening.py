"""How a catalogue file is opened: what it is, which schema it has, and who can write it."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from footfit.catalogue.file.engine import (
    CatalogueFile,
    connect,
    connect_for_reading,
    sqlite_errors_in_words,
)
from footfit.catalogue.file.file_signature import FileKind, has_live_journal, kind_of_file
from footfit.catalogue.file.migrate import (
    Finish,
    Revisions,
    Schema,
    create,
    stored_revision,
    upgrade,
)
from footfit.errors import NoCatalogue
from footfit.whole_files import require_folder

FIRST_STEPS = "type: footfit ingest-last FOLDER, or try: footfit demo"


def recovered_kind(path: Path, busy_timeout_s: float) -> FileKind:
    """What lies at ``path``, after a journal left by a kill or a power cut is played back.

    Before that, a catalogue may look like no catalogue, because its first page is torn; and a
    file that was being made may look like a catalogue, because its first page was written first.

    Raises
    ------
    NotACatalogue, CatalogueNotWritable
        It is something else; it cannot be read.
    sqlite3.Error
        SQLite cannot play the journal back; see ``engine.sqlite_errors_in_words``.
    """
    kind = kind_of_file(path)
    if kind in ("catalogue", "interrupted") and has_live_journal(path):
        connect_for_reading(path, busy_timeout_s).close()
        kind = kind_of_file(path)
    return kind


def open_for_reading(
    path: Path, schema: Schema, busy_timeout_s: float, *, older: bool = False
) -> tuple[CatalogueFile, Revisions]:
    """An existing catalogue, read-only; nothing is made, neither the file nor one beside it.

    ``older`` accepts one of an older schema, to be checked or copied as it is.

    Raises
    ------
    NoCatalogue
        There is no file, or one that a killed first ingest left empty.
    NotACatalogue, NewerCatalogue, CatalogueUnusable
        The file is something else, or of another schema.
    """
    with sqlite_errors_in_words(path):
        if recovered_kind(path, busy_timeout_s) in ("missing", "empty"):
            raise _no_catalogue(path)
        connection = connect_for_reading(path, busy_timeout_s)
        try:
            revision = stored_revision(connection, schema, path, older=older)
        except BaseException:
            connection.close()
            raise
    return CatalogueFile(path, connection, writable=False), Revisions(revision, revision)


def open_for_writing(
    path: Path,
    schema: Schema,
    busy_timeout_s: float,
    *,
    may_create: bool = True,
    finish: Finish = lambda _: None,
) -> tuple[CatalogueFile, Revisions]:
    """A catalogue to write: made if there is none, upgraded if its schema is older.

    ``finish`` is the last step of an upgrade.

    Raises
    ------
    NoCatalogue
        There is none, and it may not be made.
    BadOption
        There is none, and its folder is missing too.
    CatalogueNotWritable, CatalogueLocked
        The file or its folder cannot be written; another program holds the file.
    NotACatalogue, NewerCatalogue, CatalogueDamaged
        The file is something else, or of another schema; it is left as it is.
    """
    with sqlite_errors_in_words(path):
        if recovered_kind(path, busy_timeout_s) == "catalogue":
            revisions = _upgrade_if_older(path, schema, busy_timeout_s, finish)
            connection = connect(path, "rw", busy_timeout_s)
        elif may_create:
            revisions = Revisions(schema.head, schema.head, made=True)
            connection = _make(path, schema, busy_timeout_s)
        else:
            raise _no_catalogue(path)
    return CatalogueFile(path, connection, writable=True), revisions


def _no_catalogue(path: Path) -> NoCatalogue:
    return NoCatalogue(f"there is no catalogue; {FIRST_STEPS}", str(path))


def _upgrade_if_older(
    path: Path, schema: Schema, busy_timeout_s: float, finish: Finish
) -> Revisions:
    """Upgrade if needed, and find a read-only file or folder before the work, not after it.

    SQLite opens a file that it cannot write without an error. Setting a mark to the value that
    it has, and rolling back, makes SQLite say so, and makes it create its journal in the folder.
    """
    connection = connect(path, "rw", busy_timeout_s)
    try:
        revision = stored_revision(connection, schema, path)
        if revision == schema.head:
            connection.execute("BEGIN IMMEDIATE")
            connection.execute(f"PRAGMA user_version = {int(schema.head)}")
            connection.execute("ROLLBACK")
            return Revisions(revision, revision)
    finally:
        connection.close()
    return upgrade(path, schema, busy_timeout_s, finish)


def _make(path: Path, schema: Schema, busy_timeout_s: float) -> sqlite3.Connection:
    require_folder(path)
    connection = connect(path, "rwc", busy_timeout_s)
    try:
        create(connection, schema)
        stored_revision(connection, schema, path, older=False)
    except BaseException:
        connection.close()
        raise
    return connection
