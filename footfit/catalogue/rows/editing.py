"""The writing verbs, each inside the caller's one transaction: what they check is still true
when they write.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from typing import TYPE_CHECKING

from sqlalchemy import delete, update

from footfit.catalogue.rows import schema
from footfit.catalogue.rows.reference_last import express_new, reference_id
from footfit.catalogue.rows.verified_rows import (
    intact_last,
    key_where,
    last_id,
    last_names,
    stored_lasts,
)
from footfit.catalogue.rows.writing import (
    driver_of,
    insert_last,
    overwrite_flare,
    overwrite_last,
    seal,
)
from footfit.errors import BadOption, NameTaken
from footfit.geometry.flare.flare_profile import FlareProfile
from footfit.results import LastLabels, LastRecord, Measure, MeshCopy

if TYPE_CHECKING:
    from sqlalchemy.orm import Session


def place(session: Session, record: LastRecord, copy: MeshCopy | None, *, replace: bool) -> None:
    """Store a last: as a new one, or over the one of its name where that is allowed.

    A damaged last is also written over by the same file under the same name: that is its cure.

    Raises
    ------
    NameTaken
        The name or the content is another last's.
    UnknownLast, BadOption
        The parent is not there, or is the last itself or one of its descendants; the name
        cannot be stored.
    """
    connection, labels = driver_of(session), record.labels
    _require_storable(labels.name)
    _require_new_content(connection, record)
    key = key_where(connection, "name", labels.name)
    parent_id = _parent_id(connection, labels, key)
    if key is None:
        key = insert_last(session, record, copy, parent_id)
    elif replace or _is_damaged_copy(connection, key, record):
        overwrite_last(session, key, record, copy, parent_id)
    else:
        raise NameTaken(f"{labels.name!r} is in the catalogue; add --replace, or another --name")
    express_new(session, key)


def remove(session: Session, name: str) -> None:
    """Remove a last; its rows in other tables go with it.

    Raises
    ------
    UnknownLast
        There is none of that name.
    BadOption
        It is the reference, or the parent of another last.
    """
    connection = driver_of(session)
    key = last_id(connection, name)
    if key == reference_id(connection):
        raise BadOption(
            f"{name!r} is the reference; make another last it first: footfit set-reference LAST"
        )
    children = connection.execute(
        "SELECT name FROM last NOT INDEXED WHERE parent_id = ? ORDER BY name", (key,)
    ).fetchall()
    if children:
        names = ", ".join(repr(child) for (child,) in children)
        raise BadOption(f"{name!r} is the parent of {names}; remove these first")
    session.execute(delete(schema.Last).where(schema.Last.id == key))


def rename(session: Session, name: str, new_name: str) -> None:
    """Give a last another name.

    Raises
    ------
    UnknownLast, CatalogueDamaged
        There is none of that name, or it is damaged.
    NameTaken, BadOption
        The new name is another last's, or cannot be stored.
    """
    connection = driver_of(session)
    _require_storable(new_name)
    key = intact_last(connection, last_id(connection, name)).id
    if key_where(connection, "name", new_name) not in (None, key):
        raise NameTaken(f"{new_name!r} is in the catalogue; choose another name")
    session.execute(update(schema.Last).where(schema.Last.id == key).values(name=new_name))
    seal(session, key)


def update_profile(
    session: Session,
    name: str,
    flare: FlareProfile,
    measures: Sequence[Measure] | None,
    upgraded_from: str | None,
) -> None:
    """Store a last's profile made anew.

    Raises
    ------
    UnknownLast, CatalogueDamaged
        There is none of that name, or it is damaged.
    """
    connection = driver_of(session)
    key = intact_last(connection, last_id(connection, name)).id
    overwrite_flare(session, key, flare, measures, upgraded_from)
    seal(session, key)


def _require_storable(name: str) -> None:
    if not name.strip():
        raise BadOption("a last needs a name that is not blank; give one with --name")
    try:
        name.encode("utf-8")
    except UnicodeEncodeError as error:
        raise BadOption(f"{name!r} is no text that can be stored; give one with --name") from error


def _require_new_content(connection: sqlite3.Connection, record: LastRecord) -> None:
    holder = key_where(connection, "content_sha256", record.info.sha256)
    if holder is None:
        return
    name = last_names(connection)[holder]
    if name != record.labels.name:
        raise NameTaken(f"the same scan is in the catalogue as {name!r}; nothing was stored")


def _parent_id(connection: sqlite3.Connection, labels: LastLabels, key: int | None) -> int | None:
    """The parent's key; a last that is its own ancestor would never end."""
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
    raise BadOption(f"{labels.parent!r} descends from {labels.name!r} and cannot be its parent")


def _is_damaged_copy(connection: sqlite3.Connection, key: int, record: LastRecord) -> bool:
    (stored,) = stored_lasts(connection, key)
    return not stored.intact and stored.last["content_sha256"] == record.info.sha256
