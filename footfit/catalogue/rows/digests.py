"""The hashes that tell whether what is read is what was stored.

SQLite checks the shape of its pages, not their content: of the single-bit flips that changed a
value, its integrity check missed 88 %. So each last has one SHA-256 over all that ranking reads
and its mesh copy another, so that matching reads no mesh.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Collection
from typing import Any

Row = dict[str, Any]
"""One row by column, as the driver gives it: None, int, float, str or bytes."""


def hash_content(row: Row | None, unhashed: Collection[str]) -> Row:
    """What is hashed of a row: no column of ``unhashed``, and no null.

    A null adds nothing, so that a column which a later schema adds leaves the hashes of older
    rows as they are. A value that turns null changes the hash all the same.

    Examples
    --------
    >>> hash_content({"id": 7, "name": "a", "size": None}, {"id"})
    {'name': 'a'}
    """
    values = (row or {}).items()
    return {name: value for name, value in values if value is not None and name not in unhashed}


def digest(content: dict[str, Row | list[Row]]) -> str:
    """SHA-256 of rows as canonical JSON: sorted keys, a blob as its own SHA-256.

    The order of the columns does not matter. Types count: 1, 1.0 and "1" differ.

    Examples
    --------
    >>> digest({"last": {"faces": 1}}) == digest({"last": {"faces": 1.0}})
    False
    """
    text = json.dumps(content, sort_keys=True, separators=(",", ":"), default=_blob)
    return hashlib.sha256(text.encode("ascii")).hexdigest()


def _blob(value: bytes) -> dict[str, str]:
    return {"sha256": hashlib.sha256(value).hexdigest()}
