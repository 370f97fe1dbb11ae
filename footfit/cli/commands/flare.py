"""``footfit flare``: the curvature of the bottom, and the angle it makes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.results import Profiled


def flare(
    meshes: options.Meshes,
    plot: Annotated[
        Path | None,
        options.file_to_write(
            "--plot", help="Draw the plan outline, the centre line and its curvature (.svg, .png)."
        ),
    ] = None,
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
    """Profile the flare of feet or lasts: + is inflare, in degrees.

    Example: footfit flare foot.stl --plot flare.svg
    """
    from functools import partial

    from footfit.cli.answers import Voice, only_one, sources_of, split_where_asked, told
    from footfit.cli.outputs import one_answer, refuse_existing, write_or_answer, write_output
    from footfit.pipeline.batch.runs import outcomes
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.export import PICTURE_KINDS, file_kind
    from footfit.pipeline.scan.reading import profiled_source
    from footfit.report.csv import csv_text
    from footfit.report.pictures.figures import picture_bytes
    from footfit.report.pictures.flare_figure import flare_figure
    from footfit.results import Profiled

    refuse_existing(plot, force=force, kinds=PICTURE_KINDS)
    refuse_existing(csv, force=force)
    one_answer(csv, as_json=json)
    reading = ReadingOptions(units.value, known_length, side.value)
    sources = split_where_asked(sources_of(meshes, format), reading, split=split)
    only_one(sources, plot)
    work = partial(profiled_source, reading=reading)
    voice = Voice(json, quiet, len(sources), answers=csv != options.STDOUT)
    shapes: list[Profiled] = []
    code = told(outcomes(work, sources, jobs), voice, then=shapes.append)
    if csv is not None:
        write_or_answer(csv, csv_text(Profiled, shapes), force=force)
    if plot is not None and shapes:
        write_output(
            plot,
            picture_bytes(flare_figure(shapes[0]), file_kind(plot, PICTURE_KINDS)),
            force=force,
        )
    raise typer.Exit(code)
