"""What is read of a catalogue: each method sees one snapshot, and verifies what it gives."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from footfit.catalogue.blocks.block_reading import BlockLasts, block_lasts
from footfit.catalogue.file.engine import SETTINGS, sqlite_errors_in_words
from footfit.catalogue.file.migrate import Revisions, Schema
from footfit.catalogue.fit_log import FitLog
from footfit.catalogue.rows.columns import LAST, MESH_COPY, PARENTAGE, SECTION, Table
from footfit.catalogue.rows.last_names import last_id
from footfit.catalogue.rows.records import mesh_copy_of, parentage_of, record_of, sections_of
from footfit.catalogue.rows.reference_last import reference_of, stored_reference
from footfit.catalogue.rows.search import StoredLasts, verified_records
from footfit.catalogue.rows.verified_rows import intact_last, last_names, sealed_row, stored_lasts
from footfit.catalogue.server.any_location import OpenLocation, open_location_for_reading
from footfit.errors import BadOption, UnknownLast

if TYPE_CHECKING:
    from footfit.catalogue.file.dialect import Driver
    from footfit.catalogue.rows.digests import Row
    from footfit.locations import Location
    from footfit.results import (
        CatalogueFacts,
        Finding,
        LastRecord,
        MeshCopy,
        Parentage,
        Reference,
        ShapeSections,
    )


@contextmanager
def open_reader(location: Location) -> Iterator[CatalogueReader]:
    """Open a catalogue to read it, for a ``with`` block; `store.open_catalogue` can also write.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it cannot be read.
    """
    schema = Schema()
    file, revisions = open_location_for_reading(location, schema, SETTINGS.busy_timeout_s)
    try:
        yield CatalogueReader(file, revisions, schema, SETTINGS.busy_timeout_s)
    finally:
        file.close()


@dataclass
class CatalogueReader:
    """An open catalogue, as it is read. Every method may raise the leaves of ``CatalogueUnusable``
    (locked, damaged).
    """

    file: OpenLocation
    revisions: Revisions
    schema: Schema
    busy_timeout_s: float

    @property
    def fit_log(self) -> FitLog:
        """What wearers said of worn shoes."""
        return FitLog(self.file)

    def names(self) -> tuple[str, ...]:
        """The name of every last, damaged ones too, sorted."""
        with self.file.reading() as connection:
            return tuple(sorted(last_names(connection).values()))

    def name(self, name: str) -> str:
        """The stored name of the last that a name means; raises UnknownLast."""
        with self.file.reading() as connection:
            return last_names(connection)[last_id(connection, name)]

    def record(self, name: str) -> LastRecord:
        """One last.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no last of that name, or its rows are not what was stored.
        """
        with self.file.reading() as connection:
            stored = intact_last(connection, last_id(connection, name))
            return record_of(stored, last_names(connection))

    def lasts(self, **labels: str | None) -> StoredLasts:
        """Every intact last that has these labels, by name; no mesh is read.

        ``style``, ``size``, ``size_system``, ``width_label`` and ``family`` filter; None lets all
        pass.
        """
        with self.file.reading() as connection:
            return verified_records(connection, **labels)

    def block_lasts(self, untrusted: frozenset[int] = frozenset()) -> BlockLasts:
        """Every intact last by column, from the search blocks; those in ``untrusted`` are not used.

        No mesh is read, and no row of a last whose block is what was stored.
        """
        with self.file.reading() as connection:
            return block_lasts(connection, self.file.path, untrusted)

    def each_last(self) -> Iterator[LastRecord]:
        """Every intact last in one snapshot, by name, with one in memory at a time."""
        with self.file.reading() as connection:
            names = last_names(connection)
            for key in sorted(names, key=lambda key: names[key]):
                (stored,) = stored_lasts(connection, key)
                if stored.intact:
                    yield record_of(stored, names)

    def reference(self, name: str | None = None) -> Reference | None:
        """The reference last, None in an empty catalogue; or what the last ``name`` would be as it.

        Raises
        ------
        CatalogueDamaged, UnknownLast
            Its rows are not what was stored; there is no last of that name.
        """
        if name is not None:
            return reference_of(self.record(name))
        with self.file.reading() as connection:
            reference = stored_reference(connection)
            return None if reference is None else reference[1]

    def mesh_copy(self, name: str) -> MeshCopy:
        """A last's compact mesh, in its canonical frame.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no such last, or it was stored without a mesh; the copy is damaged.
        """
        with self.file.reading() as connection:
            return self.copy_of(connection, last_id(connection, name), name)

    def copy_of(self, connection: Driver, key: int, name: str) -> MeshCopy:
        """The mesh copy of the last of a key, inside a transaction; raises as `mesh_copy`."""
        copy = sealed_row(connection, MESH_COPY, key, f"the mesh of {name!r} is")
        if copy is None:
            raise UnknownLast(f"{name!r} was stored without its mesh; use ingest-last --replace")
        return mesh_copy_of(copy)

    def sections(self, name: str) -> ShapeSections | None:
        """The kept sections of a last; None if it was stored without them.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no such last; its sections are not what was stored.
        """
        row = self._sealed(name, SECTION, f"the sections of {name!r} are")
        return None if row is None else sections_of(row)

    def parentage(self, name: str) -> Parentage | None:
        """How a last was made from another one; None if it was scanned.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no such last; its parentage is not what was stored.
        """
        row = self._sealed(name, PARENTAGE, f"the parentage of {name!r} is")
        return None if row is None else parentage_of(row)

    def _sealed(self, name: str, table: Table, words: str) -> Row | None:
        """The verified row that a last has in a table, if it has one."""
        with self.file.reading() as connection:
            return sealed_row(connection, table, last_id(connection, name), words)

    def mesh_copy_names(self) -> tuple[str, ...]:
        """The names of the lasts that have a mesh copy, damaged or not, sorted."""
        return self._owners(MESH_COPY)

    def whole_mesh_names(self) -> frozenset[str]:
        """The names of the lasts whose copy has every face of the scan."""
        with self.file.reading() as connection:
            names = last_names(connection)
            joined = f"{LAST.name} JOIN {MESH_COPY.name} ON last_id = id"
            whole = f"SELECT id FROM {joined} WHERE {MESH_COPY.name}.faces >= {LAST.name}.faces"
            return frozenset(names[key] for (key,) in connection.execute(whole).fetchall())

    def section_names(self) -> tuple[str, ...]:
        """The names of the lasts whose sections are kept, damaged or not, sorted."""
        return self._owners(SECTION)

    def _owners(self, table: Table) -> tuple[str, ...]:
        with self.file.reading() as connection:
            names = last_names(connection)
            owners = connection.execute(f"SELECT last_id FROM {table.name}").fetchall()
            return tuple(sorted(str(names.get(owner, "?")) for (owner,) in owners))

    def summary(self) -> CatalogueFacts:
        """What the catalogue is, and counts of what it holds."""
        from footfit.catalogue.rows.summary import summary

        with self.file.reading() as connection:
            return summary(connection, self.file.path, self.file.size_bytes)

    def findings(self) -> list[Finding]:
        """Everything that is not as it was stored."""
        from footfit.catalogue.checks.damage import findings

        with self.file.reading() as connection:
            return findings(connection, self.schema)

    def copy_to(self, target: Path) -> None:
        """Write a whole copy of this moment to ``target``, a missing or empty file.

        Raises
        ------
        CatalogueDamaged, CatalogueNotWritable, CatalogueLocked
            The catalogue cannot be read, or the copy cannot be written.
        """
        from footfit.catalogue.file.copying import copy_into
        from footfit.catalogue.server.catalogue_server import NO_FILE, CatalogueServer

        if isinstance(self.file, CatalogueServer):
            raise BadOption(NO_FILE, str(self.file.path))
        with sqlite_errors_in_words(self.file.path):
            copy_into(self.file.path, target, self.busy_timeout_s)
