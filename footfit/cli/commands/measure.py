"""``footfit measure``: lengths, widths, girths and heights in mm."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def measure(
    meshes: list[str] = options.MESHES,
    csv: Path | None = options.CSV,
    force: bool = options.FORCE,
    *,
    lasts: options.Lasts,
    reading: options.Reading,
    standing: options.Standing,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Measure feet or lasts: lengths, widths, girths and heights in mm.

    ± is the spread of a second scan of the same shape; total ± also holds what is known of the
    trueness.

    Example: footfit measure left.stl right.stl --csv measures.csv
    """
    from footfit.api import scans
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import Outputs
    from footfit.results import MeasuredScan

    outputs = Outputs(table=MeasuredScan, csv=csv, force=force)
    answer_scans(scans.measure, meshes, reading, batch, mode, outputs, lasts, **standing.keywords())
