"""``footfit flare``: the flare profile and the flare angle."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from footfit.cli import options


def flare(
    meshes: options.Meshes,
    plot: Annotated[
        Path | None,
        options.output_file(
            "--plot", "Draw the plan outline, the centre line and its curvature (.svg, .png)."
        ),
    ] = None,
    csv: options.Csv = None,
    force: options.Force = False,
    *,
    reading: options.Reading,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Measure the flare of feet or lasts in degrees; + is inflare.

    Example: footfit flare foot.stl --plot flare.svg
    """
    from footfit.api import files, scans
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.results import Profiled

    picture = OutputFile(plot, PICTURE_KINDS, files.picture)
    outputs = Outputs((picture,), Profiled, csv, force)
    answer_scans(scans.flare, meshes, reading, batch, mode, outputs)
