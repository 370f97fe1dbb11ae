"""``footfit match``: which lasts fit this foot, and why."""

from __future__ import annotations

from collections.abc import Sequence
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


class Least(StrEnum):
    """The verdict that is asked for."""

    good = "good"
    acceptable = "acceptable"


def match(
    feet: options.Meshes,
    by: Annotated[
        ByName,
        typer.Option(
            "--by",
            help="fit: length, then zones. flare: the paper's search. shape: find a scanned last.",
        ),
    ] = ByName.fit,
    profile: Annotated[
        str,
        typer.Option(
            "--profile",
            metavar="NAME|FILE.toml",
            help="What is fitted: walking, dress, sport, child, safety, or a profile of your own.",
        ),
    ] = "walking",
    pair: Annotated[
        bool, options.switch("--pair", help="The two scans are one customer's feet.")
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
            "--size-system",
            metavar="S",
            show_default=False,
            help="Say sizes in eu, uk, us-men, us-women, us-women-fia or mondopoint, and take only "
            "lasts labelled in it, if there are any.",
        ),
    ] = None,
    clearance: Annotated[
        bool,
        options.switch(
            "--clearance",
            help="Lay the feet into each shown last: where it is tight, where loose, in mm.",
        ),
    ] = False,
    fail_under: Annotated[
        Least | None,
        typer.Option(
            "--fail-under",
            show_default=False,
            help="Exit 7 where a customer has no last that is at least this.",
        ),
    ] = None,
    html: Annotated[
        Path | None,
        options.file_to_write("--html", help="Write a report that opens in any browser."),
    ] = None,
    csv: options.Csv = None,
    side: options.Side = options.SideChoice.auto,
    units: options.Units = options.UnitName.auto,
    known_length: options.Known = None,
    format: options.Format = None,
    split: options.Split = False,
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
    from footfit.cli.answers import Voice, only_one, sources_of, split_where_asked, told
    from footfit.cli.outputs import one_answer, refuse_existing, write_or_answer
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.batch.sources import ReadingOptions
    from footfit.pipeline.fit.candidates import choice
    from footfit.pipeline.fit.fit_profile import fit_profile
    from footfit.pipeline.fit.match import Question, customers
    from footfit.report.csv import csv_text
    from footfit.results import Match

    refuse_check(by, fail_under)
    refuse_existing(html, force=force, kinds=("html", "htm"))
    refuse_existing(csv, force=force)
    one_answer(csv, as_json=json)
    reading = ReadingOptions(units.value, known_length, side.value)
    sources = split_where_asked(sources_of(feet, format), reading, split=split)
    only_one(sources[:1] if pair else sources, html, unless="--pair for one customer's two feet")
    path = catalogue_path(catalogue)
    question = Question(
        by.value, top, fit_profile(profile), size_system, surfaces_in=path if clearance else None
    )
    found = choice(path, style, size_system)
    answers = customers(sources, reading, found, question, pair=pair, jobs=jobs)
    voice = Voice(json, quiet, 1 if pair else len(sources), answers=csv != options.STDOUT)
    matches: list[Match] = []
    code = told(answers, voice, then=matches.append)
    if csv is not None:
        write_or_answer(csv, csv_text(Match, matches), force=force)
    if html is not None and matches:
        write_report(html, matches[0], path, force=force)
    if fail_under is not None:
        code = checked(matches, fail_under, code, as_json=json)
    raise typer.Exit(code)


def write_report(html: Path, match: Match, catalogue: Path, *, force: bool) -> None:
    """Write one customer's page, with the best lasts drawn."""
    from footfit.cli.outputs import write_output
    from footfit.pipeline.drawables import best_comparisons, candidate_shapes
    from footfit.report.page.match_page import match_report

    drawn = candidate_shapes(catalogue, match), best_comparisons(catalogue, match)
    write_output(html, match_report(match, *drawn), force=force)


def refuse_check(by: ByName, least: Least | None) -> None:
    """Refuse a check of what is not judged.

    Raises
    ------
    BadOption
        A search by shape gives no verdict.
    """
    from footfit.errors import BadOption

    if by is ByName.shape and least is not None:
        raise BadOption("--fail-under goes with --by fit or flare: a search by shape judges no fit")


def checked(matches: Sequence[Match], least: Least, code: int, *, as_json: bool) -> int:
    """The exit code after the answers were held to the verdict asked for.

    Raises
    ------
    CheckFailed
        A customer has no last that is at least ``least``, and nothing else went wrong.
    """
    from footfit.cli.console import error_line, say
    from footfit.errors import CheckFailed
    from footfit.pipeline.batch.runs import common_code
    from footfit.pipeline.fit.match import meets

    under = [match for match in matches if not meets(match, least.value)]
    if not under:
        return code
    first = under[0].feet[0].aligned.alignment.info.path
    who = f"{len(under)} of {len(matches)} customers" if len(matches) > 1 else "this customer"
    verb = "have" if len(under) > 1 else "has"
    better = "" if least is Least.good else " or better"
    error = CheckFailed(f"{who} {verb} no last that is {least.value}{better}", first)
    if not code:
        raise error
    say(error_line(error, as_json=as_json))
    return common_code([code, int(error.exit)])
