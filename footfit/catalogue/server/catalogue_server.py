"""One open catalogue on a server: a connection, the two kinds of transaction, errors in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from footfit.catalogue.file.dialect import Driver, ServerConnection
from footfit.catalogue.file.engine import HELD, LACKS
from footfit.errors import (
    BadOption,
    CatalogueDamaged,
    CatalogueLocked,
    CatalogueNotWritable,
    CatalogueUnreachable,
    CatalogueUnusable,
    FootfitError,
)
from footfit.locations import ServerUrl

if TYPE_CHECKING:
    from sqlalchemy import Connection, Engine

NOT_INSTALLED = (
    "needs psycopg, which is not installed; type: python -m pip install 'footfit[postgres]'"
)
NOT_VALID = (
    "the address is not valid: each setting after the ? must be one of PostgreSQL's, as name=value;"
    " write a space as %20"
)
CONNECT_S = 10
LOCK = 0x466F6F74
"""The advisory lock of the writers: "Foot" in ASCII."""
_GONE = "the server has gone away; nothing was half stored: run the command again"
_BY_STATE: tuple[tuple[str, type[CatalogueUnusable], str], ...] = (
    ("55P03", CatalogueLocked, HELD),
    ("40", CatalogueLocked, HELD),
    ("42501", CatalogueNotWritable, "cannot be used: the user lacks a right; ask its owner"),
    ("25006", CatalogueNotWritable, "cannot be written: the server or the user is read-only"),
    ("53100", CatalogueNotWritable, "could not be written because the server's disk is full"),
    ("53", CatalogueUnreachable, "the server has no room for another connection; try later"),
    ("42P01", CatalogueDamaged, LACKS),
    ("42703", CatalogueDamaged, LACKS),
    ("57P", CatalogueUnreachable, _GONE),
    ("08", CatalogueUnreachable, _GONE),
    ("28", CatalogueUnreachable, "the server refuses the user"),
)
"""What PostgreSQL's error codes, or their beginnings, mean; the first one that fits counts."""


def connect(url: ServerUrl, patience_s: float = CONNECT_S) -> ServerConnection:
    """A connection in autocommit. A password comes from PGPASSWORD, .pgpass or the address.

    It is waited for as long as for a lock, but from 2 to `CONNECT_S` seconds.

    Raises
    ------
    BadOption
        psycopg is not installed, or libpq does not understand the address.
    CatalogueUnreachable
        The server does not answer, it has no such database, or it refuses the user.
    """
    try:
        import psycopg
        from psycopg.conninfo import conninfo_to_dict
    except ImportError as error:
        raise BadOption(NOT_INSTALLED, str(url)) from error
    try:
        parts = conninfo_to_dict(url.secret)
    except psycopg.Error:  # its words quote the address
        raise BadOption(NOT_VALID, str(url)) from None
    wait_s = round(min(max(patience_s, 2.0), CONNECT_S))  # libpq takes no less
    try:
        connection = psycopg.connect(
            url.secret, autocommit=True, connect_timeout=wait_s, client_encoding="utf8"
        )
    except psycopg.Error as error:
        secrets = [str(parts[name]) for name in ("password", "sslpassword") if parts.get(name)]
        raise _not_connected(error, url, secrets) from None
    return ServerConnection(connection)


def _not_connected(
    error: Exception, url: ServerUrl, secrets: Sequence[str]
) -> CatalogueUnreachable:
    """Why there is no connection. libpq's words are left out if they hold one of the secrets."""
    lines = [line for line in str(error).splitlines() if line.strip()]
    said = lines[0] if lines else type(error).__name__
    for before in ("failed: ", "FATAL: ", "fe_sendauth: "):
        said = said.rpartition(before)[2].strip()
    why = "" if any(secret in said for secret in secrets) else f" ({said})"
    if "password" in said:
        words = f"the server refuses the user{why}: set PGPASSWORD, or write ~/.pgpass"
    elif "database" in said and "does not exist" in said:
        words = f"the server has no such database{why}; make it with createdb"
    else:
        words = f"the server cannot be reached{why}; check the address, and that it runs"
    return CatalogueUnreachable(words, str(url))


