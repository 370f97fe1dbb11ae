"""From records to the catalogue's rows, and the hashes that seal them.

Every function writes inside the caller's transaction. SQLAlchemy is opened at the first write.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.catalogue.file.dialect import driver_of
from footfit.catalogue.rows.columns import (
    FIT,
    FLARE,
    FRAME,
    LAST,
    MEASURE,
    NOTICE,
    PARENTAGE,
    REFERENCE,
    SECTION,
)
from footfit.catalogue.rows.verified_rows import row_digest, rows, stored_lasts
from footfit.version import __version__

if TYPE_CHECKING:
    import sqlalchemy as sa

    from footfit.catalogue.rows.columns import Table
    from footfit.catalogue.rows.digests import Row
    from footfit.catalogue.rows.verified_rows import LastRows
    from footfit.results import FitEntry, LastRecord, Parentage, Reference, ShapeSections

LABEL_COLUMNS = tuple(name for name in LAST.readers("labels") if name != "name")
"""What is said of a last and may change."""
STANCE_COLUMNS = ("standing_transform", "ground_sd_deg", "stance_by")
"""What a frame has that is measured again."""


def write_last(
    connection: sa.Connection,
    record: LastRecord,
    parent_id: int | None,
    key: int | None = None,
) -> int:
    """Write every row of a last, not yet sealed; return its key.

    The last is a new one, or takes the place of the one that has ``key``: the key stays, for the
    rows that name it.
    """
    added = {"parent_id": parent_id, "footfit_version": __version__, "record_sha256": ""}
    row = LAST.row(record, **added)
    if key is None:
        key = _inserted_key(connection, LAST, row)
    else:
        update_row(connection, LAST, key, row)
    for table in (FRAME, FLARE, MEASURE, NOTICE):
        write_owned(connection, key, table, record)
    return key


def write_sealed(connection: sa.Connection, key: int, table: Table, value: object | None) -> None:
    """Write the row with a hash of its own that a table has for a last; None deletes it."""
    _write_rows(connection, key, table, [] if value is None else [table.row(value, sha256="")])
    if value is not None:
        _seal_row(connection, key, table)


def write_owned(connection: sa.Connection, key: int, table: Table, record: LastRecord) -> None:
    """Write the rows that one table has for a last anew, not yet sealed."""
    lists = {MEASURE.name: record.measures, NOTICE.name: record.warnings}
    if table.name in lists:
        values = [table.row(item, position=i) for i, item in enumerate(lists[table.name])]
    else:
        values = [table.row(record)]
    _write_rows(connection, key, table, values)


def write_labels(connection: sa.Connection, key: int, record: LastRecord) -> None:
    """Write what is said of a last, but for its name, and its warnings, not yet sealed."""
    row = LAST.row(record)
    update_row(connection, LAST, key, {name: row[name] for name in LABEL_COLUMNS})
    write_owned(connection, key, NOTICE, record)


def write_measured(
    connection: sa.Connection, key: int, record: LastRecord, sections: ShapeSections | None
) -> None:
    """Write all that is measured from the mesh of a last, and seal the last."""
    for table in (FLARE, MEASURE):
        write_owned(connection, key, table, record)
    stance = {name: FRAME.row(record)[name] for name in STANCE_COLUMNS}
    update_row(connection, FRAME, key, stance)
    if sections is not None:
        write_sealed(connection, key, SECTION, sections)
    seal(connection, key)


def write_reference(connection: sa.Connection, key: int, reference: Reference) -> None:
    """Make a last the catalogue's one reference, sealed."""
    connection.execute(_sql(REFERENCE).delete())
    row = REFERENCE.row(reference, id=1, last_id=key, sha256="")
    connection.execute(_sql(REFERENCE).insert(), row)
    _seal_row(connection, key, REFERENCE)


def write_parentage(
    connection: sa.Connection, key: int, parentage: Parentage | None, *, keep: bool
) -> None:
    """Write how a last was made; with ``keep`` and None, what is stored stays if it is intact."""
    stored = rows(driver_of(connection), PARENTAGE, key)
    intact = all(row.get("sha256") == row_digest(PARENTAGE, row) for row in stored)
    if parentage is not None or not (keep and intact):
        write_sealed(connection, key, PARENTAGE, parentage)


def rename_base(connection: sa.Connection, base: LastRows, new_name: str) -> None:
    """Write the new name of a last where others name it as their base. Damaged rows stay."""
    for row in rows(driver_of(connection), PARENTAGE):
        its_base = row["base"] == base.name and row["base_sha256"] == base.last["content_sha256"]
        if its_base and row["sha256"] == row_digest(PARENTAGE, row):
            update_row(connection, PARENTAGE, row["last_id"], {"base": new_name})
            _seal_row(connection, row["last_id"], PARENTAGE)


def add_fit(connection: sa.Connection, entry: FitEntry) -> None:
    """Add an entry to the fit log, sealed."""
    row = FIT.row(entry, sha256="")
    key = _inserted_key(connection, FIT, row)
    _seal_row(connection, key, FIT)


def update_row(connection: sa.Connection, table: Table, key: int, values: Row) -> None:
    """Change values of the row that a table has for a last, not yet sealed."""
    sql = _sql(table)
    connection.execute(sql.update().where(sql.c[table.last_key] == key).values(**values))


def delete_rows(connection: sa.Connection, table: Table, key: int) -> None:
    """Delete the rows that a table has for a last; what the last owns goes with it."""
    sql = _sql(table)
    connection.execute(sql.delete().where(sql.c[table.last_key] == key))


def seal(connection: sa.Connection, key: int) -> None:
    """Store the hash of a last's rows as SQLite now gives them back.

    Of what is read back, not of what was sent: SQLite keeps -0.0 as 0.0, for one.
    """
    (stored,) = stored_lasts(driver_of(connection), key)
    update_row(connection, LAST, key, {"record_sha256": stored.content_digest})


def _seal_row(connection: sa.Connection, key: int, table: Table) -> None:
    """Store the hash of the row that ``table`` has for one last."""
    (row,) = rows(driver_of(connection), table, key)
    update_row(connection, table, key, {"sha256": row_digest(table, row)})


def _write_rows(connection: sa.Connection, key: int, table: Table, values: list[Row]) -> None:
    delete_rows(connection, table, key)
    if values:
        connection.execute(_sql(table).insert(), [{"last_id": key} | row for row in values])


def insert_rows(connection: sa.Connection, table: Table, values: list[Row]) -> None:
    """Insert rows as they are, with their keys and hashes."""
    if values:
        connection.execute(_sql(table).insert(), values)


def _inserted_key(connection: sa.Connection, table: Table, row: Row) -> int:
    """Insert a row; return the key that it gets: the one after the highest, on any server."""
    select = f"SELECT coalesce(max({table.last_key}), 0) + 1 FROM {table.name}"
    (key,) = driver_of(connection).execute(select).fetchone()
    connection.execute(_sql(table).insert(), {table.last_key: key} | row)
    return int(key)


def _sql(table: Table) -> sa.Table:
    from footfit.catalogue.rows.schema import SQL_TABLES

    return SQL_TABLES[table.name]
