"""What a catalogue is, and what it holds. SQLite counts, so no record is made."""

from __future__ import annotations

from footfit.catalogue.file.dialect import Driver, table_names
from footfit.locations import Location
from footfit.results import CatalogueFacts

Counts = tuple[tuple[str, int], ...]


def summary(connection: Driver, path: Location, size_bytes: int) -> CatalogueFacts:
    """Counts by style, size system, side and flare definition ("" stands for no label)."""
    (lasts,) = connection.execute("SELECT count(*) FROM last NOT INDEXED").fetchone()
    (revision,) = connection.execute("SELECT version_num FROM alembic_version").fetchone()
    reference = connection.execute(
        "SELECT last.name FROM reference JOIN last ON last.id = reference.last_id"
    ).fetchone()
    copies, copy_bytes, worst = connection.execute(
        "SELECT count(*), coalesce(sum(length(data)), 0), max(error_mm) FROM mesh_copy"
    ).fetchone()
    return CatalogueFacts(
        path=str(path),
        bytes=size_bytes,
        lasts=lasts,
        reference=reference[0] if reference else None,
        schema_revision=revision,
        definitions=_counts(connection, "flare", "definition_version"),
        styles=_counts(connection, "last", "style"),
        size_systems=_counts(connection, "last", "size_system"),
        sides=_counts(connection, "last", "side"),
        mesh_copies=copies,
        mesh_copy_bytes=copy_bytes,
        worst_copy_error_mm=worst,
        kept=_kept(connection),
    )


def _kept(connection: Driver) -> Counts:
    """Every table but Alembic's, with its number of rows: nothing is kept unseen."""
    quoted = ((name, name.replace('"', '""')) for name in table_names(connection))
    return tuple(
        (name, int(connection.execute(f'SELECT count(*) FROM "{safe}"').fetchone()[0]))
        for name, safe in quoted
    )


def _counts(connection: Driver, table: str, column: str) -> Counts:
    select = f"SELECT coalesce({column}, ''), count(*) FROM {table} GROUP BY 1"
    return tuple(sorted((str(value), int(count)) for value, count in connection.execute(select)))