def in_words(error: BaseException, url: ServerUrl) -> FootfitError | None:
    """PostgreSQL's error as footfit's; None for one that is not psycopg's."""
    import psycopg

    driver = getattr(error, "orig", error)
    if not isinstance(driver, psycopg.Error):
        return None
    if isinstance(driver, psycopg.DataError):
        words = "a server keeps no text with a NUL character, and no such number: change it"
        return BadOption(words, str(url))
    state = driver.sqlstate or ""
    for start, kind, words in _BY_STATE:
        if state.startswith(start):
            return kind(words, str(url))
    if isinstance(driver, psycopg.OperationalError):
        return CatalogueUnreachable(_GONE, str(url))
    said = (str(driver).splitlines() or [type(driver).__name__])[0]
    return CatalogueUnusable(f"the server refuses a statement: {said}", str(url))


@contextmanager
def server_errors_in_words(url: ServerUrl) -> Iterator[None]:
    """Turn PostgreSQL's errors, bare or wrapped by SQLAlchemy, into footfit's."""
    try:
        yield
    except CatalogueUnusable as error:
        raise error.at(str(url)) from error.__cause__
    except Exception as error:
        translation = in_words(error, url)
        if translation is None:
            raise
        raise translation from error


def engine_on(connection: ServerConnection, lock_timeout_s: float) -> Engine:
    """SQLAlchemy on an open connection; every transaction of it waits for the writers' lock.

    So what a transaction has read is still true when it writes, as in SQLite.
    """
    from sqlalchemy import create_engine, event
    from sqlalchemy.pool import StaticPool

    def begin(begun: Connection) -> None:
        begun.exec_driver_sql("BEGIN")
        begun.exec_driver_sql(f"SET LOCAL lock_timeout = {int(1000 * lock_timeout_s)}")
        begun.exec_driver_sql(f"SELECT pg_advisory_xact_lock({LOCK})")

    engine = create_engine(
        "postgresql+psycopg://", creator=lambda: connection.psycopg, poolclass=StaticPool
    )
    event.listen(engine, "begin", begin)
    return engine


@dataclass
class CatalogueServer:
    """One open catalogue on a server; its methods are those of a `CatalogueFile`."""

    path: ServerUrl
    connection: ServerConnection
    writable: bool
    lock_timeout_s: float

    @cached_property
    def _engine(self) -> Engine:
        return engine_on(self.connection, self.lock_timeout_s)

    @property
    def size_bytes(self) -> int:
        """How much room the database takes on the server."""
        select = "SELECT pg_database_size(current_database())"
        return int(self.connection.execute(select).fetchone()[0])

    @contextmanager
    def reading(self) -> Iterator[Driver]:
        """One snapshot for several SELECTs: no other program's commit falls between them."""
        with server_errors_in_words(self.path):
            self.connection.execute("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY")
            try:
                yield self.connection
            finally:
                if not self.connection.psycopg.closed and self.connection.in_transaction:
                    self.connection.execute("ROLLBACK")

    @contextmanager
    def atomic(self) -> Iterator[Connection]:
        """A transaction: all of the block is stored when it ends, or nothing, whatever kills it.

        Raises
        ------
        CatalogueLocked, CatalogueNotWritable, CatalogueUnreachable
            The block could not be begun, written or committed.
        """
        if not self.writable:
            raise CatalogueNotWritable("was opened for reading only", str(self.path))
        with server_errors_in_words(self.path), self._engine.begin() as connection:
            connection.exec_driver_sql("UPDATE alembic_version SET version_num = version_num")
            yield connection

    def compact(self) -> None:
        """Write the table of the fit log anew: no dead row of it is left in its file."""
        with server_errors_in_words(self.path):
            self.connection.execute("VACUUM FULL fit")

    def close(self) -> None:
        """Close the connection; nothing is pending outside of the two blocks above."""
        engine = self.__dict__.pop("_engine", None)
        if engine is not None:
            engine.dispose()
        self.connection.close()


NO_FILE = (
    "is on a server, which has its own backups: use pg_dump and pg_restore,"
    " or footfit copy-catalogue FROM TO"
)
