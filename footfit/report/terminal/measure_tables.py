"""The answer of ``footfit measure`` for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.text import Text

from footfit.report.terminal.scan_tables import cell, facts, side_words
from footfit.report.wording.text import measured_text

if TYPE_CHECKING:
    from rich.console import RenderableType

    from footfit.results import MeasuredScan


def measure_table(scan: MeasuredScan) -> RenderableType:
    """One mesh: every measure with its uncertainty, or the reason why there is none."""
    alignment = scan.alignment
    rows: list[tuple[str, str | Text]] = [
        ("side", f"{side_words(alignment.side)}, measured as a {alignment.pose.kind}")
    ]
    for measure in scan.measures:
        words = cell(measured_text(measure.measured, "mm"))
        rows.append((measure.name.replace("_", " "), words))
    return facts(rows, title=alignment.info.path or "standard input")
