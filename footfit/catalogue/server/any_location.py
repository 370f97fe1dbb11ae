"""A catalogue opened wherever it is: in a file, or on a server."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from footfit.catalogue.file.descriptors import DESCRIPTORS
from footfit.catalogue.file.dialect import Driver, change_mark
from footfit.catalogue.file.engine import CatalogueFile
from footfit.catalogue.file.migrate import Revisions, Schema
from footfit.catalogue.file.opening import open_for_reading, open_for_writing
from footfit.locations import Location, ServerUrl

if TYPE_CHECKING:
    from footfit.catalogue.server.catalogue_server import CatalogueServer
    from footfit.catalogue.server.server_opening import Writing

OpenLocation: TypeAlias = "CatalogueFile | CatalogueServer"
"""An open catalogue: both have the same transactions."""


def open_location_for_reading(
    location: Location, schema: Schema, busy_timeout_s: float, *, older: bool = False
) -> tuple[OpenLocation, Revisions]:
    """An existing catalogue, read-only; see `open_for_reading` and `open_server_for_reading`."""
    if isinstance(location, ServerUrl):
        from footfit.catalogue.server.server_opening import open_server_for_reading

        return open_server_for_reading(location, schema, busy_timeout_s, older=older)
    return open_for_reading(location, schema, busy_timeout_s, older=older)


def open_location_for_writing(
    location: Location, schema: Schema, busy_timeout_s: float, how: Writing
) -> tuple[OpenLocation, Revisions]:
    """A catalogue to write; see `open_for_writing` and `open_server_for_writing`."""
    if isinstance(location, ServerUrl):
        from footfit.catalogue.server.server_opening import open_server_for_writing

        return open_server_for_writing(location, schema, busy_timeout_s, how)
    return open_for_writing(
        location, schema, busy_timeout_s, may_create=how.may_create, finish=how.finish
    )


def stamp_of(connection: Driver, location: Location) -> bytes:
    """A mark of the catalogue that every commit changes; taken inside a transaction."""
    if isinstance(location, ServerUrl):
        return change_mark(connection).encode()
    connection.execute("SELECT count(*) FROM alembic_version").fetchone()  # begins to read
    return DESCRIPTORS.first_bytes(location, 28)[24:]
