"""How a catalogue on a server is opened: which schema it has, and who can write it."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.catalogue.file.dialect import (
    MARK_TABLE,
    ServerConnection,
    all_table_names,
    driver_of,
)
from footfit.catalogue.file.migrate import (
    Finish,
    Revisions,
    Schema,
    require_known_revision,
    run_migrations,
)
from footfit.catalogue.file.opening import FIRST_STEPS
from footfit.catalogue.server.catalogue_server import (
    CatalogueServer,
    connect,
    engine_on,
    server_errors_in_words,
)
from footfit.errors import CatalogueUnusable, NoCatalogue, NotACatalogue
from footfit.locations import ServerUrl


@dataclass(frozen=True, slots=True)
class Writing:
    """What an opening for writing may do: make a catalogue, upgrade one on a server.

    ``finish`` is the last step of an upgrade, in its transaction.
    """

    may_create: bool = True
    may_upgrade: bool = False
    finish: Finish = lambda _: None


def open_server_for_reading(
    url: ServerUrl, schema: Schema, lock_timeout_s: float, *, older: bool = False
) -> tuple[CatalogueServer, Revisions]:
    """An existing catalogue, for reading alone.

    Raises
    ------
    NoCatalogue
        The database holds no catalogue.
    CatalogueUnusable
        The server cannot be reached; the database is something else, or of another schema.
    """
    connection = connect(url, lock_timeout_s)
    try:
        with server_errors_in_words(url):
            revision = _stored_revision(connection, schema, url, older=older)
            if revision is None:
                raise NoCatalogue(f"there is no catalogue; {FIRST_STEPS}", str(url))
    except BaseException:
        connection.close()
        raise
    server = CatalogueServer(url, connection, False, lock_timeout_s)
    return server, Revisions(revision, revision)


def open_server_for_writing(
    url: ServerUrl,
    schema: Schema,
    lock_timeout_s: float,
    how: Writing,
) -> tuple[CatalogueServer, Revisions]:
    """A catalogue to write: made in an empty database, upgraded if ``how`` allows it.

    Other people share the server, and their older footfit cannot read a newer schema: only
    ``upgrade-catalogue`` changes it. The change is one transaction.

    Raises
    ------
    NoCatalogue
        There is none, and it may not be made.
    NotACatalogue, CatalogueUnusable
        The server cannot be reached; the database is something else, or of another schema.
    """
    connection = connect(url, lock_timeout_s)
    try:
        with server_errors_in_words(url):
            revisions = _prepared(connection, url, schema, lock_timeout_s, how)
    except BaseException:
        connection.close()
        raise
    return CatalogueServer(url, connection, True, lock_timeout_s), revisions


def _prepared(
    connection: ServerConnection,
    url: ServerUrl,
    schema: Schema,
    lock_timeout_s: float,
    how: Writing,
) -> Revisions:
    """Make or upgrade the tables if that is needed and allowed, under the writers' lock."""
    if _stored_revision(connection, schema, url) == schema.head:
        return Revisions(schema.head, schema.head)
    with engine_on(connection, lock_timeout_s).begin() as begun:
        before = _stored_revision(connection, schema, url)  # another process may have done it
        if before == schema.head:
            return Revisions(before, before)
        if before is None and not how.may_create:
            raise NoCatalogue(f"there is no catalogue; {FIRST_STEPS}", str(url))
        if before is not None and not how.may_upgrade:
            words = "make a backup with pg_dump, then type: footfit upgrade-catalogue"
            raise CatalogueUnusable(f"has the older schema {before!r}; {words}", str(url))
        run_migrations(begun, schema)
        if before is not None:
            how.finish(driver_of(begun))
    return Revisions(before or schema.head, schema.head, made=before is None)


def _stored_revision(
    connection: ServerConnection, schema: Schema, url: ServerUrl, *, older: bool = True
) -> str | None:
    """The revision of the catalogue; None if the database is empty.

    Raises
    ------
    NotACatalogue
        It has the tables of another program.
    NewerCatalogue, CatalogueDamaged, CatalogueUnusable
        As `require_known_revision`.
    """
    names = all_table_names(connection)  # in one statement: another process may make them now
    if MARK_TABLE not in names:
        if names:
            words = "has the tables of another program; name an empty database"
            raise NotACatalogue(words, str(url))
        return None
    rows = connection.execute("SELECT version_num FROM alembic_version").fetchall()
    revision = str(rows[0][0]) if len(rows) == 1 else None
    return require_known_revision(revision, schema, url, older=older)
