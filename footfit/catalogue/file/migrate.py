"""New catalogues, and catalogues of an older schema: both by Alembic's migrations."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from footfit.catalogue.file.copying import copy_into, settled
from footfit.catalogue.file.engine import connected, engine_on
from footfit.catalogue.file.file_signature import MARKS
from footfit.errors import (
    CatalogueDamaged,
    CatalogueNotWritable,
    CatalogueUnusable,
    NewerCatalogue,
)

if TYPE_CHECKING:
    from sqlalchemy import Connection


def migrations_folder() -> Path:
    """Where the migrations lie: inside an installed footfit, else beside it in the source tree."""
    package = Path(__file__).resolve().parents[2]
    shipped = package / "_migrations"
    return shipped if shipped.is_dir() else package.parent / "migrations"


@dataclass(frozen=True, slots=True)
class Schema:
    """The schema that this footfit writes: its revisions, oldest first, and their scripts."""

    revisions: tuple[str, ...] = MARKS.revisions
    folder: Path = field(default_factory=migrations_folder)

    @property
    def head(self) -> str:
        """The newest revision."""
        return self.revisions[-1]

    def up_to(self, revision: str) -> Schema:
        """The schema as it was when ``revision`` was its head."""
        return Schema(self.revisions[: self.revisions.index(revision) + 1], self.folder)


@dataclass(frozen=True, slots=True)
class Revisions:
    """What an opening did to the schema: the same revision twice and no backup if nothing."""

    before: str
    after: str
    backup: str | None = None


def stored_revision(connection: sqlite3.Connection, schema: Schema, path: Path) -> str:
    """The revision of an open catalogue, one of ``schema.revisions``.

    Raises
    ------
    NewerCatalogue
        A later footfit wrote it.
    CatalogueDamaged
        It says no revision, or one that never was.
    """
    (mirror,) = connection.execute("PRAGMA user_version").fetchone()
    rows = connection.execute("SELECT version_num FROM alembic_version").fetchall()
    revision = str(rows[0][0]) if len(rows) == 1 else None
    later = mirror > int(schema.head) or (
        revision is not None and revision.isdecimal() and int(revision) > int(schema.head)
    )
    if later:
        newest = max(f"{mirror:04d}", revision or "")
        raise NewerCatalogue(
            f"has schema {newest!r} and this footfit reads up to {schema.head!r}; update footfit",
            str(path),
        )
    if revision not in schema.revisions:
        raise CatalogueDamaged(
            f"says it has schema {revision!r}, which never was; restore it from a backup",
            str(path),
        )
    return revision


def require_current(connection: sqlite3.Connection, schema: Schema, path: Path) -> None:
    """Refuse a catalogue that only a writable opening can bring up to date.

    Raises
    ------
    CatalogueUnusable
        Its schema is older than this footfit's.
    NewerCatalogue, CatalogueDamaged
        See :func:`stored_revision`.
    """
    revision = stored_revision(connection, schema, path)
    if revision != schema.head:
        raise CatalogueUnusable(
            f"has the older schema {revision!r}; type: footfit upgrade-catalogue", str(path)
        )


def create(connection: sqlite3.Connection, schema: Schema) -> None:
    """Make an empty file a catalogue, in one transaction; nothing where another process did.

    Raises
    ------
    sqlalchemy.exc.DBAPIError
        Where SQLite cannot write.
    """
    with _migrating(connection) as opened:
        # Several processes may find the same empty file: the first one in makes it, under the
        # lock, and the others see here that it is made.
        if _application_id(connection) == MARKS.application_id:
            return
        opened.exec_driver_sql(f"PRAGMA application_id = {MARKS.application_id}")
        _run_migrations(opened, schema)


def upgrade(path: Path, schema: Schema, busy_timeout_s: float) -> Revisions:
    """Bring a catalogue to the newest schema, after a whole copy was laid beside it.

    The lock is held from before the copy until the commit, so that the copy is what was
    migrated. Foreign keys are off meanwhile: SQLite alters a table by making it anew, and with
    them on the drop of the old one would delete every row that depends on it.

    Raises
    ------
    CatalogueDamaged
        A row points to no row after the migration; nothing was changed.
    CatalogueNotWritable
        The copy cannot be written.
    """
    with closing(connected(path, "rw", busy_timeout_s)) as connection:
        connection.execute("PRAGMA foreign_keys = OFF")
        with _migrating(connection) as opened:
            revision = stored_revision(connection, schema, path)
            if revision == schema.head:  # another process upgraded it meanwhile
                return Revisions(revision, revision)
            backup = _copy_beside(path, revision, busy_timeout_s)
            _run_migrations(opened, schema)
            if connection.execute("PRAGMA foreign_key_check").fetchone():
                raise CatalogueDamaged(
                    "has rows that point to no last; it was not upgraded", str(path)
                )
    return Revisions(revision, schema.head, str(backup))


def copy_path(path: Path, revision: str) -> Path:
    """Where the copy lies that is made before an upgrade from ``revision``."""
    return path.with_name(f"{path.name}.schema-{revision}")


@contextmanager
def _migrating(connection: sqlite3.Connection) -> Iterator[Connection]:
    """The connection as SQLAlchemy's, in one BEGIN IMMEDIATE that holds DDL and marks alike."""
    with engine_on(connection).connect() as opened, opened.begin():
        yield opened


def _run_migrations(opened: Connection, schema: Schema) -> None:
    from alembic import command
    from alembic.config import Config

    config = Config(attributes={"connection": opened})
    config.set_main_option("script_location", str(schema.folder).replace("%", "%%"))
    command.upgrade(config, schema.head)
    opened.exec_driver_sql(f"PRAGMA user_version = {int(schema.head)}")


def _copy_beside(path: Path, revision: str, busy_timeout_s: float) -> Path:
    """A whole, defragmented copy under its final name only once it is complete."""
    final = copy_path(path, revision)
    partial = final.with_name(final.name + ".partial")
    try:
        partial.unlink(missing_ok=True)
        copy_into(path, partial, busy_timeout_s)
        settled(partial, final, replace=True)
    except OSError as error:
        raise CatalogueNotWritable(
            f"could not be copied before its upgrade ({error.strerror})", str(path)
        ) from error
    return final


def _application_id(connection: sqlite3.Connection) -> int:
    (value,) = connection.execute("PRAGMA application_id").fetchone()
    return int(value)
