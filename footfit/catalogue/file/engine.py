"""Connections to a catalogue file: SQLite's settings, transactions, errors in footfit's words.

Reading uses Python's driver alone. SQLAlchemy is imported at the first write.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from footfit.catalogue.file.descriptors import DESCRIPTORS, OpenMode
from footfit.catalogue.file.file_signature import NOT_A_CATALOGUE
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
        "PRAGMA secure_delete = ON",
    )


SETTINGS = Settings()

HELD = "is held by another program; wait until it is done, then try again"
LACKS = "lacks a table or a column that it must have; restore it from a backup"
_SAFE = "all that was stored before is still there"
_BY_RESULT_CODE: dict[int, tuple[type[CatalogueUnusable], str]] = {
    sqlite3.SQLITE_BUSY: (CatalogueLocked, HELD),
    sqlite3.SQLITE_LOCKED: (CatalogueLocked, HELD),
    sqlite3.SQLITE_READONLY: (
        CatalogueNotWritable,
        "cannot be written; check who may write the file and its folder",
    ),
    sqlite3.SQLITE_FULL: (
        CatalogueNotWritable,
        f"could not be written because the disk is full; {_SAFE}",
    ),
    sqlite3.SQLITE_IOERR: (
        CatalogueNotWritable,
        f"could not be read or written (disk error); {_SAFE}",
    ),
    sqlite3.SQLITE_CANTOPEN: (
        CatalogueNotWritable,
        "or its journal cannot be opened; check who may use the file and its folder",
    ),
    sqlite3.SQLITE_NOTADB: (NotACatalogue, NOT_A_CATALOGUE),
    sqlite3.SQLITE_CORRUPT: (
        CatalogueDamaged,
        "is damaged: restore it from a backup, or see footfit check-catalogue",
    ),
}


def in_words(error: BaseException, path: Path) -> CatalogueUnusable | None:
    """SQLite's error as footfit's; None for one that is not the fault of the file or the disk."""
    driver = getattr(error, "orig", error)
    if isinstance(driver, UnicodeDecodeError):  # in a column's name: values are read leniently
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
def sqlite_errors_in_words(path: Path) -> Iterator[None]:
    """Turn SQLite's errors, bare or wrapped by SQLAlchemy, into footfit's, naming the file."""
    try:
        yield
    except CatalogueUnusable as error:
        raise error.at(str(path)) from error.__cause__
    except Exception as error:
        translation = in_words(error, path)
        if translation is None:
            raise
        raise translation from error


def lenient_text(data: bytes) -> str:
    """Text as stored, broken UTF-8 kept: one bad byte must not hide every other last."""
    return data.decode("utf-8", "surrogateescape")


def connect(
    path: Path, mode: OpenMode, busy_timeout_s: float = SETTINGS.busy_timeout_s
) -> sqlite3.Connection:
    """A connection with footfit's settings, in autocommit: footfit begins its transactions itself.

    Raises
    ------
    sqlite3.Error
        SQLite cannot open the file; see :func:`sqlite_errors_in_words`.
    """
    connection = DESCRIPTORS.connect(path, mode, busy_timeout_s)
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


def connect_for_reading(path: Path, busy_timeout_s: float) -> sqlite3.Connection:
    """A read-only connection; a write that was killed half way is rolled back first.

    SQLite cannot roll back through a read-only connection. Without this, the first reader after
    a kill could not read the catalogue until somebody writes to it.
    """
    connection = connect(path, "ro", busy_timeout_s)
    try:
        connection.execute("PRAGMA user_version").fetchone()
        return connection
    except BaseException as error:
        connection.close()
        if getattr(error, "sqlite_errorcode", None) != sqlite3.SQLITE_READONLY_ROLLBACK:
            raise
    with closing(connect(path, "rw", busy_timeout_s)) as writable:
        writable.execute("PRAGMA user_version").fetchone()
    return connect(path, "ro", busy_timeout_s)


def engine_on(connection: sqlite3.Connection) -> Engine:
    """SQLAlchemy on an open connection; every transaction of it is BEGIN IMMEDIATE.

    A deferred transaction that reads and then writes fails at once where another program wrote
    in between, whatever the timeout: with 8 writers 35 to 180 of 200 failed, with IMMEDIATE none.
    """
    from sqlalchemy import create_engine, event
    from sqlalchemy.pool import StaticPool

    engine = create_engine("sqlite://", creator=lambda: connection, poolclass=StaticPool)
    event.listen(engine, "begin", lambda begun: begun.exec_driver_sql("BEGIN IMMEDIATE"))
    return engine


@dataclass
class CatalogueFile:
    """One open catalogue file: a connection and the two kinds of transaction on it."""

    path: Path
    connection: sqlite3.Connection
    writable: bool

    @property
    def size_bytes(self) -> int:
        """How large the file is."""
        return self.path.stat().st_size

    @cached_property
    def _engine(self) -> Engine:
        return engine_on(self.connection)

    @contextmanager
    def reading(self) -> Iterator[sqlite3.Connection]:
        """One snapshot for several SELECTs: no other program's commit falls between them."""
        with sqlite_errors_in_words(self.path):
            self.connection.execute("BEGIN")
            try:
                yield self.connection
            finally:
                # On a full disk or an I/O error SQLite ends the transaction itself. A second
                # ROLLBACK would then raise, and hide the first error.
                if self.connection.in_transaction:
                    self.connection.execute("ROLLBACK")

    @contextmanager
    def atomic(self) -> Iterator[Connection]:
        """A transaction: all of the block is stored when it ends, or nothing, whatever kills it.

        The lock is taken before the first read, so that what the block has read is still true
        when it writes. On any error nothing is stored: nobody can see or rank half a last.

        Raises
        ------
        CatalogueLocked, CatalogueNotWritable, CatalogueDamaged
            The block could not be begun, written or committed.
        """
        if not self.writable:
            raise CatalogueNotWritable("was opened for reading only", str(self.path))
        with sqlite_errors_in_words(self.path), self._engine.begin() as connection:
            yield connection

    def compact(self) -> None:
        """Write the file anew without its free pages: nothing that was deleted is left in them.

        Raises
        ------
        CatalogueLocked, CatalogueNotWritable, CatalogueDamaged
            The file is as it was.
        """
        with sqlite_errors_in_words(self.path):
            self.connection.execute("VACUUM")

    def close(self) -> None:
        """Close the file; nothing is pending outside of the two blocks above."""
        engine = self.__dict__.pop("_engine", None)
        if engine is not None:
            engine.dispose()
        self.connection.close()
