"""The rows of new lasts with their hashes, without writing them first and reading them back.

A hash is what `digest` gives. The canonical JSON under it is put together from parts here: what is
the same in every last, as the words and the repeatability of a measure, is made once.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from functools import lru_cache
from math import isfinite
from typing import Any

from footfit.catalogue.rows.array_blobs import blob
from footfit.catalogue.rows.columns import (
    FLARE,
    FRAME,
    LAST,
    MEASURE,
    NOTICE,
    SEALED,
    Column,
    Table,
)
from footfit.catalogue.rows.digests import blob_text, text_digest
from footfit.geometry.numeric.arrays import Floats
from footfit.results import LastRecord, Measure, Measured
from footfit.version import __version__

Values = tuple[Any, ...]
"""A row, in the order of the `names` of its `RowMaker`."""


class RowMaker:
    """Makes the rows of a table: ``added`` are the columns that the writer adds, which come first.

    The columns ``own`` come last. The hash of the row, if it has one, comes after them.
    """

    def __init__(self, table: Table, *added: str, own: tuple[str, ...] = ()) -> None:
        columns = {column.name: column for column in table.columns}
        given = (*added, *own)
        read = [column.name for column in table.columns if column.path and column.name not in given]
        self.names = (*added, *read, *own)
        read_columns = [columns[name] for name in (*read, *own)]
        self._readers = [(column.getter, column.kind.to_sql) for column in read_columns]
        self._hashed = [
            (self.names.index(name), f'"{name}":', _text_of(columns[name]))
            for name in sorted(self.names)
            if columns[name].hashed
        ]

    def values(self, record: object, *added: object) -> Values:
        """The row of a record."""
        return (
            *added,
            *[
                None if (value := get(record)) is None else to_sql(value)
                for get, to_sql in self._readers
            ],
        )

    def text(self, values: Values) -> str:
        """The canonical JSON of a row."""
        parts = [
            name + text_of(values[at])
            for at, name, text_of in self._hashed
            if values[at] is not None
        ]
        return f"{{{','.join(parts)}}}"


def _text_of(column: Column) -> Callable[[Any], str]:
    """How the values of a column are written in canonical JSON."""
    if column.kind.sql == "text" and not column.unique:
        return _kept_text
    ways: dict[str, Callable[[Any], str]] = {
        "real": _real_text,
        "blob": blob_text,
        "flag": lambda value: str(int(value)),  # as the database gives it back
    }
    return ways.get(column.kind.sql, json.dumps)


_kept_text = lru_cache(maxsize=256)(json.dumps)
"""Most texts come again: a definition of a flare profile has some kB."""


def _real_text(value: float) -> str:
    text = repr(value)
    return json.dumps(value) if text[-1] == "f" else text  # JSON has Infinity


_last = RowMaker(LAST, "id", "parent_id", "footfit_version")
_frame, _flare = RowMaker(FRAME, "last_id", "paper_transform"), RowMaker(FLARE, "last_id")
_measure = RowMaker(MEASURE, "last_id", "position", own=("total_sd", "value"))
_notice = RowMaker(NOTICE, "last_id", "position")
_sealed = [RowMaker(table, "last_id") for table in SEALED]

WRITTEN: dict[str, tuple[str, ...]] = {
    LAST.name: (*_last.names, "record_sha256"),
    FRAME.name: _frame.names,
    FLARE.name: _flare.names,
    MEASURE.name: (*_measure.names[1:-2], "last_id", *_measure.names[-2:]),
    NOTICE.name: _notice.names,
    **{table.name: (*maker.names, "sha256") for table, maker in zip(SEALED, _sealed, strict=True)},
}
"""The tables of lasts in the order in which their rows are written, each with its columns."""


def sealed_rows(
    key: int, record: LastRecord, paper_transform: Floats, beside: Iterable[object]
) -> dict[str, list[Values]]:
    """Every row of a new last without a parent, by table.

    ``paper_transform`` (4, 4) is by the catalogue's reference. ``beside`` are the mesh copy of the
    last, its sections and its parentage, None for what it lacks.
    """
    of_last = _last.values(record, key, None, __version__)
    frame, flare = _frame.values(record, key, blob(paper_transform)), _flare.values(record, key)
    measures, measure_texts = _measure_rows(key, record.measures)
    notices = [_notice.values(item, key, i) for i, item in enumerate(record.warnings)]
    text = (
        f'{{"flare":{_flare.text(flare)},"frame":{_frame.text(frame)},"last":{_last.text(of_last)}'
        f',"measures":[{",".join(measure_texts)}]'
        f',"notices":[{",".join(map(_notice.text, notices))}]}}'
    )
    rows = {
        LAST.name: [(*of_last, text_digest(text))],
        FRAME.name: [frame],
        FLARE.name: [flare],
        MEASURE.name: measures,
        NOTICE.name: notices,
    }
    for table, maker, value in zip(SEALED, _sealed, beside, strict=True):
        if value is not None:
            values = maker.values(value, key)
            rows[table.name] = [(*values, text_digest(f'{{"row":{maker.text(values)}}}'))]
    return rows


def _measure_rows(key: int, measures: Iterable[Measure]) -> tuple[list[Values], list[str]]:
    """The rows of measures, and the canonical JSON of each, in which the value comes last."""
    rows, texts = [], []
    for position, measure in enumerate(measures):
        measured = measure.measured
        total_sd, value = measured.total_sd, measured.value
        fixed, text = _fixed_part(
            position,
            measure.name,
            measure.definition,
            measured.reason,
            measured.sd,
            measured.bias,
        )
        if total_sd is not None and value is not None and isfinite(total_sd + value):
            total_sd, value = float(total_sd) + 0.0, float(value) + 0.0
            rows.append(fixed + (key, total_sd, value))  # noqa: RUF005 - it is three times as fast
            texts.append(f'{text},"total_sd":{total_sd!r},"value":{value!r}}}')
        else:
            values = _measure.values(measure, key, position)
            rows.append((*fixed, key, *values[-2:]))
            texts.append(_measure.text(values))
    return rows, texts


@lru_cache(maxsize=4096)
def _fixed_part(
    position: int,
    name: str,
    definition: str,
    reason: str | None,
    sd: float | None,
    bias: float | None,
) -> tuple[Values, str]:
    """What a measure's row has besides its key and its ``own`` columns, and how its text begins."""
    measure = Measure(name, Measured(None, sd, reason, bias=bias), definition)
    values = _measure.values(measure, None, position)
    return values[1:-2], _measure.text(values)[:-1]
