"""The catalogue's tables as SQLAlchemy knows them, made from the table of columns.

Only writing and migrating import this module: reading asks SQLite itself which columns a row
has (``docs/decisions/0060-reading-without-the-orm.md``).
"""

from __future__ import annotations

import sqlalchemy as sa

from footfit.catalogue.rows.columns import TABLES, Column, Table

METADATA = sa.MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_name)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
        "ck": "ck_%(table_name)s_%(constraint_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "pk": "pk_%(table_name)s",
    }
)
"""All tables; constraints have names, because SQLite's batch migrations need them."""

_TYPES = {
    "integer": sa.Integer,
    "real": sa.Float,
    "text": sa.String,
    "flag": sa.Boolean,
    "blob": sa.LargeBinary,
}


def _column(column: Column) -> sa.Column[object]:
    owner = [sa.ForeignKey("last.id", ondelete=column.on_delete)] if column.on_delete else []
    return sa.Column(
        column.name,
        _TYPES[column.kind.sql],
        *owner,
        primary_key=column.key,
        nullable=column.nullable,
    )


def _table(table: Table) -> sa.Table:
    unique = (sa.UniqueConstraint(column.name) for column in table.columns if column.unique)
    single = (sa.CheckConstraint("id = 1", name="single"),) if table.single else ()
    return sa.Table(table.name, METADATA, *map(_column, table.columns), *unique, *single)


SQL_TABLES = {table.name: _table(table) for table in TABLES}
