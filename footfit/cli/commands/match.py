"""``footfit match``: which lasts fit this foot, and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.errors import FootfitError
    from footfit.pipeline.batch.runs import Outcome
    from footfit.pipeline.customers.customer import Customer
    from footfit.report.terminal.summary_tables import CustomerLine
    from footfit.results import Match


ByName = Literal["fit", "flare", "shape"]
"""What to rank by."""
Least = Literal["good", "acceptable"]
"""The verdict that is asked for."""
HTML = ("html", "htm")
PROFILE = "walking"


def match(
    feet: list[str] | None = options.argument(
        "MESH",
        "Give mesh files, folders or globs, or - to read one mesh from stdin; or --pairs FILE.csv.",
        default=None,
    ),
    by: ByName = options.option(
        "--by",
        "Rank by fit, by flare (the paper's search), or by shape (find a scanned last).",
        default="fit",
    ),
    profile: str = options.option(
        "--profile",
        "Choose the fit profile: list-profiles shows their names. Or give your own file.",
        "NAME|FILE.toml",
        default=PROFILE,
    ),
    pair: bool = options.switch("--pair", "Take the two scans as the feet of one customer."),
    pairs: str | None = options.option(
        "--pairs",
        "Match many customers with two feet each. auto takes left and right from the file names; "
        "a CSV has the columns customer, left and right.",
        "auto|FILE.csv",
    ),
    top: int = options.option("--top", "Show this many lasts.", "N", default=5, min=1),
    style: str | None = options.option("--style", "Rank only lasts of this style.", "S"),
    size_system: str | None = options.option(
        "--size-system",
        "Give sizes in eu, uk, us-men, us-women, us-women-fia or mondopoint. If lasts are "
        "labelled in this system, rank only those.",
        "S",
    ),
    stock: Path | None = options.option(
        "--stock",
        "Rank only what is in stock: a CSV with last, or style, size, size_system and width_label, "
        "and quantity.",
        "FILE.csv",
    ),
    clearance: bool = options.switch(
        "--clearance",
        "Put the feet into each shown last, and say in mm where it is tight or loose.",
    ),
    force_foot: bool = options.switch(
        "--force-foot", "Take the shape for a foot even if it is surely a last."
    ),
    fail_under: Least | None = options.option(
        "--fail-under", "Exit with 7 if the first last of a customer is not at least this."
    ),
    html: Path | None = options.output_files(
        "--html",
        "Write a page that opens in any browser; into a folder, a page for each customer.",
        "-o",
    ),
    sheet: Path | None = options.output_files(
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
    worn: options.WornWith,
    growing: options.Growing,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Rank the lasts of the catalogue for a foot, with reasons.

    The toe room comes first: the last's length along its bottom less the foot's length.

    ± is the spread of a second scan of the same shape; total ± also holds what is known of the
    trueness.

    Example: footfit match left.stl right.stl --pair --html report.html --sheet sheet.html
    """
    from dataclasses import replace
    from functools import partial

    from footfit.api import files
    from footfit.cli.answers import answer_outcomes
    from footfit.cli.console import show
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.errors import BadOption
    from footfit.report.terminal.summary_tables import customers_table
    from footfit.results import FailedMatch, Match

    if by == "shape" and fail_under is not None:
        raise BadOption("--fail-under goes with --by fit or flare: a search by shape judges no fit")
    catalogue = lasts.open()
    unused = unused_by_shape(profile, reading, worn, growing, clearance=clearance)
    if by == "shape" and unused:
        raise BadOption(f"{unused} goes with --by fit or flare: a search by shape judges no fit")
    if by != "fit" and sheet is not None:
        raise BadOption("--sheet goes with --by fit: the sheet says which shoe fits")
    if (title or customer) and html is None and sheet is None:
        raise BadOption("--title and --customer go with --html or --sheet, which show them")
    files.require_short(title=title, customer=customer)

    def head(match: Match) -> str:
        return customer or (match.customer or "")[: files.MOST_LETTERS]

    page, sheet_for = partial(files.page, title=title), partial(files.sheet, title=title)
    pages = (
        OutputFile(html, HTML, lambda one, _: page(one, catalogue.path, customer=head(one))),
        OutputFile(sheet, HTML, lambda one, _: sheet_for(one, customer=head(one)), "-sheet"),
    )

    def failed(one: Customer, error: FootfitError) -> FailedMatch:
        return FailedMatch(one.paths, error.code, error.message, one.name)

    outputs = Outputs(pages, Match, csv, force, failed_table=failed)
    outputs.refuse(as_json=mode.json)
    customers = customers_of(feet or [], pairs, pair, reading, lasts, batch, mode)
    if customer and len(customers) > 1:
        raise BadOption("--customer names one customer; the names of many come from --pairs")
    scans = [foot.source for customer in customers for foot in customer.feet]
    titles = [customer.title for customer in customers]
    outputs = outputs.placed(titles, scans, unless="--pair for one customer's two feet")
    mode = replace(mode, total=len(customers))
    summary = Summary(fail_under)
    with batch.at_work() as jobs:
        answers = catalogue.match_each(
            customers,
            jobs=jobs,
            by=by,
            profile=profile,
            top=top,
            style=style,
            size_system=size_system,
            clearance=clearance,
            stock=stock,
            force_foot=force_foot,
            **reading.keywords(),
            **worn.keywords(),
            **growing.keywords(),
        )
        code = answer_outcomes(answers, mode, outputs, summary.add, len(scans), "customers")
    if len(customers) > 1 and not mode.json and csv != options.STDOUT:
        show(customers_table(summary.lines))
    raise typer.Exit(summary.checked_code(code, as_json=mode.json))


