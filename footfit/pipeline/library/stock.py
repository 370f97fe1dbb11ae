"""What a shop has in stock: a CSV file, as a spreadsheet writes it, against the lasts."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from footfit.catalogue.blocks.record_columns import LABELS
from footfit.errors import BadManifest
from footfit.geometry.fit.sizes import label_number
from footfit.pipeline.batch.csv_rows import Faults, csv_rows

COLUMNS = ("last", *LABELS, "quantity")
Key = tuple[str, ...]
NamedLabels = tuple[str, tuple[str | None, ...]]
"""The name of a last, and its labels in the order of LABELS."""


@dataclass(frozen=True, slots=True)
class Stock:
    """The lasts of a library that are in stock, by name, and the rows that name none of them."""

    names: frozenset[str]
    unknown: tuple[str, ...]


def stock(path: Path, lasts: Sequence[NamedLabels]) -> Stock:
    """What a stock file says of lasts.

    A row names a last, or gives labels: then it means every last that has all of them. Without a
    quantity a row means that there is at least one; 0 means that there is none.

    Raises
    ------
    BadManifest
        The file cannot be read, names no last and no labels in a row, or a quantity is no number.
    """
    faults = Faults()
    rows = csv_rows(path, COLUMNS, (), faults)
    counts = []
    for row in rows:
        with faults.collecting():
            counts.append(row.number("quantity", "1"))
            if not {"last", *LABELS} & row.values.keys():
                raise BadManifest("names no last and gives no style, size or width", row.where)
    faults.refuse(str(path))
    if not rows:
        raise BadManifest("has no row; its columns are last, or labels, and quantity", str(path))
    by_name = {_plain(name): name for name, _ in lasts}
    indexes: dict[tuple[str, ...], dict[Key, list[str]]] = {}
    there: set[str] = set()
    unknown = []
    for row, count in zip(rows, counts, strict=True):
        given = tuple(name for name in LABELS if name in row.values)
        if "last" in row.values:
            name = by_name.get(_plain(row.values["last"]))
            names = [] if name is None else [name]
        else:
            if given not in indexes:
                indexes[given] = _index(lasts, given)
            names = indexes[given].get(tuple(_label(name, row.values[name]) for name in given), [])
        if not names:
            unknown.append(row.where)
        elif count > 0.0:
            there.update(names)
    return Stock(frozenset(there), tuple(unknown))


def _index(lasts: Sequence[NamedLabels], given: tuple[str, ...]) -> dict[Key, list[str]]:
    """The names of lasts by some of their labels."""
    index: dict[Key, list[str]] = defaultdict(list)
    places = [(name, LABELS.index(name)) for name in given]
    keys: dict[tuple[str | None, ...], Key] = {}
    for name, labels in lasts:
        if labels not in keys:
            keys[labels] = tuple(_label(label, labels[at] or "") for label, at in places)
        index[keys[labels]].append(name)
    return index


def _label(name: str, text: str) -> str:
    """A label for comparing: without regard to case, and a size as its number."""
    number = label_number(text) if name == "size" else None
    return _plain(text) if number is None else str(number[0])


def _plain(text: str) -> str:
    return " ".join(text.casefold().split())
