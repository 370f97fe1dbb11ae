"""``footfit flare``: the flare profile and the flare angle."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def flare(
    meshes: list[str] = options.MESHES,
    plot: Path | None = options.output_files(
        "--plot", "Draw the plan outline, the centre line and its curvature (.svg, .png)."
    ),
    csv: Path | None = options.CSV,
    force: bool = options.FORCE,
    *,
    lasts: options.Lasts,
    reading: options.Reading,
    standing: options.Standing,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Measure the flare of feet or lasts in degrees; + is inflare.

    ± is the spread of a second scan of the same shape; total ± also holds what is known of the
    trueness.

    Example: footfit flare foot.stl --plot flare.svg
    """
    from footfit.api import files, scans
    from footfit.cli.answers import answer_scans
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.results import Profiled

    picture = OutputFile(plot, PICTURE_KINDS, files.picture)
    outputs = Outputs((picture,), Profiled, csv, force)
    answer_scans(scans.flare, meshes, reading, batch, mode, outputs, lasts, **standing.keywords())
