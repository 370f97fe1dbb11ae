"""The tables, keys and rules that a catalogue of some revision must have."""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Mapping
from contextlib import closing
from functools import lru_cache

from footfit.catalogue.file.migrate import Schema, create

Objects = Mapping[tuple[str, str], str]
"""By (type, name): the table that it belongs to, and its SQL in the form of :func:`_plain`."""


def stored_objects(connection: sqlite3.Connection) -> Objects:
    """Every table, index, view and trigger of an open file.

    Of SQLite's own objects it has the indexes behind constraints, but not what ANALYZE makes.
    """
    select = "SELECT type, name, tbl_name, sql FROM sqlite_schema"
    return {
        (str(kind), str(name)): f"{table}: {_plain(sql)}"
        for kind, name, table, sql in connection.execute(select)
        if not str(name).startswith("sqlite_") or str(name).startswith("sqlite_autoindex_")
    }


@lru_cache(maxsize=8)
def expected_objects(schema: Schema) -> Objects:
    """What the migrations of a schema make; they are run in memory."""
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as connection:
        create(connection, schema)
        return stored_objects(connection)


def _plain(sql: object) -> str:
    r"""SQL as its words; the clauses of a table are sorted.

    Spaces and quotes differ between releases of SQLAlchemy. When Alembic makes a table anew, the
    order of its constraints differs from one process to the next.

    Examples
    --------
    >>> _plain('CREATE TABLE "last" (\n\tid INTEGER NOT NULL, \n\tCHECK (id > 1)\n)')
    'CREATE TABLE last | CHECK ( id > 1 ) | id INTEGER NOT NULL'
    """
    words = re.findall(r"\w+|[^\w\s\"`\[\]]", str(sql))
    if words[:2] != ["CREATE", "TABLE"]:
        return " ".join(words)
    clauses: list[list[str]] = [[]]
    depth = 0
    for word in words:
        depth += (word == "(") - (word == ")")
        if (word, depth) in ((",", 1), ("(", 1)):
            clauses.append([])
        elif (word, depth) != (")", 0):
            clauses[-1].append(word)
    head, *body = (" ".join(clause) for clause in clauses)
    return " | ".join([head, *sorted(body)])
