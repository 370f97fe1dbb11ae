"""New catalogues, and catalogues of an older schema: Alembic's migrations make both."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from footfit.catalogue.file.copying import copy_into, partial_beside
from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.file.engine import connect, engine_on
from footfit.catalogue.file.file_signature import SIGNATURE
from footfit.errors import CatalogueDamaged, CatalogueUnusable, NewerCatalogue
from footfit.locations import Location
from footfit.whole_files import give_name

if TYPE_CHECKING:
    from sqlalchemy import Connection

Finish = Callable[[Driver], object]
"""What is done after the migrations of an older catalogue, in their transaction."""


@cache
def migrations_folder() -> Path:
    """The folder of the migrations: inside an installed footfit, beside it in a source tree."""
    package = Path(__file__).resolve().parents[2]
    shipped = package / "_migrations"
    return shipped if shipped.is_dir() else package.parent / "migrations"


@dataclass(frozen=True, slots=True)
class Schema:
    """The schema that this footfit writes: its revisions, oldest first, and their scripts."""

    revisions: tuple[str, ...] = SIGNATURE.revisions
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
    """The schema before and after an opening; ``backup`` is the copy that an upgrade made.

    ``made`` is True if the opening made the file.
    """

    before: str
    after: str
    backup: str | None = None
    made: bool = False


def stored_revision(
    connection: sqlite3.Connection, schema: Schema, path: Path, *, older: bool = True
) -> str:
    """The revision of an open catalogue, one of ``schema.revisions``.

    Raises
    ------
    NewerCatalogue
        A later footfit wrote it.
    CatalogueDamaged
        It names no revision, or one that never existed.
    CatalogueUnusable
        It is older than the newest one, and ``older`` does not accept that.
    """
    (mirror,) = connection.execute("PRAGMA user_version").fetchone()
    rows = connection.execute("SELECT version_num FROM alembic_version").fetchall()
    revision = str(rows[0][0]) if len(rows) == 1 else None
    return require_known_revision(revision, schema, path, older=older, mirror=mirror)


def require_known_revision(
    revision: str | None, schema: Schema, place: Location, *, older: bool = True, mirror: int = 0
) -> str:
    """The revision that a catalogue names, if it is one of ``schema.revisions``.

    ``mirror`` repeats it as a number in a file.

    Raises
    ------
    NewerCatalogue, CatalogueDamaged, CatalogueUnusable
        As `stored_revision`.
    """
    later = mirror > int(schema.head) or (
        revision is not None and revision.isdecimal() and int(revision) > int(schema.head)
    )
    if later:
        newest = max(f"{mirror:04d}", revision or "")
        raise NewerCatalogue(
            f"has schema {newest!r} and this footfit reads up to {schema.head!r}; update footfit",
            str(place),
        )
    if revision not in schema.revisions:
        raise CatalogueDamaged(
            f"names the schema {revision!r}, which does not exist; restore it from a backup",
            str(place),
        )
    if not older and revision != schema.head:
        import shlex

        raise CatalogueUnusable(
            f"has the older schema {revision!r}; type: footfit upgrade-catalogue --catalogue"
            f" {shlex.quote(str(place))}",
            str(place),
        )
    return revision


def create(connection: sqlite3.Connection, schema: Schema) -> None:
    """Make an empty file a catalogue, in one transaction; do nothing if it is one already.

    Raises
    ------
    sqlalchemy.exc.DBAPIError
        SQLite cannot write.
    """
    with engine_on(connection).begin() as begun:
        # Several processes may meet the same empty file. The first one makes it a catalogue
        # under the lock; the others see here that it is one.
        (application_id,) = connection.execute("PRAGMA application_id").fetchone()
        if application_id == SIGNATURE.application_id:
            return
        begun.exec_driver_sql(f"PRAGMA application_id = {SIGNATURE.application_id}")
        run_migrations(begun, schema)


def upgrade(path: Path, schema: Schema, busy_timeout_s: float, finish: Finish) -> Revisions:
    """Bring a catalogue to the newest schema; a whole copy is put beside it first.

    The lock is held from before the copy until the commit, so that the copy is what was
    migrated. Foreign keys are off meanwhile: SQLite changes a table by making a new one, and
    with them on, dropping the old one would delete every row that depends on it. ``finish``
    fills what the migrations cannot, in the same transaction.

    Raises
    ------
    CatalogueDamaged
        A row points to no row after the migration; nothing was changed.
    CatalogueNotWritable
        The copy cannot be written.
    """
    with closing(connect(path, "rw", busy_timeout_s)) as connection:
        connection.execute("PRAGMA foreign_keys = OFF")
        with engine_on(connection).begin() as begun:
            revision = stored_revision(connection, schema, path)
            if revision == schema.head:  # another process upgraded it meanwhile
                return Revisions(revision, revision)
            backup = copy_path(path, revision)
            with partial_beside(backup) as partial:
                copy_into(path, partial, busy_timeout_s)
                give_name(partial, backup, replace=True)
            run_migrations(begun, schema)
            finish(connection)
            if connection.execute("PRAGMA foreign_key_check").fetchone():
                raise CatalogueDamaged(
                    "has rows that belong to no last; it was not upgraded", str(path)
                )
    return Revisions(revision, schema.head, str(backup))


def copy_path(path: Path, revision: str) -> Path:
    """The path of the copy that is made before an upgrade from ``revision``."""
    return path.with_name(f"{path.name}.schema-{revision}")


def run_migrations(begun: Connection, schema: Schema) -> None:
    """Carry out the migrations that are left, in the caller's transaction."""
    from alembic import command
    from alembic.config import Config

    config = Config(attributes={"connection": begun})
    config.set_main_option("script_location", str(schema.folder).replace("%", "%%"))
    command.upgrade(config, schema.head)
    if begun.dialect.name == "sqlite":
        begun.exec_driver_sql(f"PRAGMA user_version = {int(schema.head)}")
