"""The catalogue as other layers see it: results go in and come out, one transaction a call."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from footfit.catalogue.blocks.block_writing import fill_blocks, refresh_blocks
from footfit.catalogue.blocks.search_file import drop_search_file
from footfit.catalogue.catalogue_reader import CatalogueReader
from footfit.catalogue.file.dialect import driver_of
from footfit.catalogue.file.engine import SETTINGS
from footfit.catalogue.file.migrate import Schema
from footfit.catalogue.group_commit import KnownLasts, NewLast, groups, write_group
from footfit.catalogue.rows.columns import (
    LAST,
    MESH_COPY,
    REFERENCE,
    SECTION,
)
from footfit.catalogue.rows.last_names import last_id
from footfit.catalogue.rows.records import record_of
from footfit.catalogue.rows.reference_last import (
    express,
    make_reference,
)
from footfit.catalogue.rows.requirements import (
    parent_key,
    place_of,
    require_free_name,
    require_name,
    require_removable,
)
from footfit.catalogue.rows.verified_rows import (
    intact_last,
    last_names,
)
from footfit.catalogue.rows.writing import (
    delete_rows,
    rename_base,
    seal,
    update_row,
    write_labels,
    write_last,
    write_measured,
    write_parentage,
    write_sealed,
)
from footfit.catalogue.server.any_location import (
    open_location_for_reading,
    open_location_for_writing,
)
from footfit.catalogue.server.server_opening import Writing
from footfit.errors import CatalogueUnusable, FootfitError
from footfit.locations import LocationName, location_of
from footfit.results import (
    LastRecord,
    MeshCopy,
    Parentage,
    ReferenceOutcome,
    RemoveOutcome,
    RenameOutcome,
    ShapeSections,
)

if TYPE_CHECKING:
    import sqlalchemy as sa


@contextmanager
def open_catalogue(
    path: LocationName,
    *,
    write: bool = False,
    create: bool = True,
    upgrade: bool = False,
    older: bool = False,
    busy_timeout_s: float = SETTINGS.busy_timeout_s,
    schema: Schema | None = None,
) -> Iterator[Catalogue]:
    """Open a catalogue for a ``with`` block.

    Opened for reading, nothing is made or changed; ``older`` also accepts an older schema, which
    only :meth:`Catalogue.findings` and :meth:`Catalogue.copy_to` can read. Opened for writing, a
    missing catalogue is made in its folder, unless ``create`` is False, and an older one is
    upgraded after a copy was put beside it (``Catalogue.revisions``). One on a server is upgraded
    only if ``upgrade`` allows it, because other people use it.

    Raises
    ------
    NoCatalogue
        There is no catalogue, and none may be made.
    BadOption
        There is no catalogue, and its folder is missing.
    NotACatalogue, NewerCatalogue, CatalogueDamaged, CatalogueLocked, CatalogueNotWritable
        The file is something else, from a later footfit, damaged, held or read-only.
    """
    location, schema = location_of(path), schema or Schema()
    if write:
        how = Writing(create, upgrade, fill_blocks)
        file, revisions = open_location_for_writing(location, schema, busy_timeout_s, how)
    else:
        file, revisions = open_location_for_reading(location, schema, busy_timeout_s, older=older)
    try:
        yield Catalogue(file, revisions, schema.up_to(revisions.after), busy_timeout_s)
    finally:
        file.close()
        if write:
            drop_search_file(location)


def _add(connection: sa.Connection, last: NewLast, *, replace: bool) -> None:
    """Store a last inside a transaction; raises as `Catalogue.add`."""
    driver = driver_of(connection)
    place = place_of(driver, last.record, replace=replace)
    key = write_last(connection, last.record, place.parent_id, place.key)
    write_sealed(connection, key, MESH_COPY, last.copy)
    write_sealed(connection, key, SECTION, last.sections)
    write_parentage(connection, key, last.parentage, keep=place.same_file)
    express(connection, key)
    refresh_blocks(driver, [key])


@dataclass
class Catalogue(CatalogueReader):
    """An open catalogue. Each reading method sees one snapshot; each writing one does all or
    nothing.

    Every method may raise the leaves of ``CatalogueUnusable`` (locked, not writable, damaged).
    """

    def add(
        self,
        record: LastRecord,
        copy: MeshCopy | None = None,
        sections: ShapeSections | None = None,
        parentage: Parentage | None = None,
        *,
        replace: bool = False,
    ) -> None:
        """Store a last; the first one becomes the reference in the same transaction.

        With ``replace`` it takes the place of the last of its name, if there is one. If that one
        was read from the same file, its parentage stays.

        Raises
        ------
        NameTaken
            The catalogue has a last of that name and ``replace`` is False, or of a name that
            differs only in case, or it has the same file under another name.
        UnknownLast, BadOption
            Its parent is not in the catalogue; its name cannot be stored.
        """
        self.add_all([NewLast(record, copy, sections, parentage)], replace=replace)

    def add_all(self, lasts: Iterable[NewLast], *, replace: bool = False) -> None:
        """Store lasts in one transaction: all of them, or none; raises as `add`."""
        with self.file.atomic() as connection:
            for last in lasts:
                _add(connection, last, replace=replace)

    def add_many(
        self, lasts: Iterable[LastRecord | NewLast], *, replace: bool = False
    ) -> Iterator[str]:
        """Store many lasts, several in one commit; yield each name after the commit that holds it.

        A commit holds the lasts that come within 0.2 s, at most 512. Otherwise it is as if each
        last were added alone: if one cannot be stored, those before it are, and those after it are
        not.

        Raises
        ------
        NameTaken, UnknownLast, BadOption
            As `add`, for the first last that cannot be stored.
        """
        known = KnownLasts()
        for group in groups(lasts):
            together = self.add_together(group, known, replace=replace)
            for last in group:
                if not together:
                    self.add(*last, replace=replace)
                yield last.record.labels.name

    def add_together(
        self, group: Sequence[NewLast], known: KnownLasts, *, replace: bool = False
    ) -> bool:
        """Store lasts in one commit, as if each were added alone; whether they are stored.

        If one of them cannot be stored, none is: `add` says of each what is wrong with it.
        ``known`` is the same for all groups of a batch, in which nothing but lasts is added.
        """
        try:
            with self.file.atomic() as connection:
                driver = driver_of(connection)
                known.refresh(driver)
                apart = len(group)
                if known.are_new(group):
                    apart = 0 if known.names else 1  # the first of a catalogue is its reference
                for last in group[:apart]:
                    _add(connection, last, replace=replace)
                if group[apart:]:
                    fresh = write_group(driver, group[apart:])
                    refresh_blocks(driver, fresh.keys.tolist(), fresh)
        except CatalogueUnusable:
            raise
        except FootfitError:
            return False
        known.add(group)
        return True

    def remove(self, name: str) -> RemoveOutcome:
        """Remove a last with everything that the catalogue holds of it.

        If it is the only one, the catalogue has no reference until the next last is added.

        Raises
        ------
        UnknownLast, BadOption
            There is no such last; it is the reference of other lasts, or the parent of one.
        """
        with self.file.atomic() as connection:
            driver = driver_of(connection)
            key = last_id(driver, name)
            names = last_names(driver)
            require_removable(driver, key, names)
            if len(names) == 1:  # an empty catalogue has no reference
                delete_rows(connection, REFERENCE, key)
            delete_rows(connection, LAST, key)
            refresh_blocks(driver, [key])
        return RemoveOutcome(names[key], len(names) - 1)

    def rename(self, name: str, new_name: str) -> RenameOutcome:
        """Give a last another name.

        Raises
        ------
        UnknownLast, NameTaken, BadOption
            There is no such last; another has the new name, in any case; it cannot be stored.
        """
        with self.file.atomic() as connection:
            require_name(new_name)
            driver = driver_of(connection)
            stored = intact_last(driver, last_id(driver, name))
            require_free_name(driver, new_name, stored.id)
            update_row(connection, LAST, stored.id, {"name": new_name})
            seal(connection, stored.id)
            rename_base(connection, stored, new_name)
            refresh_blocks(driver, [stored.id])
        return RenameOutcome(new_name, stored.name)

    def edit(
        self,
        name: str,
        change: Callable[
            [LastRecord, Callable[[], MeshCopy]], tuple[LastRecord, ShapeSections | None]
        ],
    ) -> tuple[LastRecord, LastRecord]:
        """Replace the labels of a last, its warnings and what is measured from its mesh.

        ``change`` makes the new record from the stored one, inside the transaction; it also gets a
        function that reads the mesh copy. Without sections the stored ones stay. The record before
        and the one after are returned.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no such last, or no such parent; its stored numbers were changed.
        BadOption
            The new parent descends from the last.
        FootfitError
            As ``change``; nothing is changed then.
        """
        with self.file.atomic() as connection:
            driver = driver_of(connection)
            stored = intact_last(driver, last_id(driver, name))
            names = last_names(driver)
            before = record_of(stored, names)
            after, sections = change(before, lambda: self.copy_of(driver, stored.id, stored.name))
            if after.labels.parent != before.labels.parent:
                parent_id = parent_key(driver, after.labels, stored.id)
                update_row(connection, LAST, stored.id, {"parent_id": parent_id})
                parent = None if parent_id is None else names[parent_id]
                after = replace(after, labels=replace(after.labels, parent=parent))
            if after.labels != before.labels:
                write_labels(connection, stored.id, after)
                write_measured(connection, stored.id, after, sections)
                refresh_blocks(driver, [stored.id])
        return before, after

    def set_reference(self, name: str) -> ReferenceOutcome:
        """Make a last the reference, and rewrite the ``paper_transform`` of every last.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no last of that name; a last is damaged.
        """
        with self.file.atomic() as connection:
            driver = driver_of(connection)
            reference = make_reference(connection, last_id(driver, name))
            return ReferenceOutcome(reference, len(last_names(driver)))

    def update_measured(self, record: LastRecord, sections: ShapeSections | None = None) -> None:
        """Replace all that is measured from the mesh of the last that has the record's name.

        Without ``sections`` the stored ones stay.

        Raises
        ------
        UnknownLast, CatalogueDamaged
            There is no last of that name, or its rows are not what was stored.
        """
        with self.file.atomic() as connection:
            driver = driver_of(connection)
            key = intact_last(driver, last_id(driver, record.labels.name)).id
            write_measured(connection, key, record, sections)
            refresh_blocks(driver, [key])

    def renew_blocks(self) -> int:
        """Make every search block anew that is missing or not what was stored; return how many."""
        with self.file.atomic() as connection:
            return fill_blocks(driver_of(connection))
