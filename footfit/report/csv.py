"""Results as CSV for spreadsheets; a spreadsheet takes no cell for a formula."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from typing import Any, ClassVar, Protocol

from footfit.report.wording.text import visible

# A spreadsheet runs a cell that starts so; a semicolon inside a cell starts another one where a
# country's settings split there.
_FORMULA = re.compile(r"(^|;)(?=[=+\-@＝＋－＠])")
_NUMBER = re.compile(r"[+-]?\d+([.,]\d+)?")


class Table(Protocol):
    """A result that is a table: its columns, and a dict for each row."""

    columns: ClassVar[tuple[str, ...]]

    def rows(self) -> Sequence[dict[str, Any]]:
        """The rows, each with every column."""


def csv_text(kind: type[Table], tables: Iterable[Table]) -> str:
    """Tables of one kind as CSV under one head: commas between cells, quotes if needed.

    Control characters in a text are shown as escapes, line ends too. So each row is one line.
    """
    target = io.StringIO()
    writer = csv.writer(target, lineterminator="\n")
    writer.writerow(kind.columns)
    writer.writerows(map(_cell, row.values()) for table in tables for row in table.rows())
    return target.getvalue()


def harmless(text: str) -> str:
    """``text`` so that a spreadsheet shows it and never runs it; a number stays a number.

    Examples
    --------
    >>> harmless("=HYPERLINK(1)"), harmless("-1+cmd"), harmless("-5"), harmless("Derby;=1")
    ("'=HYPERLINK(1)", "'-1+cmd", '-5', "Derby;'=1")
    """
    return text if _NUMBER.fullmatch(text) else _FORMULA.sub(r"\1'", text)


def _cell(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return harmless(visible(value))
    return "" if value is None else str(value)
