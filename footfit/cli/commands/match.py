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
            help="Rank by fit, by flare (the paper's search), or by shape (find a scanned last).",
        ),
    ] = ByName.fit,
    profile: Annotated[
        str,
        typer.Option(
            "--profile",
            metavar="NAME|FILE.toml",
            help="Choose the fit profile: walking, dress, sport, child, safety, or your own file.",
        ),
    ] = "walking",
    pair: Annotated[
        bool, options.switch("--pair", "Take the two scans as the feet of one customer.")
    ] = False,
    top: Annotated[
        int, typer.Option("--top", metavar="N", min=1, help="Show this many lasts.")
    ] = 5,
    style: Annotated[
        str | None, options.option("--style", "Rank only lasts of this style.", "S")
    ] = None,
    size_system: Annotated[
        str | None,
        options.option(
            "--size-system",
            "Give sizes in eu, uk, us-men, us-women, us-women-fia or mondopoint. If lasts are "
            "labelled in this system, rank only those.",
            "S",
        ),
    ] = None,
    clearance: Annotated[
        bool,
        options.switch(
            "--clearance",
            "Put the feet into each shown last, and say in mm where it is tight or loose.",
        ),
    ] = False,
    fail_under: Annotated[
        Least | None,
        options.option(
            "--fail-under", "Exit with 7 if a customer has no last that is at least this."
        ),
    ] = None,
    html: Annotated[
        Path | None, options.output_file("--html", "Write a page that opens in any browser.")
    ] = None,
    csv: options.Csv = None,
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    reading: options.Reading,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Rank the lasts of the catalogue for a foot, with reasons.

    Example: footfit match left.stl right.stl --pair --html report.html
    """
    from dataclasses import replace

    from footfit.api import catalogues, files
    from footfit.cli.answers import answer_outcomes, sources_of
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.cli.settings import catalogue_path
    from footfit.results import Match

    refuse_check(by, fail_under)
    path = catalogue_path(catalogue)
    page = OutputFile(html, ("html", "htm"), lambda answer, _: files.page(answer, path))
    outputs = Outputs((page,), Match, csv, force)
    outputs.refuse(as_json=mode.json)
    sources = sources_of(feet, reading, split=batch.split)
    customers = 1 if pair else len(sources)
    outputs.require_one(range(customers), unless="--pair for one customer's two feet")
    answers = catalogues.open_catalogue(path).match_each(
        sources,
        pair=pair,
        jobs=batch.jobs,
        by=by.value,
        profile=profile,
        top=top,
        style=style,
        size_system=size_system,
        clearance=clearance,
        **reading.keywords(),
    )
    matches: list[Match] = []
    code = answer_outcomes(answers, replace(mode, total=customers), outputs, matches.append)
    if fail_under is not None:
        code = checked_code(matches, fail_under, code, as_json=mode.json)
    raise typer.Exit(code)


def refuse_check(by: ByName, least: Least | None) -> None:
    """Refuse to check a search that gives no verdict.

    Raises
    ------
    BadOption
        A search by shape gives no verdict.
    """
    from footfit.errors import BadOption

    if by is ByName.shape and least is not None:
        raise BadOption("--fail-under goes with --by fit or flare: a search by shape judges no fit")


def checked_code(matches: Sequence[Match], least: Least, code: int, *, as_json: bool) -> int:
    """The exit code after each answer is compared with the verdict that is asked for.

    Raises
    ------
    CheckFailed
        A customer has no last that is at least ``least``, and nothing else failed.
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
