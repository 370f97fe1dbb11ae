"""The catalogue's raw rows, checked against their hashes before a record is made from them.

Nothing here uses SQLAlchemy, and no statement lists columns: a row has the columns that SQLite
gives, so that a changed byte anywhere in it is seen.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

from footfit.catalogue.file.dialect import Driver
from footfit.catalogue.rows.array_blobs import array_of, definition_text
from footfit.catalogue.rows.columns import FLARE, FRAME, LAST, MEASURE, NOTICE, Table
from footfit.catalogue.rows.digests import Row, digest, hash_content
from footfit.errors import CatalogueDamaged
from footfit.geometry.flare.definition import FlareDefinition


@dataclass(frozen=True, slots=True)
class LastRows:
    """The raw rows of one last without its mesh copy; None stands for a missing row."""

    id: int
    last: Row
    frame: Row | None
    flare: Row | None
    measures: tuple[Row, ...]
    notices: tuple[Row, ...]

    @property
    def name(self) -> str:
        """The stored name as a text, whatever is stored."""
        return shown_name(self.last.get("name"))

    @property
    def definition(self) -> str:
        """The text of the definition that the flare profile follows."""
        return str((self.flare or {}).get("definition"))

    @property
    def is_current(self) -> bool:
        """Whether the flare profile follows this footfit's definition, and has its stations; of
        intact rows.
        """
        current = FlareDefinition()
        stations = (self.flare or {}).get("stations")
        whole = isinstance(stations, bytes) and len(array_of(stations)) == current.stations
        return whole and self.definition == definition_text(current)

    @property
    def content_digest(self) -> str:
        """The hash of these rows as they are."""
        return digest(
            {
                "last": hash_content(self.last, LAST.unhashed),
                "frame": hash_content(self.frame, FRAME.unhashed),
                "flare": hash_content(self.flare, FLARE.unhashed),
                "measures": [hash_content(row, MEASURE.unhashed) for row in self.measures],
                "notices": [hash_content(row, NOTICE.unhashed) for row in self.notices],
            }
        )

    @property
    def intact(self) -> bool:
        """Whether the rows are what was stored."""
        return bool(self.last.get("record_sha256") == self.content_digest)


def shown_name(stored: object) -> str:
    r"""A stored name as a text; damage may have turned it into a null, a number or bytes.

    Bytes that are not UTF-8 are shown as ``\x..``.

    Examples
    --------
    >>> [shown_name(stored) for stored in ("derby", None, 7, "a\udcffb")]
    ['derby', 'None', '7', 'a\\xffb']
    """
    return str(stored).encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def row_digest(table: Table, row: Row) -> str:
    """The hash of a row that has its own hash: a mesh copy, the reference.

    Its keys are hashed too, so that it cannot be taken for the row of another last.
    """
    return digest({"row": hash_content(row, table.unhashed)})


def rows(connection: Driver, table: Table, last_id: int | None = None) -> list[Row]:
    """The rows of a table in the order of storage; of one last alone if ``last_id`` is given.

    Raises
    ------
    CatalogueDamaged
        The table has lost the column of its key.
    """
    key = table.last_key
    where, values = ("", ()) if last_id is None else (f" WHERE {key} = ?", (last_id,))
    cursor = connection.execute(f"SELECT * FROM {table.name}{where} ORDER BY rowid", values)
    columns = [column[0] for column in cursor.description]
    if key not in columns:
        raise CatalogueDamaged(
            f"lacks the column {key!r} of {table.name!r}; restore it from a backup"
        )
    return [dict(zip(columns, row, strict=True)) for row in cursor]


def sealed_row(connection: Driver, table: Table, last_id: int, words: str) -> Row | None:
    """The row with a hash of its own that a table has for a last, verified; None for none.

    Raises
    ------
    CatalogueDamaged
        It is not what was stored; the message begins with ``words``.
    """
    kept = rows(connection, table, last_id)
    if kept and kept[0].get("sha256") != row_digest(table, kept[0]):
        raise CatalogueDamaged(f"{words} damaged; ingest the last again with --replace")
    return kept[0] if kept else None


def stored_lasts(connection: Driver, last_id: int | None = None) -> list[LastRows]:
    """The raw rows of every last, or of one, in the order in which they were first stored.

    This takes five SELECTs, however many lasts there are. They read the tables, not an index.
    """
    return _of_rows(*(rows(connection, table, last_id) for table in PARTS_OF_LAST))


PARTS_OF_LAST = (LAST, FRAME, FLARE, MEASURE, NOTICE)
"""The tables that the hash of a last is taken over."""


def _of_rows(
    lasts: list[Row],
    frame_rows: list[Row],
    flare_rows: list[Row],
    measure_rows: list[Row],
    notice_rows: list[Row],
) -> list[LastRows]:
    frames = {row["last_id"]: row for row in frame_rows}
    flares = {row["last_id"]: row for row in flare_rows}
    measures, notices = _by_last(measure_rows), _by_last(notice_rows)
    return [
        LastRows(
            id=row["id"],
            last=row,
            frame=frames.get(row["id"]),
            flare=flares.get(row["id"]),
            measures=tuple(measures[row["id"]]),
            notices=tuple(notices[row["id"]]),
        )
        for row in lasts
    ]


def _by_last(rows_of_all: list[Row]) -> dict[int, list[Row]]:
    """Rows by their last, in the order of their position (a damaged one may have any type)."""
    groups: dict[int, list[Row]] = defaultdict(list)
    for row in rows_of_all:
        groups[row["last_id"]].append(row)
    for group in groups.values():
        group.sort(key=lambda row: (type(row.get("position")).__name__, row.get("position")))
    return groups


def last_names(connection: Driver) -> dict[int, str]:
    """The name of every last, damaged ones too, by its key."""
    pairs = connection.execute("SELECT id, name FROM last NOT INDEXED")
    return {key: shown_name(name) for key, name in pairs}


def key_where(connection: Driver, column: str, value: str) -> int | None:
    """The key of the last whose ``column`` (a unique one) holds ``value``; no index is read."""
    select = f"SELECT id FROM last NOT INDEXED WHERE {column} = ?"
    try:
        row = connection.execute(select, (value,)).fetchone()
    except UnicodeEncodeError:  # no catalogue holds a text that UTF-8 cannot hold
        return None
    return None if row is None else int(row[0])


def intact_last(connection: Driver, key: int) -> LastRows:
    """The rows of one last, verified.

    Raises
    ------
    CatalogueDamaged
        They are not what was stored.
    """
    (stored,) = stored_lasts(connection, key)
    if not stored.intact:
        raise CatalogueDamaged(
            f"the last {stored.name!r} is damaged; ingest it again with --replace,"
            " or restore the catalogue from a backup"
        )
    return stored
