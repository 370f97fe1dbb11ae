"""The two dialects of SQL: footfit's statements are SQLite's; here they become PostgreSQL's.

A `ServerConnection` takes the statements that `sqlite3` takes and gives the values that `sqlite3`
gives, so that rows, hashes and checks are the same on both.
"""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import psycopg
    import sqlalchemy as sa

NAMES_OF_TABLES = "SELECT name FROM sqlite_schema WHERE type = 'table'"
NAMES_ON_SERVER = (
    "SELECT table_name FROM information_schema.tables"
    " WHERE table_schema = current_schema() AND table_type = 'BASE TABLE'"
)
MARK_TABLE = "alembic_version"
"""Alembic's table; it holds the schema's revision and nothing else."""


class Cursor(Protocol):
    """The rows of a SELECT."""

    @property
    def description(self) -> Any:
        """The columns; the name of each comes first."""

    def fetchone(self) -> Any:
        """The next row."""

    def fetchall(self) -> list[Any]:
        """All rows that are left."""

    def __iter__(self) -> Iterator[Any]:
        """The rows."""


class Driver(Protocol):
    """A connection that takes footfit's statements: of `sqlite3`, or a `ServerConnection`."""

    def execute(self, sql: str, parameters: Sequence[Any] = ..., /) -> Cursor:
        """Carry out one statement."""

    def executemany(self, sql: str, parameters: Iterable[Sequence[Any]], /) -> Cursor:
        """Carry out one statement for each row of parameters."""


class ServerConnection:
    """A connection to PostgreSQL, in autocommit: footfit begins its transactions itself."""

    def __init__(self, psycopg_connection: psycopg.Connection[Any]) -> None:
        self.psycopg = psycopg_connection
        _read_flags_as_numbers(psycopg_connection)

    def execute(self, sql: str, parameters: Sequence[Any] = (), /) -> Cursor:
        """Carry out one statement."""
        cursor = self.psycopg.cursor(binary=True)
        return cursor.execute(on_server(sql), parameters or None)

    def executemany(self, sql: str, parameters: Iterable[Sequence[Any]], /) -> Cursor:
        """Carry out one statement for each row of parameters."""
        cursor = self.psycopg.cursor()
        cursor.executemany(on_server(sql), parameters)
        return cursor

    @property
    def in_transaction(self) -> bool:
        """Whether a transaction goes on, also one that failed."""
        return self.psycopg.info.transaction_status.name != "IDLE"

    def close(self) -> None:
        """Close it; a second call does nothing."""
        self.psycopg.close()


@lru_cache(maxsize=256)
def on_server(sql: str) -> str:
    """A statement of SQLite as PostgreSQL takes it.

    A table is read in the order of its keys, which SQLite has as the order of storage.

    Examples
    --------
    >>> on_server("SELECT * FROM last NOT INDEXED WHERE id = ? ORDER BY rowid")
    'SELECT * FROM last WHERE id = %s ORDER BY 1'
    """
    plain = sql.replace("%", "%%") if "?" in sql else sql
    plain = plain.replace(" NOT INDEXED", "").replace("ORDER BY rowid", "ORDER BY 1")
    return re.sub(r"\?", "%s", plain)


def driver_of(connection: sa.Connection) -> Driver:
    """The driver's connection under SQLAlchemy's, inside the same transaction."""
    driver = connection.connection.driver_connection
    if isinstance(driver, sqlite3.Connection):
        return driver
    assert driver is not None
    return ServerConnection(driver)


def table_names(connection: Driver) -> list[str]:
    """The names of all tables but Alembic's, sorted."""
    return [name for name in all_table_names(connection) if name != MARK_TABLE]


def all_table_names(connection: Driver) -> list[str]:
    """The names of all tables, sorted."""
    select = NAMES_ON_SERVER if isinstance(connection, ServerConnection) else NAMES_OF_TABLES
    return sorted(str(name) for (name,) in connection.execute(select))


def change_mark(connection: Driver) -> str:
    """A mark that differs after another program changed the catalogue; for one connection."""
    if isinstance(connection, ServerConnection):
        (mark,) = connection.execute("SELECT xmin::text FROM alembic_version").fetchone()
    else:
        (mark,) = connection.execute("PRAGMA data_version").fetchone()
    return str(mark)


def column_names(connection: Driver) -> dict[str, set[str]]:
    """The columns of each table on a server."""
    select = (
        "SELECT table_name, column_name FROM information_schema.columns"
        " WHERE table_schema = current_schema()"
    )
    names: dict[str, set[str]] = {}
    for table, column in connection.execute(select):
        names.setdefault(str(table), set()).add(str(column))
    return names


def _read_flags_as_numbers(connection: psycopg.Connection[Any]) -> None:
    """Read a boolean as 0 or 1, as SQLite gives it: hashes tell types apart."""
    from psycopg.adapt import Loader
    from psycopg.pq import Format

    class _Flag(Loader):
        def load(self, data: Any) -> int:
            return int(bytes(data) in (b"t", b"\x01"))

    class _BinaryFlag(_Flag):
        format = Format.BINARY

    for loader in (_Flag, _BinaryFlag):
        connection.adapters.register_loader("bool", loader)
