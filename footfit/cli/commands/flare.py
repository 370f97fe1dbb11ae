"""``footfit flare``: the curvature of the bottom, and the angle it makes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from footfit.cli import options
from footfit.cli.option_groups import Batch, OutputMode, Reading, with_groups


@with_groups
def flare(
    meshes: options.Meshes,
    plot: Annotated[
        Path | None,
        options.file_to_write(
            "--plot", help="Draw the plan outline, the centre line and its curvature (.svg, .png)."
        ),
    ] = None,
    csv: options.Csv = None,
    force: options.Force = False,
    *,
    reading: Reading,
    batch: Batch,
    mode: OutputMode,
) -> None:
    """Profile the flare of feet or lasts: + is inflare, in degrees.

    Example: footfit flare foot.stl --plot flare.svg
    """
    from footfit import api
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.results import Profiled

    files = (OutputFile(plot, PICTURE_KINDS, api.picture),)
    outputs = Outputs(files, Profiled, csv, force)
    answer_scans(api.flare, meshes, reading, batch, mode, outputs)
