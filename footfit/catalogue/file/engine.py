"""Connections to a catalogue file: SQLite's settings, transactions, errors in footfit's words.

Reading goes through the driver alone; SQLAlchemy is opened at the first write.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from footfit.catalogue.file.descriptors import HANDLES, FileConnection
from footfit.errors import (
    CatalogueDamaged,
    CatalogueLocked,
    CatalogueNotWritable,
    CatalogueUnusable,
    NotACatalogue,
)

if TYPE_CHECKING:
    from sqlalchemy import Connection, Engine


@dataclass(frozen=True, slots=True)
class Settings:
    """SQLite's settings, each for a measured reason (docs/catalogue.md)."""

    busy_timeout_s: float = 30.0
    for_all: tuple[str, ...] = (
        "PRAGMA foreign_keys = ON",
        "PRAGMA trusted_schema = OFF",
        "PRAGMA cell_size_check = ON",
    )
    for_writers: tuple[str, ...] = (
        "PRAGMA journal_mode = DELETE",
        "PRAGMA synchronous = EXTRA",
    )


SETTINGS = Settings()

LACKS = "lacks a table or a column that it must have; restore it from a backup"

OpenMode = Literal["ro", "rw", "rwc"]

_BY_RESULT_CODE: dict[int, tuple[type[CatalogueUnusable], str]] = {
    sqlite3.SQLITE_BUSY: (
        CatalogueLocked,
        "is held by another program; wait until it is done, then try again",
    ),
    sqlite3.SQLITE_LOCKED: (
        CatalogueLocked,
        "is held by another program; wait until it is done, then try again",
    ),
    sqlite3.SQLITE_READONLY: (
        CatalogueNotWritable,
        "may not be written; check who may write the file and its folder",
    ),
    sqlite3.SQLITE_FULL: (
        CatalogueNotWritable,
        "could not be written: the disk is full; what was stored before is whole",
    ),
    sqlite3.SQLITE_IOERR: (
        CatalogueNotWritable,
        "could not be read or written (disk error); what was stored before is whole",
    ),
    sqlite3.SQLITE_CANTOPEN: (
        CatalogueNotWritable,
        "or its journal cannot be opened; check who may use the file and its folder",
    ),
    sqlite3.SQLITE_NOTADB: (
        NotACatalogue,
        "is not a footfit catalogue and was left as it is",
    ),
    sqlite3.SQLITE_CORRUPT: (
        CatalogueDamaged,
        "is damaged: restore it from a backup, or see footfit check-catalogue",
    ),
}


