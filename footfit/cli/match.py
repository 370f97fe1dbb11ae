"""``footfit match``: which lasts fit this foot, and why."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.results import Match


class ByName(StrEnum):
    """What to rank by."""

    fit = "fit"
    flare = "flare"
    shape = "shape"


def match(
    feet: options.Meshes,
    by: Annotated[
        ByName,
        typer.Option(
            "--by",
            help="fit: length, then flare. flare: the paper's search. shape: find a scanned last.",
        ),
    ] = ByName.fit,
    pair: Annotated[
        bool, typer.Option("--pair", help="The two scans are one customer's feet.")
    ] = False,
    top: Annotated[
        int, typer.Option("--top", metavar="N", min=1, help="How many lasts to show.")
    ] = 5,
    style: Annotated[
        str | None,
        typer.Option("--style", metavar="S", show_default=False, help="Only lasts of this style."),
    ] = None,
    size_system: Annotated[
        str | None,
        typer.Option(
            "--size-system", metavar="S", show_default=False, help="Only lasts of this size system."
        ),
    ] = None,
    html: Annotated[
        Path | None,
        typer.Option(
            "--html",
            metavar="FILE",
            show_default=False,
            rich_help_panel=options.OUTPUT,
            help="Write a report that opens in any browser.",
        ),
    ] = None,
    csv: options.Csv = None,
    side: options.Side = options.SideChoice.auto,
    units: options.Units = options.UnitName.auto,
    known_length: options.Known = None,
    format: options.Format = None,
    jobs: options.Jobs = 1,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Rank the lasts of the catalogue for a foot, with reasons.

    Example: footfit match left.stl right.stl --pair --html report.html
    """
    from footfit.cli.answer_forms import MATCH
    from footfit.cli.answers import Voice, only_one, sources_of, told
    from footfit.cli.outputs import refuse_existing, write_or_answer, write_output
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.lasts import library
    from footfit.pipeline.match import Question, customers
    from footfit.pipeline.shapes import candidate_shapes
    from footfit.pipeline.sources import ReadingOptions
    from footfit.report.csv import match_csv
    from footfit.report.html import match_report

    sources = sources_of(feet, format)
    only_one(sources[:1] if pair else sources, html)
    refuse_existing(html, csv, force=force)
    path = catalogue_path(catalogue)
    found = library(path, style, size_system)
    reading = ReadingOptions(units.value, known_length, side.value)
    question = Question(by.value, top)
    answers = customers(sources, reading, found, question, pair=pair, jobs=jobs)
    voice = Voice(json, quiet, 1 if pair else len(sources), answers=csv != options.STDOUT)
    matches: list[Match] = []
    code = told(answers, MATCH, voice, then=matches.append)
    if csv is not None:
        write_or_answer(csv, match_csv(matches), force=force)
    if html is not None and matches:
        shapes = candidate_shapes(path, matches[0])
        write_output(html, match_report(matches[0], shapes), force=force)
    raise typer.Exit(code)
