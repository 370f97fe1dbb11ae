"""``footfit match``: which lasts fit this foot, and why."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.errors import FootfitError
    from footfit.pipeline.batch.sources import Source
    from footfit.results import Match


ByName = Literal["fit", "flare", "shape"]
"""What to rank by."""
Least = Literal["good", "acceptable"]
"""The verdict that is asked for."""
HTML = ("html", "htm")


def match(
    feet: list[str] = options.MESHES,
    by: ByName = options.option(
        "--by",
        "Rank by fit, by flare (the paper's search), or by shape (find a scanned last).",
        default="fit",
    ),
    profile: str = options.option(
        "--profile",
        "Choose the fit profile: walking, dress, sport, child, safety, or your own file.",
        "NAME|FILE.toml",
        default="walking",
    ),
    pair: bool = options.switch("--pair", "Take the two scans as the feet of one customer."),
    top: int = options.option("--top", "Show this many lasts.", "N", default=5, min=1),
    style: str | None = options.option("--style", "Rank only lasts of this style.", "S"),
    size_system: str | None = options.option(
        "--size-system",
        "Give sizes in eu, uk, us-men, us-women, us-women-fia or mondopoint. If lasts are "
        "labelled in this system, rank only those.",
        "S",
    ),
    clearance: bool = options.switch(
        "--clearance",
        "Put the feet into each shown last, and say in mm where it is tight or loose.",
    ),
    fail_under: Least | None = options.option(
        "--fail-under", "Exit with 7 if the first last of a customer is not at least this."
    ),
    html: Path | None = options.output_file("--html", "Write a page that opens in any browser."),
    sheet: Path | None = options.output_file(
        "--sheet", "Write the customer's sheet: one page to hand over, which prints on one A4."
    ),
    title: str = options.head_text(
        "--title", "Show this text above the page and the sheet. footfit stores it nowhere.", "TEXT"
    ),
    customer: str = options.head_text(
        "--customer",
        "Show this name of a customer on the page and the sheet. footfit stores it nowhere.",
        "NAME",
    ),
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    reading: options.FootReading,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Rank the lasts of the catalogue for a foot, with reasons.

    The toe room comes first: the last's functional length less the foot's.

    Example: footfit match left.stl right.stl --pair --html report.html --sheet sheet.html
    """
    from dataclasses import replace
    from functools import partial

    from footfit.api import files
    from footfit.cli.answers import answer_outcomes, sources_of
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.errors import BadOption
    from footfit.results import FailedMatch, Match

    if by == "shape" and fail_under is not None:
        raise BadOption("--fail-under goes with --by fit or flare: a search by shape judges no fit")
    catalogue = lasts.open()
    if by != "fit" and sheet is not None:
        raise BadOption("--sheet goes with --by fit: the sheet says which shoe fits")
    if (title or customer) and html is None and sheet is None:
        raise BadOption("--title and --customer go with --html or --sheet, which show them")
    files.require_short(title=title, customer=customer)
    page = partial(files.page, title=title, customer=customer)
    handed_over = partial(files.sheet, title=title, customer=customer)
    pages = (
        OutputFile(html, HTML, lambda answer, _: page(answer, catalogue.path)),
        OutputFile(sheet, HTML, lambda answer, _: handed_over(answer)),
    )

    def failed(source: Source, error: FootfitError) -> FailedMatch:
        paths = [each.path for each in sources] if pair else [source.path]
        return FailedMatch(tuple(paths), error.code, error.message)

    outputs = Outputs(pages, Match, csv, force, failed_table=failed)
    outputs.refuse(as_json=mode.json)
    sources = sources_of(feet, reading, lasts, split=batch.split, quiet=mode.quiet)
    customers = 1 if pair else len(sources)
    outputs.keep(sources)
    outputs.require_one(range(customers), unless="--pair for one customer's two feet")
    answers = catalogue.match_each(
        sources,
        pair=pair,
        jobs=batch.jobs,
        by=by,
        profile=profile,
        top=top,
        style=style,
        size_system=size_system,
        clearance=clearance,
        **reading.keywords(),
    )
    matches: list[Match] = []
    code = answer_outcomes(
        answers, replace(mode, total=customers), outputs, matches.append, len(sources)
    )
    if fail_under is not None:
        code = checked_code(matches, fail_under, code, as_json=mode.json)
    raise typer.Exit(code)


def checked_code(matches: Sequence[Match], least: Least, code: int, *, as_json: bool) -> int:
    """The exit code after each answer is compared with the verdict that is asked for.

    Raises
    ------
    CheckFailed
        The first last of a customer is not at least ``least``, and nothing else failed.
    """
    from footfit.cli.console import error_line, say
    from footfit.errors import CheckFailed
    from footfit.pipeline.batch.runs import common_code
    from footfit.pipeline.fit.match import meets

    under = [match for match in matches if not meets(match, least)]
    if not under:
        return code
    first = under[0].feet[0].aligned.alignment.info.path
    who = f"{len(under)} of {len(matches)} customers" if len(matches) > 1 else "this customer"
    better = "" if least == "good" else " or better"
    error = CheckFailed(f"no last that is {least}{better} comes first for {who}", first)
    if not code:
        raise error
    say(error_line(error, as_json=as_json))
    return common_code([code, int(error.exit)])
