"""Many lasts in few commits: the work of a commit is shared by the lasts that are ready.

Rows are written by the driver, many at a time. Each last is sealed as if it had been added alone.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from footfit.catalogue.file.dialect import Driver, change_mark
from footfit.catalogue.rows.columns import (
    FLARE,
    FRAME,
    LAST,
    MEASURE,
    MESH_COPY,
    NOTICE,
    PARENTAGE,
    SECTION,
    Table,
)
from footfit.catalogue.rows.digests import Row
from footfit.catalogue.rows.last_names import caseless
from footfit.catalogue.rows.reference_last import expressed, stored_reference
from footfit.catalogue.rows.requirements import require_storable
from footfit.catalogue.rows.verified_rows import (
    LastRows,
    row_digest,
    rows,
    shown_name,
    stored_range,
)
from footfit.results import LastRecord, MeshCopy, Parentage, ShapeSections
from footfit.version import __version__


@dataclass(frozen=True, slots=True)
class GroupSettings:
    """When a group of lasts is committed: after so many, or so long after its first came."""

    most_lasts: int = 256
    longest_s: float = 0.2


GROUP = GroupSettings()


class NewLast(NamedTuple):
    """A last to be added, with what the catalogue keeps beside its record."""

    record: LastRecord
    copy: MeshCopy | None = None
    sections: ShapeSections | None = None
    parentage: Parentage | None = None


def groups(lasts: Iterable[LastRecord | NewLast]) -> Iterator[list[NewLast]]:
    """The lasts in groups, each as large as `GROUP` lets it be."""
    group: list[NewLast] = []
    begun_s = 0.0
    for last in lasts:
        if not group:
            begun_s = time.monotonic()
        group.append(last if isinstance(last, NewLast) else NewLast(last))
        late = time.monotonic() - begun_s >= GROUP.longest_s
        if late or len(group) >= GROUP.most_lasts:
            yield group
            group = []
    if group:
        yield group


class KnownLasts:
    """The names and contents of a catalogue's lasts, as long as no other program changes it."""

    def __init__(self) -> None:
        self.mark = ""
        self.names: set[str] = set()
        self.contents: set[str] = set()

    def refresh(self, connection: Driver) -> None:
        """Read them again if another program has changed the catalogue."""
        mark = change_mark(connection)
        if mark == self.mark:
            return
        pairs = connection.execute("SELECT name, content_sha256 FROM last NOT INDEXED").fetchall()
        self.mark = mark
        self.names = {caseless(shown_name(name)) for name, _ in pairs}
        self.contents = {str(content) for _, content in pairs}

    def are_new(self, group: Sequence[NewLast]) -> bool:
        """Whether every last of a group is a new one without a parent: its name and its file."""
        names = {caseless(last.record.labels.name) for last in group}
        contents = {last.record.info.sha256 for last in group}
        return (
            len(names) == len(contents) == len(group)
            and not names & self.names
            and not contents & self.contents
            and all(last.record.labels.parent is None for last in group)
        )

    def add(self, group: Sequence[NewLast]) -> None:
        """Take the lasts of a group for known."""
        self.names |= {caseless(last.record.labels.name) for last in group}
        self.contents |= {last.record.info.sha256 for last in group}


def write_group(connection: Driver, group: Sequence[NewLast]) -> list[LastRows]:
    """Write new lasts, sealed; return their rows. The catalogue has a reference already.

    Raises
    ------
    BadOption
        A name cannot be stored.
    """
    reference = stored_reference(connection)
    assert reference is not None
    (top,) = connection.execute("SELECT coalesce(max(id), 0) FROM last").fetchone()
    keys = list(range(top + 1, top + 1 + len(group)))
    tables: dict[str, list[Row]] = {}
    for key, last in zip(keys, group, strict=True):
        require_storable(last.record.labels.name)
        record = replace(last.record, paper_transform=expressed(last.record, reference[1]))
        added = {"footfit_version": __version__, "record_sha256": ""}
        for table, row in _rows_of(last._replace(record=record), key, added):
            tables.setdefault(table.name, []).append(row)
    for table in (LAST, FRAME, FLARE, MEASURE, NOTICE, MESH_COPY, SECTION, PARENTAGE):
        _insert(connection, table, tables.get(table.name, []))
    stored = stored_range(connection, keys[0], keys[-1])
    seals = [(last.content_digest, last.id) for last in stored]
    connection.executemany("UPDATE last SET record_sha256 = ? WHERE id = ?", seals)
    for table in (MESH_COPY, SECTION, PARENTAGE):
        for owner in {row["last_id"] for row in tables.get(table.name, [])}:
            (row,) = rows(connection, table, owner)
            update = f"UPDATE {table.name} SET sha256 = ? WHERE last_id = ?"
            connection.execute(update, (row_digest(table, row), owner))
    return stored


def _rows_of(last: NewLast, key: int, added: Row) -> Iterator[tuple[Table, Row]]:
    """Every row of a last, not yet sealed."""
    record, owner = last.record, {"last_id": key}
    yield LAST, LAST.row(record, id=key, parent_id=None, **added)
    for table in (FRAME, FLARE):
        yield table, owner | table.row(record)
    for table, items in ((MEASURE, record.measures), (NOTICE, record.warnings)):
        for position, item in enumerate(items):
            yield table, owner | table.row(item, position=position)
    kept = ((MESH_COPY, last.copy), (SECTION, last.sections), (PARENTAGE, last.parentage))
    for table, value in kept:
        if value is not None:
            yield table, owner | table.row(value, sha256="")


def _insert(connection: Driver, table: Table, values: list[Row]) -> None:
    if not values:
        return
    names = list(values[0])
    places = ", ".join("?" for _ in names)
    insert = f"INSERT INTO {table.name} ({', '.join(names)}) VALUES ({places})"
    connection.executemany(insert, [[row[name] for name in names] for row in values])