def in_words(error: BaseException, path: Path) -> CatalogueUnusable | None:
    """SQLite's error as footfit's; None for one that is no fault of the file or the disk."""
    driver = getattr(error, "orig", error)
    if isinstance(driver, UnicodeDecodeError):  # a column's name: values are read leniently
        return CatalogueDamaged("has a damaged schema; restore it from a backup", str(path))
    if not isinstance(driver, sqlite3.Error):
        return None
    # The extended code keeps the primary one in its low byte.
    code = getattr(driver, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
    if code in _BY_RESULT_CODE:
        kind, words = _BY_RESULT_CODE[code]
        return kind(words, str(path))
    if code == sqlite3.SQLITE_ERROR and ("no such" in str(driver) or "no column" in str(driver)):
        return CatalogueDamaged(LACKS, str(path))
    return None


@contextmanager
def worded(path: Path) -> Iterator[None]:
    """Turn SQLite's errors, bare or wrapped by SQLAlchemy, into footfit's, naming the file."""
    try:
        yield
    except CatalogueUnusable as error:
        raise error.at(str(path)) from error.__cause__
    except Exception as error:
        words = in_words(error, path)
        if words is None:
            raise
        raise words from error


def lenient_text(data: bytes) -> str:
    """Text as stored, broken UTF-8 kept: one bad byte must not hide every other last."""
    return data.decode("utf-8", "surrogateescape")


def connected(
    path: Path, mode: OpenMode, busy_timeout_s: float = SETTINGS.busy_timeout_s
) -> sqlite3.Connection:
    """A connection with footfit's settings, in autocommit: transactions are begun by hand.

    Raises
    ------
    sqlite3.Error
        Where SQLite cannot open the file; see :func:`worded`.
    """
    connection = HANDLES.connect(path, partial(_opened, path, mode, busy_timeout_s))
    connection.text_factory = lenient_text
    try:
        for pragma in SETTINGS.for_all:
            connection.execute(pragma)
        if mode != "ro":
            for pragma in SETTINGS.for_writers:
                connection.execute(pragma)
    except BaseException:
        connection.close()
        raise
    return connection


def _opened(path: Path, mode: OpenMode, busy_timeout_s: float) -> FileConnection:
    return sqlite3.connect(
        f"{path.absolute().as_uri()}?mode={mode}",
        uri=True,
        isolation_level=None,
        timeout=busy_timeout_s,
        factory=FileConnection,
    )


def connected_for_reading(path: Path, busy_timeout_s: float) -> sqlite3.Connection:
    """A read-only connection; a write that a kill left half done is rolled back first.

    SQLite cannot roll back through a read-only connection: without this, the first reader
    after a kill would find the catalogue unreadable until somebody writes.
    """
    connection = connected(path, "ro", busy_timeout_s)
    try:
        connection.execute("PRAGMA user_version").fetchone()
    except sqlite3.OperationalError as error:
        connection.close()
        if error.sqlite_errorcode != sqlite3.SQLITE_READONLY_ROLLBACK:
            raise
        with closing(connected(path, "rw", busy_timeout_s)) as writable:
            writable.execute("PRAGMA user_version").fetchone()
        return connected(path, "ro", busy_timeout_s)
    except BaseException:
        connection.close()
        raise
    return connection


def engine_on(connection: sqlite3.Connection) -> Engine:
    """SQLAlchemy on an open connection; every transaction of it is BEGIN IMMEDIATE.

    A deferred transaction that reads and then writes fails at once where another one wrote in
    between, whatever the timeout: with 8 writers 35 to 180 of 200 did, with IMMEDIATE none.
    """
    from sqlalchemy import create_engine, event
    from sqlalchemy.pool import StaticPool

    engine = create_engine("sqlite://", creator=lambda: connection, poolclass=StaticPool)
    event.listen(engine, "begin", lambda opened: opened.exec_driver_sql("BEGIN IMMEDIATE"))
    return engine


class CatalogueFile:
    """One open catalogue file: a connection and the two kinds of transaction on it."""

    def __init__(self, path: Path, connection: sqlite3.Connection, *, writable: bool) -> None:
        self.path = path
        self.connection = connection
        self.writable = writable

    @cached_property
    def _engine(self) -> Engine:
        return engine_on(self.connection)

    @contextmanager
    def reading(self) -> Iterator[sqlite3.Connection]:
        """One snapshot for several SELECTs: a writer's commit cannot fall between them."""
        with worded(self.path):
            self.connection.execute("BEGIN")
            try:
                yield self.connection
            finally:
                # SQLite ends a transaction by itself on a full disk or an I/O error; a second
                # ROLLBACK would then raise and hide the first error.
                if self.connection.in_transaction:
                    self.connection.execute("ROLLBACK")

    @contextmanager
    def atomic(self) -> Iterator[Connection]:
        """All of the block or nothing of it, whatever kills it; committed when it ends.

        The lock is taken before the first read, so that what the block read is still true
        when it writes. On any error nothing is kept: no half last can be seen or ranked.

        Raises
        ------
        CatalogueLocked, CatalogueNotWritable, CatalogueDamaged
            The block could not be begun, written or committed.
        """
        if not self.writable:
            raise CatalogueNotWritable("was opened for reading only", str(self.path))
        with worded(self.path), self._engine.begin() as connection:
            yield connection

    def close(self) -> None:
        """Give the file back; nothing is pending outside of the two blocks above."""
        engine = self.__dict__.pop("_engine", None)
        if engine is not None:
            engine.dispose()
        self.connection.close()
