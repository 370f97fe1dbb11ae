"""All rows of one catalogue into another, empty one: of a file or a server, without loss."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.catalogue.file.dialect import Driver, driver_of
from footfit.catalogue.rows.columns import FIT, LAST, TABLES
from footfit.catalogue.rows.verified_rows import last_names, rows, stored_lasts
from footfit.catalogue.rows.writing import insert_rows
from footfit.catalogue.server.any_location import OpenLocation
from footfit.errors import BadOption, CatalogueDamaged

if TYPE_CHECKING:
    import sqlalchemy as sa

OWNED = tuple(table for table in TABLES if table.columns[0].on_delete == "CASCADE")
"""The tables with rows that belong to a last."""
WHOLE = tuple(table for table in TABLES if table not in (LAST, *OWNED))


@dataclass(frozen=True, slots=True)
class Copied:
    """How many lasts and entries of the fit log were copied."""

    lasts: int
    fits: int


def copy_rows(source: OpenLocation, target: OpenLocation) -> Copied:
    """Copy every row with its keys and hashes in one transaction; each last is verified there.

    One last is in memory at a time.

    Raises
    ------
    BadOption
        The target holds a last or an entry of the fit log.
    CatalogueDamaged
        A last is not what was stored; the target is as it was.
    """
    with source.reading() as reader, target.atomic() as connection:
        driver = driver_of(connection)
        if last_names(driver) or rows(driver, FIT):
            words = "holds lasts already: name a catalogue that is new or empty"
            raise BadOption(words, str(target.path))
        count = 0
        for key in _parents_first(reader):
            _copy_last(reader, connection, key)
            count += 1
        for table in WHOLE:
            insert_rows(connection, table, rows(reader, table))
        return Copied(count, len(rows(driver, FIT)))


def _copy_last(reader: Driver, connection: sa.Connection, key: int) -> None:
    """Copy the rows of a last, and compare its hash with the rows that arrived."""
    for table in (LAST, *OWNED):
        of_last = rows(reader, table, key)
        insert_rows(connection, table, of_last)
        arrived = rows(driver_of(connection), table, key)
        if sorted(arrived, key=repr) != sorted(of_last, key=repr):
            raise CatalogueDamaged(f"the rows of {table.name} of last {key} did not arrive whole")
    (stored,) = stored_lasts(driver_of(connection), key)
    if not stored.intact:
        words = f"the last {stored.name!r} is damaged: see footfit check-catalogue"
        raise CatalogueDamaged(words)


def _parents_first(reader: Driver) -> Iterator[int]:
    """The keys of the lasts, each after that of its parent."""
    parents = dict(reader.execute("SELECT id, parent_id FROM last NOT INDEXED").fetchall())
    there: set[int] = set()
    for key in sorted(parents):
        line: list[int] = []
        ancestor: int | None = key
        while ancestor is not None and ancestor not in there and ancestor not in line:
            line.append(ancestor)
            ancestor = parents.get(ancestor)
        there.update(line)
        yield from reversed(line)
