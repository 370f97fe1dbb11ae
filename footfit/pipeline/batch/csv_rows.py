"""The rows of a user's CSV file, however a spreadsheet wrote it."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from footfit.errors import BadManifest

DELIMITERS = (",", ";", "\t", "|")
LARGEST_BYTES = 16_000_000
SAVE_AGAIN = "save it as CSV UTF-8"
MORE_VALUES = "has more values than columns; put a value that holds the delimiter in quotes"
_UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_EXCELS_LINE = re.compile(r"sep=(.)\r?\n", re.IGNORECASE)


class Faults:
    """What is wrong in a table. It is collected, so that a user can mend all of it at once."""

    most_lines = 20

    def __init__(self) -> None:
        self._errors: list[BadManifest] = []

    @contextmanager
    def collecting(self) -> Iterator[None]:
        """Keep the error that ends this block, and go on after it."""
        try:
            yield
        except BadManifest as error:
            self._errors.append(error)

    def refuse(self, origin: str) -> None:
        """Raise the first error, with the others beside it, if there is one.

        Raises
        ------
        BadManifest
            Something is wrong in the table ``origin``.
        """
        if not self._errors:
            return
        errors = sorted(self._errors, key=lambda error: _line_number(error.path or ""))
        shown, more = errors[: self.most_lines], len(errors) - self.most_lines
        if more > 0:
            words = f"and {more:,} more errors: mend those above, and run the command again"
            shown.append(BadManifest(words, origin))
        first, *others = shown
        first.others = tuple(others)
        raise first


def _line_number(where: str) -> int:
    """The number of a line in words such as "lasts.csv line 5"; 0 if they name a file only."""
    number = where.rpartition(" line ")[2]
    return int(number) if number.isdecimal() else 0


class CsvRow(NamedTuple):
    """A row: ``where`` names its file and line, ``values`` has the cells that are not empty."""

    where: str
    values: dict[str, str]

    def number(self, column: str, default: str = "") -> float:
        """The number in a column, with a point or a comma; ``default`` stands for an empty cell.

        Raises
        ------
        BadManifest
            It is no number.
        """
        said = self.values.get(column, default)
        try:
            return float(said.replace(",", "."))
        except ValueError as error:
            raise BadManifest(f"{column} is {said!r}; it must be a number", self.where) from error


def csv_rows(
    path: Path, columns: Sequence[str], required: Sequence[str], faults: Faults | None = None
) -> list[CsvRow]:
    """The rows of a file; see `rows_of_text`.

    Raises
    ------
    BadManifest
        It is not a file, not text or too large, or its content is not understood.
    """
    _check_file(path)
    try:
        if path.stat().st_size > LARGEST_BYTES:
            limit = f"{LARGEST_BYTES / 1e6:.0f} MB"
            raise BadManifest(f"is larger than {limit}; give it fewer lines", str(path))
        data = path.read_bytes()
    except OSError as error:
        raise BadManifest(f"cannot be read ({error.strerror})", str(path)) from error
    return rows_of_text(_decoded(data, str(path)), columns, required, str(path), faults)


def _check_file(path: Path) -> None:
    """Refuse a path that is no file."""
    try:
        if not path.exists():
            raise BadManifest("there is no such file: check the path", str(path))
        if not path.is_file():
            raise BadManifest("is not a file; name a CSV file", str(path))
    except OSError as error:  # such as a name that is too long
        raise BadManifest(f"cannot be read ({error.strerror})", str(path)) from error


def rows_of_text(
    text: str,
    columns: Sequence[str],
    required: Sequence[str],
    origin: str,
    faults: Faults | None = None,
) -> list[CsvRow]:
    r"""The rows of a table whose columns are among ``columns``.

    The header decides which delimiter the table has. Empty rows and empty columns are passed over.
    With ``faults`` the caller refuses the table: errors are collected there, and rows with an error
    are left out.

    Raises
    ------
    BadManifest
        The table lacks a ``required`` column, has one that is not known or stands twice, or has
        more values than columns.

    Examples
    --------
    >>> rows_of_text("path;size;;\na.stl;42;;\n;;;\n", ("path", "size"), ("path",), "lasts.csv")
    [CsvRow(where='lasts.csv line 2', values={'path': 'a.stl', 'size': '42'})]
    """
    table = _table_of(io.StringIO(text, newline=""), required, origin)
    errors = faults or Faults()
    names = _checked_names(table.head, columns, required, origin, errors)
    rows = []
    with errors.collecting():  # a line that is no CSV ends the table
        for where, cells in table.rows:
            with errors.collecting():
                rows.append(CsvRow(where, _values(cells, names, where)))
    if faults is None:
        errors.refuse(origin)
    return [row for row in rows if row.values]


class CsvTable(NamedTuple):
    """A table as it is read: its head as it stands, and its rows, each with its file and line."""

    head: list[str]
    rows: Iterator[tuple[str, list[str]]]


@contextmanager
def csv_stream(path: Path, required: Sequence[str] = ()) -> Iterator[CsvTable]:
    """The table of a file of any length, which is never in memory as a whole.

    ``required`` are columns that help to see which delimiter the table has.

    Raises
    ------
    BadManifest
        It is not a file, not text, or not a table.
    """
    _check_file(path)
    origin = str(path)
    try:
        with path.open("rb") as file:
            is_utf16 = file.read(2) in _UTF16_MARKS
        encoding = "utf-16" if is_utf16 else "utf-8-sig"
        with path.open(encoding=encoding, newline="") as text:
            yield _table_of(text, required, origin)
    except UnicodeDecodeError as error:
        raise BadManifest(f"is not UTF-8 text; {SAVE_AGAIN}", origin) from error
    except OSError as error:
        raise BadManifest(f"cannot be read ({error.strerror})", origin) from error


def _table_of(text: Iterable[str], required: Sequence[str], origin: str) -> CsvTable:
    """The table in lines of text; the head decides which delimiter it has."""
    lines = (line for line in text)
    passed, delimiter = 0, None
    first = ""
    for line in lines:
        said = _EXCELS_LINE.fullmatch(line) if passed == 0 else None
        if said:
            delimiter = said[1]
        elif line.strip(" ,;|\t\r\n"):
            first = line
            break
        passed += 1
    reader = csv.reader(
        chain([first], lines),
        delimiter=delimiter or _delimiter(first, required),
        skipinitialspace=True,
        strict=True,
    )
    rows = _numbered_rows(reader, origin, passed)
    return CsvTable(next(rows, ("", []))[1], rows)


def _numbered_rows(reader: Any, origin: str, passed: int) -> Iterator[tuple[str, list[str]]]:
    """The rows of a reader with their places; ``passed`` lines stand before its first."""
    try:
        for cells in reader:
            yield f"{origin} line {reader.line_num + passed}", cells
    except csv.Error as error:
        line = reader.line_num + passed
        words = f"is not a CSV file ({error} in line {line}); {SAVE_AGAIN}"
        raise BadManifest(words, origin) from error


def _decoded(data: bytes, origin: str) -> str:
    """The text of a file in UTF-8, or in UTF-16 if its first bytes say so."""
    try:
        text = data.decode("utf-16" if data.startswith(_UTF16_MARKS) else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise BadManifest(f"is not UTF-8 text in line {line}; {SAVE_AGAIN}", origin) from error
    if "\0" in text:
        raise BadManifest(f"holds NUL characters and is not UTF-8 text; {SAVE_AGAIN}", origin)
    return text


def _delimiter(line: str, required: Sequence[str]) -> str:
    """What divides the head into most columns, with the required ones among them."""
    parts = {each: [plain_name(cell) for cell in line.split(each)] for each in DELIMITERS}
    able = [each for each in DELIMITERS if set(required) <= set(parts[each])]
    return max(able or DELIMITERS, key=lambda each: len(parts[each]))


def plain_name(name: str) -> str:
    """The name of a column without regard to case, spaces and dashes.

    Examples
    --------
    >>> plain_name(' "Ball-Girth" ')
    'ball_girth'
    """
    return "_".join(name.strip().strip('"').casefold().replace("-", " ").replace("_", " ").split())


def _checked_names(
    cells: Sequence[str],
    columns: Sequence[str],
    required: Sequence[str],
    origin: str,
    faults: Faults,
) -> list[str]:
    """The names of the columns, "" for one without a name.

    Raises
    ------
    BadManifest
        A ``required`` column is missing: nothing more can be said of the table.
    """
    names = [plain_name(cell) for cell in cells]
    known = f"the columns are {', '.join(columns)}"
    meant: list[str] = []
    for place, (name, cell) in enumerate(zip(names, cells, strict=True)):
        with faults.collecting():
            if name and name not in columns:
                close = get_close_matches(name, columns, n=1)
                meant += close
                hint = f"did you mean {close[0]!r}? " if close else ""
                raise BadManifest(f"unknown column {cell.strip()!r}; {hint}{known}", origin)
            if name and name in names[:place]:
                raise BadManifest(f"has the column {name!r} twice; keep one of them", origin)
    missing = [name for name in required if name not in names]
    for name in missing:
        with faults.collecting():
            if name not in meant:
                raise BadManifest(f"no column {name!r}; {known}", origin)
    if missing:
        faults.refuse(origin)
    return names


def _values(cells: Sequence[str], names: Sequence[str], where: str) -> dict[str, str]:
    """The cells that are not empty, by their columns."""
    values: dict[str, str] = {}
    for place, cell in enumerate(cells):
        if not (text := cell.strip()):
            continue
        if place >= len(names):
            raise BadManifest(MORE_VALUES, where)
        if not names[place]:
            words = f"has a value in column {place + 1}, which has no name; name it or empty it"
            raise BadManifest(words, where)
        values[names[place]] = text
    return values
