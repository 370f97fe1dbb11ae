"""The hashes that tell whether what is read is what was stored.

SQLite checks how its pages hang together, not their content: its integrity check missed 88 % of
the single-bit flips that changed a value. So each last has one SHA-256 over all that ranking
reads. Its mesh copy has another one, so that matching reads no mesh.
"""

from __future__ import annotations

import json
from collections.abc import Collection
from hashlib import sha256
from typing import Any

Row = dict[str, Any]
"""One row by column, with the values that the driver gives: None, int, float, str or bytes."""


def hash_content(row: Row | None, unhashed: Collection[str]) -> Row:
    """The values of a row that are hashed: without the columns in ``unhashed``, and without nulls.

    Nulls are left out so that a column that a later schema adds does not change the hashes of
    older rows. A value that turns null still changes the hash.

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
    return text_digest(text)


def text_digest(text: str) -> str:
    """SHA-256 of canonical JSON that is made already."""
    return _sha256(text.encode("ascii"))


def blob_text(value: bytes) -> str:
    """A blob in canonical JSON.

    Examples
    --------
    >>> digest({"row": {"data": b"a"}}) == text_digest(f'{{"row":{{"data":{blob_text(b"a")}}}}}')
    True
    """
    return f'{{"sha256":"{sha256(value, usedforsecurity=False).hexdigest()}"}}'


def _blob(value: bytes) -> dict[str, str]:
    return {"sha256": _sha256(value)}


def _sha256(data: bytes) -> str:
    return sha256(data, usedforsecurity=False).hexdigest()
