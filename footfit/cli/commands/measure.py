"""``footfit measure``: lengths, widths, girths and heights in mm."""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import Batch, OutputMode, Reading, with_groups


@with_groups
def measure(
    meshes: options.Meshes,
    csv: options.Csv = None,
    force: options.Force = False,
    *,
    reading: Reading,
    batch: Batch,
    mode: OutputMode,
) -> None:
    """Measure feet or lasts: lengths, widths, girths and heights in mm.

    Example: footfit measure left.stl right.stl --csv measures.csv
    """
    from footfit import api
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import Outputs
    from footfit.results import MeasuredScan

    outputs = Outputs(table=MeasuredScan, csv=csv, force=force)
    answer_scans(api.measure, meshes, reading, batch, mode, outputs)
