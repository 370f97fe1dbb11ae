"""``footfit measure``: lengths, widths, girths and heights in mm."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def measure(
    meshes: list[str] = options.MESHES,
    profile: str | None = options.option(
        "--profile",
        "Say which lengths are no surprise: those of the feet that a fit profile is for, such as "
        "child. Without it those of adults.",
        "NAME|FILE.toml",
    ),
    csv: Path | None = options.CSV,
    wide: bool = options.switch(
        "--wide", "With --csv: a row for each mesh and a column for each measure."
    ),
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
    from footfit.errors import BadOption
    from footfit.pipeline.fit.fit_profile import fit_profile
    from footfit.results import MeasuredScan, WideMeasures

    if wide and csv is None:
        raise BadOption("--wide goes with --csv FILE: add it")
    outputs = Outputs(table=MeasuredScan, csv=csv, force=force)
    if wide:
        outputs = Outputs((), WideMeasures, csv, force, MeasuredScan.wide, WideMeasures.failed)
    usual_mm = None if profile is None else fit_profile(profile).usual_length_mm
    chosen = {"usual_length_mm": usual_mm, **standing.keywords()}
    answer_scans(scans.measure, meshes, reading, batch, mode, outputs, lasts, **chosen)
