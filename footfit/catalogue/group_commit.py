"""Many lasts in few commits: the work of a commit is shared by the lasts that are ready.

Rows are written by the driver, many at a time. Each last is sealed as if it had been added alone.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

from footfit.catalogue.blocks.record_columns import LABELS, columns_of
from footfit.catalogue.file.dialect import Driver, change_mark
from footfit.catalogue.rows.last_names import caseless
from footfit.catalogue.rows.reference_last import expressed, stored_reference
from footfit.catalogue.rows.requirements import require_name
from footfit.catalogue.rows.verified_rows import shown_name
from footfit.catalogue.sealed_rows import WRITTEN, Values, sealed_rows
from footfit.errors import BadOption
from footfit.results import LastRecord, MeshCopy, Parentage, ShapeSections
from footfit.results.columns.last_columns import NOT_KEPT, LastColumns
from footfit.results.columns.vocabulary import Vocabulary


@dataclass(frozen=True, slots=True)
class GroupSettings:
    """When a group of lasts is committed: after so many, or so long after its first came."""

    most_lasts: int = 512
    longest_s: float = 0.2


GROUP = GroupSettings()
MOST_PLACES = 512
"""How many values a statement takes at most; every SQLite takes 999."""


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
            and all(_is_storable(last.record) for last in group)
        )

    def add(self, group: Sequence[NewLast]) -> None:
        """Take the lasts of a group for known."""
        self.names |= {caseless(last.record.labels.name) for last in group}
        self.contents |= {last.record.info.sha256 for last in group}


def _is_storable(record: LastRecord) -> bool:
    """Whether a new last can have its name, and its texts are stored as they are."""
    labels = (getattr(record.labels, name) or "" for name in LABELS)
    try:
        require_name(record.labels.name)
        "".join(labels).encode()
    except (BadOption, UnicodeEncodeError):
        return False
    return True


def write_group(connection: Driver, group: Sequence[NewLast]) -> LastColumns:
    """Write new lasts, sealed; return them by column. The catalogue has a reference already.

    The hashes are of what the database gives back, which is known of every value that a record
    can have: nothing is read again. If it were otherwise, the last would be found damaged at once.

    Raises
    ------
    BadOption
        A name cannot be stored.
    """
    reference = stored_reference(connection)
    assert reference is not None
    (top,) = connection.execute("SELECT coalesce(max(id), 0) FROM last").fetchone()
    keys = list(range(top + 1, top + 1 + len(group)))
    tables: dict[str, list[Values]] = {name: [] for name in WRITTEN}
    for key, last in zip(keys, group, strict=True):
        require_name(last.record.labels.name)
        transform = expressed(last.record, reference[1])
        for name, rows in sealed_rows(key, last.record, transform, last[1:]).items():
            tables[name] += rows
    for name, columns in WRITTEN.items():
        _insert(connection, name, columns, tables[name])
    records, kept = [last.record for last in group], [last.sections or NOT_KEPT for last in group]
    return columns_of(records, kept, Vocabulary(), keys=keys)


def _insert(connection: Driver, table: str, columns: Sequence[str], rows: Sequence[Values]) -> None:
    """Insert rows, many by each statement: that takes half of the time of a statement a row."""
    most = max(1, MOST_PLACES // len(columns))
    whole = len(rows) - len(rows) % most
    for count, some in ((most, rows[:whole]), (len(rows) - whole, rows[whole:])):
        if some:
            places = ", ".join([f"({', '.join(['?'] * len(columns))})"] * count)
            insert = f"INSERT INTO {table} ({', '.join(columns)}) VALUES {places}"
            starts = range(0, len(some), count)
            joined = [tuple(chain.from_iterable(some[at : at + count])) for at in starts]
            connection.executemany(insert, joined)
