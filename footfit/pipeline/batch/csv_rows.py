"""The rows of a user's CSV file, however a spreadsheet wrote it."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import NamedTuple

from footfit.errors import BadManifest

DELIMITERS = (",", ";", "\t", "|")
LARGEST_BYTES = 16_000_000
SAVE_AGAIN = "save it as CSV UTF-8"
_UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_EXCELS_LINE = re.compile(r"sep=(.)\r?\n", re.IGNORECASE)


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


def csv_rows(path: Path, columns: Sequence[str], required: Sequence[str]) -> list[CsvRow]:
    """The rows of a file; see `rows_of_text`.

    Raises
    ------
    BadManifest
        It is not a file, not text or too large, or its content is not understood.
    """
    try:
        if not path.exists():
            raise BadManifest("there is no such file: check the path", str(path))
        if not path.is_file():
            raise BadManifest("is not a file; name a CSV file", str(path))
        if path.stat().st_size > LARGEST_BYTES:
            limit = f"{LARGEST_BYTES / 1e6:.0f} MB"
            raise BadManifest(f"is larger than {limit}; give it fewer lines", str(path))
        data = path.read_bytes()
    except OSError as error:
        raise BadManifest(f"cannot be read ({error.strerror})", str(path)) from error
    return rows_of_text(_decoded(data, str(path)), columns, required, str(path))


def rows_of_text(
    text: str, columns: Sequence[str], required: Sequence[str], origin: str
) -> list[CsvRow]:
    r"""The rows of a table whose columns are among ``columns``.

    The header decides which delimiter the table has. Empty rows and empty columns are passed over.

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
    said = _EXCELS_LINE.match(text)
    text = text[said.end() :] if said else text
    delimiter = said[1] if said else _delimiter(text, required)
    reader = csv.reader(
        io.StringIO(text, newline=""), delimiter=delimiter, skipinitialspace=True, strict=True
    )
    rows = []
    try:
        header: list[str] = next((cells for cells in reader if any(map(str.strip, cells))), [])
        names = _checked_names(header, columns, required, origin)
        for cells in reader:
            where = f"{origin} line {reader.line_num + (1 if said else 0)}"
            if values := _values(cells, names, where):
                rows.append(CsvRow(where, values))
    except csv.Error as error:
        problem = f"is not a CSV file ({error} in line {reader.line_num})"
        raise BadManifest(f"{problem}; {SAVE_AGAIN}", origin) from error
    return rows


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


def _delimiter(text: str, required: Sequence[str]) -> str:
    """What divides the header into most columns, with the required ones among them."""
    line = text.lstrip().partition("\n")[0]
    parts = {each: [_plain(cell) for cell in line.split(each)] for each in DELIMITERS}
    able = [each for each in DELIMITERS if set(required) <= set(parts[each])]
    return max(able or DELIMITERS, key=lambda each: len(parts[each]))


def _plain(name: str) -> str:
    return "_".join(name.strip().strip('"').casefold().replace("-", " ").replace("_", " ").split())


def _checked_names(
    cells: Sequence[str], columns: Sequence[str], required: Sequence[str], origin: str
) -> list[str]:
    """The names of the columns, "" for one without a name."""
    names = [_plain(cell) for cell in cells]
    known = f"the columns are {', '.join(columns)}"
    for name, cell in zip(names, cells, strict=True):
        if name and name not in columns:
            close = get_close_matches(name, columns, n=1)
            hint = f"did you mean {close[0]!r}? " if close else ""
            raise BadManifest(f"unknown column {cell.strip()!r}; {hint}{known}", origin)
        if name and names.count(name) > 1:
            raise BadManifest(f"has the column {name!r} twice; keep one of them", origin)
    for name in required:
        if name not in names:
            raise BadManifest(f"no column {name!r}; {known}", origin)
    return names


def _values(cells: Sequence[str], names: Sequence[str], where: str) -> dict[str, str]:
    """The cells that are not empty, by their columns."""
    values: dict[str, str] = {}
    for place, cell in enumerate(cells):
        if not (text := cell.strip()):
            continue
        if place >= len(names):
            words = "has more values than columns; put a value that holds the delimiter in quotes"
            raise BadManifest(words, where)
        if not names[place]:
            words = f"has a value in column {place + 1}, which has no name; name it or empty it"
            raise BadManifest(words, where)
        values[names[place]] = text
    return values
