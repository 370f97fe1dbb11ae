"""What must be true before a last is changed, checked in the transaction that changes it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.rows.last_names import caseless, composed, id_of_same_name, last_id
from footfit.catalogue.rows.verified_rows import key_where, last_names, stored_lasts
from footfit.errors import BadOption, NameTaken
from footfit.results import LastLabels, LastRecord


class Place(NamedTuple):
    """Where a record goes: the key of the last that it takes the place of, and its parent's.

    ``same_file`` says that the last in its place was read from the same file.
    """

    key: int | None
    parent_id: int | None
    same_file: bool = False


def place_of(connection: Driver, record: LastRecord, *, replace: bool) -> Place:
    """The place of a record. The parent of a last that is read from its file again stays.

    Without ``replace`` a record may only take the place of a damaged last that was made from the
    same file: this is how a damaged last is repaired.

    Raises
    ------
    NameTaken
        Another last has the name, or one that differs only in case, or the content.
    UnknownLast, BadOption
        The parent is not in the catalogue, or it is the last itself or one of its descendants;
        the name cannot be stored.
    """
    name, sha256 = record.labels.name, record.info.sha256
    require_storable(name)
    holder = key_where(connection, "content_sha256", sha256)
    if holder is not None and composed(last_names(connection)[holder]) != composed(name):
        raise same_scan(last_names(connection)[holder])
    key = id_of_same_name(connection, name)
    parent_id = parent_key(connection, record.labels, key)
    if key is None:
        require_name(name)
        return Place(None, parent_id)
    (stored,) = stored_lasts(connection, key)
    same_file = stored.last["content_sha256"] == sha256
    if not replace and (stored.intact or not same_file):
        raise NameTaken(f"{name!r} is in the catalogue; add --replace, or another --name")
    if same_file and stored.intact and parent_id is None:
        parent_id = stored.last["parent_id"]
    return Place(key, parent_id, same_file)


def same_scan(holder: str) -> NameTaken:
    """The refusal of a file whose content the catalogue has under the name ``holder``."""
    words = f"the same mesh is in the catalogue as {holder!r}, so nothing was stored"
    return NameTaken(f"{words}: use that last, or take it out first with footfit remove-last")


def require_storable(name: str) -> None:
    """Refuse a name that no last can have.

    Raises
    ------
    BadOption
        It is blank, or not a text that UTF-8 can hold.
    """
    if not name.strip():
        raise BadOption("a last needs a name that is not blank; type one")
    try:
        name.encode("utf-8")
    except UnicodeEncodeError as error:
        words = f"{name!r} cannot be stored as a name; give another one"
        raise BadOption(words) from error


def require_name(name: str, noun: str = "last") -> None:
    """Refuse a new name of a last or a family that no command could take again.

    Names that are stored already stay as they are.

    Raises
    ------
    BadOption
        It has a slash, a line break or another sign that is not printed; it cannot be stored.
    """
    require_storable(name)
    if "/" in name or "\\" in name or not name.isprintable():
        words = "give one without slashes, line breaks and other signs that are not shown"
        raise BadOption(f"{name!r} cannot be the name of a {noun}: {words}")


def require_free_name(connection: Driver, name: str, key: int) -> None:
    """Refuse a name for the last of that ``key`` that another last has, in any case.

    Raises
    ------
    NameTaken
        Another last has it.
    """
    for other, stored in last_names(connection).items():
        if other != key and caseless(stored) == caseless(name):
            raise NameTaken(f"{stored!r} is in the catalogue: choose another name")


def require_removable(connection: Driver, key: int, names: Mapping[int, str]) -> None:
    """Refuse to remove a last that others depend on; ``names`` are those of all lasts.

    Raises
    ------
    BadOption
        It is the reference of other lasts, or the parent of one.
    """
    name, alone = names[key], len(names) == 1
    reference = connection.execute("SELECT 1 FROM reference WHERE last_id = ?", (key,)).fetchone()
    if reference and not alone:
        raise BadOption(
            f"{name!r} is the reference: choose another reference first, with footfit set-reference"
        )
    children = connection.execute(
        "SELECT name FROM last NOT INDEXED WHERE parent_id = ?", (key,)
    ).fetchall()
    if children:
        children_names = ", ".join(repr(child) for (child,) in sorted(children))
        cut = "or remove the label: footfit edit-last NAME --parent ''"
        raise BadOption(f"{name!r} is the parent of {children_names}; remove those first, {cut}")


def parent_key(connection: Driver, labels: LastLabels, key: int | None) -> int | None:
    """The key of the parent that labels name, of the last that has ``key``; None for no parent.

    Raises
    ------
    UnknownLast, BadOption
        The parent is not in the catalogue, or it is the last itself or one of its descendants.
    """
    if labels.parent is None:
        return None
    parent_id = last_id(connection, labels.parent)
    parents = dict(connection.execute("SELECT id, parent_id FROM last NOT INDEXED").fetchall())
    ancestor: int | None = parent_id
    line: set[int] = set()
    while ancestor is not None and ancestor not in line:
        line.add(ancestor)
        ancestor = parents.get(ancestor)
    if ancestor is not None or key in line:
        words = f"{labels.parent!r} descends from {labels.name!r}, so it cannot be its parent"
        raise BadOption(words)
    return parent_id
