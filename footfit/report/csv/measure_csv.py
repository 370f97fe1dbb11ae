"""The answer of ``footfit measure`` as CSV: a row per mesh and measure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.csv.answers_csv import Cell, csv_text
from footfit.report.json.numbers import millimetres

if TYPE_CHECKING:
    from collections.abc import Iterable

    from footfit.results import MeasuredScan

MEASURE_COLUMNS = ("path", "side", "kind", "measure", "value_mm", "sd_mm", "reason", "definition")


def measures_csv(scans: Iterable[MeasuredScan], *, header: bool = True) -> str:
    """One row per measure of each mesh; what is not measured has a reason instead of a value."""
    rows = (row for scan in scans for row in _rows(scan))
    return csv_text(MEASURE_COLUMNS, rows, header=header)


def _rows(scan: MeasuredScan) -> Iterable[list[Cell]]:
    alignment = scan.alignment
    start: list[Cell] = [alignment.info.path, alignment.side.side, alignment.pose.kind]
    for measure in scan.measures:
        value, sd = millimetres(measure.measured.value), millimetres(measure.measured.sd)
        yield [*start, measure.name, value, sd, measure.measured.reason, measure.definition]
