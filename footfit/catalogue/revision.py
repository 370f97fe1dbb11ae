"""Which schema a catalogue file has, before anything opens it for writing."""

from __future__ import annotations

from pathlib import Path

from footfit.catalogue.engine import SETTINGS, connected_for_reading, worded
from footfit.catalogue.marks import kind_of_file
from footfit.catalogue.migrate import Schema, copy_path, stored_revision
from footfit.catalogue.opening import NOTHING_THERE
from footfit.errors import NoCatalogue


def revision_of(path: Path, schema: Schema | None = None) -> str:
    """The schema revision of an existing catalogue, an older one too; nothing is changed.

    Raises
    ------
    NoCatalogue
        There is none.
    NotACatalogue, NewerCatalogue, CatalogueDamaged
        The file is something else, of a later footfit, or broken.
    """
    with worded(path):
        if kind_of_file(path) in ("missing", "empty"):
            raise NoCatalogue(NOTHING_THERE, str(path))
        connection = connected_for_reading(path, SETTINGS.busy_timeout_s)
        try:
            return stored_revision(connection, schema or Schema(), path)
        finally:
            connection.close()


def upgrade_copy(path: Path, revision: str) -> Path | None:
    """The copy that an upgrade from ``revision`` laid beside the catalogue, if it did."""
    copy = copy_path(path, revision)
    return copy if copy.is_file() else None
