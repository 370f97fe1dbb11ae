"""``footfit compare``: one foot in one last, section by section and surface against surface."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.pipeline.fit.compare import LastShape
    from footfit.results import Comparison


def compare(
    foot: Annotated[
        str,
        typer.Argument(
            metavar="FOOT",
            show_default=False,
            help="The foot's mesh file; - reads it from stdin.",
        ),
    ],
    last: Annotated[
        str,
        typer.Argument(
            metavar="LAST",
            show_default=False,
            help="A last of the catalogue by name, or a mesh file.",
        ),
    ],
    output: Annotated[
        Path | None,
        options.file_to_write(
            "-o",
            "--output",
            help="Write the foot in the last's frame coloured by the room: .ply, or a picture.",
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        options.file_to_write(
            "--plot", help="Draw the sections of the foot over the last's (.svg, .png)."
        ),
    ] = None,
    html: Annotated[
        Path | None,
        options.file_to_write(
            "--html", help="Write a report with a 3D view that opens in any browser."
        ),
    ] = None,
    csv: options.Csv = None,
    side: options.Side = options.SideChoice.auto,
    units: options.Units = options.UnitName.auto,
    known_length: options.Known = None,
    format: options.Format = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Lay a foot into a last: the room around it in mm, zone by zone and section by section.

    Example: footfit compare foot.stl derby-42 --html report.html
    """
    from footfit.cli.answers import Voice, only_one, sources_of, tell
    from footfit.cli.outputs import refuse_existing
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.fit.compare import compared
    from footfit.pipeline.scan.reading import profiled_source

    sources = sources_of([foot], format)
    only_one(sources, Path(foot))
    refuse_existing(output, plot, html, csv, force=force)
    reading = ReadingOptions(units.value, known_length, side.value)
    around = last_named(last, catalogue)
    comparison = compared(profiled_source(sources[0], reading), around)
    write_comparison(comparison, output, plot, html, force=force)
    tell(comparison, Voice(json, quiet, answers=csv != options.STDOUT))
    write_csv(comparison, csv, force=force)


def last_named(last: str, catalogue: Path | None) -> LastShape:
    """The last of that file, or of that name in the catalogue."""
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.batch.sources import ReadingOptions, Source
    from footfit.pipeline.fit.compare import scanned_last, stored_last

    if Path(last).is_file():
        return scanned_last(Source(last), ReadingOptions())
    return stored_last(catalogue_path(catalogue), last)


def write_comparison(
    comparison: Comparison,
    output: Path | None,
    plot: Path | None,
    html: Path | None,
    *,
    force: bool,
) -> None:
    """Write the files that were asked for."""
    from footfit.cli.outputs import write_output
    from footfit.pipeline.drawables import drawable
    from footfit.pipeline.export import PICTURE_KINDS, file_kind
    from footfit.report.page.compare_page import compare_report
    from footfit.report.pictures.figures import picture_bytes
    from footfit.report.pictures.heat_figure import HEAT_KINDS, heat_bytes
    from footfit.report.pictures.section_figure import section_figure

    if output is not None:
        data = heat_bytes(comparison, file_kind(output, HEAT_KINDS))
        write_output(output, data, force=force)
    if plot is not None:
        data = picture_bytes(section_figure(comparison), file_kind(plot, PICTURE_KINDS))
        write_output(plot, data, force=force)
    if html is not None:
        write_output(html, compare_report(drawable(comparison)), force=force)


def write_csv(comparison: Comparison, csv: Path | None, *, force: bool) -> None:
    """Write the tables, to a file or to stdout."""
    from footfit.cli.outputs import write_or_answer
    from footfit.report.csv import csv_text
    from footfit.results import Comparison

    if csv is not None:
        write_or_answer(csv, csv_text(Comparison, [comparison]), force=force)
