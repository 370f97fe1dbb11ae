"""The hashes that tell whether what is read is what was stored.

SQLite checks the shape of its pages, not their content: of the single-bit flips that changed a
value, its integrity check missed 88 %. So each last has one SHA-256 over all that ranking reads
and its mesh copy another, so that matching reads no mesh.
"""

from __future__ import annotations

import hashlib
import json

Row = dict[str, int | float | str | bytes | None]
"""One row by column, as SQLite stores it."""


def digest(content: dict[str, Row | list[Row]]) -> str:
    """SHA-256 of rows as canonical JSON: sorted keys, a blob as its own SHA-256, no nulls.

    A null adds nothing, so that a column which a later schema adds leaves the hashes of older
    rows as they are; a value that turns null changes the hash all the same. Types count: 1,
    1.0 and "1" differ.

    Examples
    --------
    >>> digest({"last": {"name": "a", "size": None}}) == digest({"last": {"name": "a"}})
    True
    >>> digest({"last": {"faces": 1}}) == digest({"last": {"faces": 1.0}})
    False
    """
    present = {table: _without_nulls(rows) for table, rows in content.items()}
    text = json.dumps(present, sort_keys=True, separators=(",", ":"), default=_blob)
    return hashlib.sha256(text.encode("ascii")).hexdigest()


def _without_nulls(rows: Row | list[Row]) -> object:
    if isinstance(rows, dict):
        return {column: value for column, value in rows.items() if value is not None}
    return [_without_nulls(row) for row in rows]


def _blob(value: bytes) -> dict[str, str]:
    return {"sha256": hashlib.sha256(value).hexdigest()}
