"""What changes the lasts, each inside the caller's one transaction: what a function checks is
still true when it writes.
"""

from __future__ import annotations

import dataclasses
import sqlite3
from collections.abc import Sequence
from typing import TYPE_CHECKING

from footfit.catalogue.rows.columns import FLARE, LAST, MEASURE
from footfit.catalogue.rows.records import record_of
from footfit.catalogue.rows.reference_last import express, reference_key
from footfit.catalogue.rows.verified_rows import (
    intact_last,
    key_where,
    last_id,
    last_names,
    stored_lasts,
)
from footfit.catalogue.rows.writing import (
    delete_rows,
    driver_of,
    seal,
    update_row,
    write_last,
    write_owned,
)
from footfit.errors import BadOption, NameTaken
from footfit.geometry.flare.definition import FlareProfile
from footfit.results import LastLabels, LastRecord, Measure, MeshCopy

if TYPE_CHECKING:
    import sqlalchemy as sa


def place(
    connection: sa.Connection, record: LastRecord, copy: MeshCopy | None, *, replace: bool
) -> None:
    """Store a last: as a new one, or in place of the one of its name if ``replace`` is given.

    A damaged last is also replaced if the same file comes again under the same name: this is how
    it is repaired.

    Raises
    ------
    NameTaken
        Another last has the name or the content.
    UnknownLast, BadOption
        The parent is not in the catalogue, or it is the last itself or one of its descendants;
        the name cannot be stored.
    """
    driver, labels = driver_of(connection), record.labels
    _require_storable(labels.name)
    _require_new_content(driver, record)
    key = key_where(driver, "name", labels.name)
    parent_id = _parent_id(driver, labels, key)
    if key is not None and not replace and not _is_damaged_copy(driver, key, record):
        raise NameTaken(f"{labels.name!r} is in the catalogue; add --replace, or another --name")
    express(connection, write_last(connection, record, copy, parent_id, key))


def remove(connection: sa.Connection, name: str) -> None:
    """Remove a last and its rows in all tables.

    Raises
    ------
    UnknownLast
        There is no last of that name.
    BadOption
        It is the reference, or the parent of another last.
    """
    driver = driver_of(connection)
    key = last_id(driver, name)
    if key == reference_key(driver):
        raise BadOption(
            f"{name!r} is the reference; choose another one first: footfit set-reference LAST"
        )
    children = driver.execute(
        "SELECT name FROM last NOT INDEXED WHERE parent_id = ? ORDER BY name", (key,)
    ).fetchall()
    if children:
        names = ", ".join(repr(child) for (child,) in children)
        raise BadOption(f"{name!r} is the parent of {names}; remove those first")
    delete_rows(connection, LAST, key)


def rename(connection: sa.Connection, name: str, new_name: str) -> None:
    """Give a last another name.

    Raises
    ------
    UnknownLast, CatalogueDamaged
        There is no last of that name, or it is damaged.
    NameTaken, BadOption
        Another last has the new name; it cannot be stored.
    """
    driver = driver_of(connection)
    _require_storable(new_name)
    key = intact_last(driver, last_id(driver, name)).id
    if key_where(driver, "name", new_name) not in (None, key):
        raise NameTaken(f"{new_name!r} is in the catalogue; choose another name")
    update_row(connection, LAST, key, {"name": new_name})
    seal(connection, key)


def update_profile(
    connection: sa.Connection,
    name: str,
    flare: FlareProfile,
    measures: Sequence[Measure] | None,
    upgraded_from: str | None,
) -> None:
    """Replace a last's flare profile, and its measures if some are given.

    Raises
    ------
    UnknownLast, CatalogueDamaged
        There is no last of that name, or it is damaged.
    """
    driver = driver_of(connection)
    stored = intact_last(driver, last_id(driver, name))
    record = record_of(stored, last_names(driver))
    record = dataclasses.replace(
        record,
        flare=flare,
        upgraded_from=upgraded_from,
        measures=record.measures if measures is None else tuple(measures),
    )
    for table in (FLARE, MEASURE):
        write_owned(connection, stored.id, table, record)
    seal(connection, stored.id)


def same_scan(holder: str) -> NameTaken:
    """The refusal of a file whose content the catalogue has under the name ``holder``."""
    return NameTaken(f"the same scan is in the catalogue as {holder!r}; nothing was stored")


def _require_storable(name: str) -> None:
    if not name.strip():
        raise BadOption("a last needs a name that is not blank; give one with --name")
    try:
        name.encode("utf-8")
    except UnicodeEncodeError as error:
        words = f"{name!r} cannot be stored as a name; give another one with --name"
        raise BadOption(words) from error


def _require_new_content(connection: sqlite3.Connection, record: LastRecord) -> None:
    holder = key_where(connection, "content_sha256", record.info.sha256)
    if holder is None:
        return
    name = last_names(connection)[holder]
    if name != record.labels.name:
        raise same_scan(name)


def _parent_id(connection: sqlite3.Connection, labels: LastLabels, key: int | None) -> int | None:
    """The parent's key; a last cannot be its own ancestor."""
    if labels.parent is None:
        return None
    parent_id = last_id(connection, labels.parent)
    parents = dict(connection.execute("SELECT id, parent_id FROM last NOT INDEXED").fetchall())
    ancestor: int | None = parent_id
    for _ in range(len(parents) + 1):
        if ancestor is None:
            return parent_id
        if ancestor == key:
            break
        ancestor = parents.get(ancestor)
    raise BadOption(f"{labels.parent!r} descends from {labels.name!r}, so it cannot be its parent")


def _is_damaged_copy(connection: sqlite3.Connection, key: int, record: LastRecord) -> bool:
    (stored,) = stored_lasts(connection, key)
    return not stored.intact and stored.last["content_sha256"] == record.info.sha256
