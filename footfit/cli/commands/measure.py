"""``footfit measure``: lengths, widths, girths and heights in mm."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.results import MeasuredScan


def measure(
    meshes: options.Meshes,
    csv: options.Csv = None,
    side: options.Side = options.SideChoice.auto,
    units: options.Units = options.UnitName.auto,
    known_length: options.Known = None,
    format: options.Format = None,
    split: options.Split = False,
    jobs: options.Jobs = 1,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Measure feet or lasts: lengths, widths, girths and heights in mm.

    Example: footfit measure left.stl right.stl --csv measures.csv
    """
    from functools import partial

    from footfit.cli.answers import Voice, sources_of, split_where_asked, told
    from footfit.cli.outputs import refuse_existing, write_or_answer
    from footfit.pipeline.batch.runs import outcomes
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.scan.measure import measured_source
    from footfit.report.csv import csv_text
    from footfit.results import MeasuredScan

    refuse_existing(csv, force=force)
    reading = ReadingOptions(units.value, known_length, side.value)
    sources = split_where_asked(sources_of(meshes, format), reading, split=split)
    work = partial(measured_source, reading=reading)
    voice = Voice(json, quiet, len(sources), answers=csv != options.STDOUT)
    shapes: list[MeasuredScan] = []
    code = told(outcomes(work, sources, jobs), voice, then=shapes.append)
    if csv is not None:
        write_or_answer(csv, csv_text(MeasuredScan, shapes), force=force)
    raise typer.Exit(code)
