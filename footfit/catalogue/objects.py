"""The tables, keys and rules that a catalogue of some revision has: what its migrations make."""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Mapping
from contextlib import closing
from functools import lru_cache

from footfit.catalogue.migrate import Schema, create

Objects = Mapping[tuple[str, str], str]
"""SQL by (type, name), spaces, case and quotes apart."""


def stored_objects(connection: sqlite3.Connection) -> Objects:
    """Every table, index, view and trigger of an open file, SQLite's own left out."""
    select = (
        "SELECT type, name, sql FROM sqlite_schema WHERE name NOT LIKE 'sqlite\\_%' ESCAPE '\\'"
    )
    return {(str(kind), str(name)): _plain(sql) for kind, name, sql in connection.execute(select)}


@lru_cache(maxsize=8)
def expected_objects(schema: Schema) -> Objects:
    """What the migrations of a schema make, run in memory."""
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as connection:
        create(connection, schema)
        return stored_objects(connection)


def _plain(sql: object) -> str:
    r"""SQL as its words: how they are spaced and quoted differs between releases of SQLAlchemy.

    Examples
    --------
    >>> _plain('CREATE TABLE "last" (\n\tid INTEGER NOT NULL\n)')
    'create table last ( id integer not null )'
    """
    return " ".join(re.findall(r"\w+|[^\w\s\"`\[\]]", str(sql).lower()))