def unused_by_shape(
    profile: str,
    reading: options.FootReading,
    worn: options.WornWith,
    growing: options.Growing,
    *,
    clearance: bool,
) -> str:
    """An option that is given, and that a search by shape does not use; "" if there is none."""
    other = profile if profile != PROFILE else None
    given = {"profile": other, **worn.keywords(), **growing.keywords()}
    if not clearance:  # the feet are then placed in the heels of the lasts
        given |= {"as_scanned": reading.as_scanned, "scanned_at_drop": reading.scanned_at_drop}
    names = (name for name, value in given.items() if value not in (None, False))
    return "".join(f"--{name.removesuffix('_mm').replace('_', '-')}" for name in list(names)[:1])


def customers_of(
    feet: Sequence[str],
    pairs: str | None,
    pair: bool,
    reading: options.FootReading,
    lasts: options.Lasts,
    batch: options.Batch,
    mode: options.OutputMode,
) -> list[Customer]:
    """The customers whose feet are given.

    Raises
    ------
    BadOption, BadManifest, UnreadableFile
        It is not clear whose feet the scans are, or there is none.
    """
    from footfit.api import scans
    from footfit.cli.answers import sources_of
    from footfit.cli.console import say_notices
    from footfit.errors import BadOption
    from footfit.pipeline.customers.customer import alone, alone_notices, one_pair

    if pairs is None and not feet:
        raise BadOption("no mesh was given; name files or a folder, or --pairs FILE.csv")
    if pairs is not None and pair:
        raise BadOption("--pair is for one customer and --pairs for many: give one of them")
    if pair and reading.side != "auto":
        raise BadOption("--side goes with one foot: of two feet the shapes show the sides")
    if pairs is not None and reading.side != "auto":
        raise BadOption("--side goes with no --pairs: the names or the CSV say the sides")
    sources = sources_of(feet, reading, lasts, split=batch.split, quiet=mode.quiet) if feet else []
    if pairs is None:
        return one_pair(sources) if pair else alone(sources)
    customers = scans.customers(sources or None, pairs=pairs)
    if feet:
        say_notices(alone_notices(customers), None, quiet=mode.quiet)
    return customers


@dataclass(slots=True)
class Summary:
    """What came out for each customer, and who has no last that is at least ``least``."""

    least: Least | None
    lines: list[CustomerLine] = field(default_factory=list)
    under: list[str | None] = field(default_factory=list)
    answered: int = 0

    def add(self, outcome: Outcome[Customer, Match]) -> None:
        """Take the outcome of a customer."""
        from footfit.pipeline.fit.match import meets
        from footfit.report.terminal.summary_tables import customer_line

        customer, match = outcome.item, outcome.value
        self.lines.append(customer_line(customer.title, match or outcome.error))
        self.answered += match is not None
        if match is not None and self.least is not None and not meets(match, self.least):
            self.under.append(customer.path)

    def checked_code(self, code: int, *, as_json: bool) -> int:
        """The exit code after each answer is compared with the verdict that is asked for.

        Raises
        ------
        CheckFailed
            The first last of a customer is not at least ``least``, and nothing else failed.
        """
        from footfit.cli.console import error_line, say
        from footfit.errors import CheckFailed
        from footfit.pipeline.batch.runs import common_code

        if not self.under:
            return code
        several = f"{len(self.under)} of {self.answered} customers"
        who = several if self.answered > 1 else "this customer"
        better = "" if self.least == "good" else " or better"
        words = f"no last that is {self.least}{better} comes first for {who}"
        error = CheckFailed(words, self.under[0])
        if not code:
            raise error
        say(error_line(error, as_json=as_json))
        return common_code([code, int(error.exit)])
