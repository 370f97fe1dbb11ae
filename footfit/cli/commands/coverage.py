"""``footfit coverage``: whom do the lasts of a catalogue serve, and whom not?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from footfit.cli import options

if TYPE_CHECKING:
    from footfit.api.populations import CoverageAsker
    from footfit.errors import FootfitError
    from footfit.pipeline.population.feet_scans import FootOutcome
    from footfit.results.population.coverage_answer import Coverage

HTML = ("html", "htm")


def coverage(
    feet: list[str] = options.argument(
        "FEET",
        "Give a CSV of measures (id, sex, side, length, ball_girth, width ...; in mm), or scans: "
        "files, folders and globs.",
    ),
    profile: str = options.option(
        "--profile",
        "Choose the fit profile: list-profiles shows their names. Or give your own file.",
        "NAME|FILE.toml",
        default="walking",
    ),
    by: list[str] = options.option(
        "--by",
        "Give the shares by this column of the CSV too; repeat it for more columns.",
        "COLUMN",
        default=[],
    ),
    next_lasts: int = options.option(
        "--next",
        "Plan this many lasts for the feet that no last serves; 0 plans none.",
        "N",
        default=10,
        min=0,
        max=200,
    ),
    style: str | None = options.option("--style", "Take only lasts of this style.", "S"),
    size_system: str | None = options.option(
        "--size-system",
        "Give sizes in eu, uk, us-men, us-women, us-women-fia or mondopoint. If lasts are "
        "labelled in this system, take only those.",
        "S",
    ),
    stock: Path | None = options.option(
        "--stock",
        "Take only what is in stock: a CSV with last, or style, size, size_system and width_label, "
        "and quantity.",
        "FILE.csv",
    ),
    cache: Path | None = options.option(
        "--cache",
        "Keep the measures of scans in this file, by a hash of each scan, so that a run can go on. "
        "Without it nothing is kept.",
        "FILE",
        panel=options.READING,
    ),
    html: Path | None = options.output_file(
        "--html", "Write a page with pictures that opens in any browser.", "-o"
    ),
    csv: Path | None = options.output_file(
        "--csv", "Write a row for each foot as CSV; - writes it to stdout instead of the table."
    ),
    lasts_csv: Path | None = options.output_file(
        "--lasts-csv", "Write a row for each last as CSV: whom it serves, and whom only it serves."
    ),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    reading: options.FootReading,
    worn: options.WornWith,
    batch: options.Batch,
    mode: options.OutputMode,
) -> None:
    """Say which share of many feet has a good or an acceptable last, and which lasts are missing.

    Each foot has the verdict that match gives with the same measures. What was not measured is not
    judged. Feet are named only as you name them.

    Example: footfit coverage customers.csv --by sex --html coverage.html
    """
    from dataclasses import replace

    from footfit.api.files import page
    from footfit.api.populations import coverage_asker
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import OutputFile, Outputs, refuse_twice
    from footfit.pipeline.batch.runs import common_code
    from footfit.report.csv import csv_text
    from footfit.results.population.coverage_answer import Coverage, LastsTable

    files = (
        OutputFile(html, HTML, lambda answer, _: page(answer)),
        OutputFile(lasts_csv, ("csv",), lambda answer, _: csv_text(LastsTable, [answer.of_lasts])),
    )
    outputs = Outputs(files, Coverage, csv, force)
    outputs.refuse(as_json=mode.json)
    refuse_twice([*outputs.paths, *([] if cache is None else [cache])])
    filters = {"style": style, "size_system": size_system, "stock": stock}
    asked: dict[str, Any] = {
        "profile": profile,
        "group_by": by,
        "next_lasts": next_lasts,
        "cache": cache,
        **filters,
    }
    with batch.at_work() as jobs:
        asked |= {**reading.keywords(), **worn.keywords(), "jobs": jobs}
        asker = coverage_asker(lasts.path(), asked)
        answer, errors = answer_of(asker, feet, reading, batch, mode, outputs)
    columns_of: Any = answer  # the feet of each coverage have columns of their own
    answer_result(answer, mode, replace(outputs, table=columns_of))
    raise typer.Exit(common_code(int(error.exit) for error in errors))


def answer_of(
    asker: CoverageAsker,
    feet: Sequence[str],
    reading: options.FootReading,
    batch: options.Batch,
    mode: options.OutputMode,
    outputs: Any,
) -> tuple[Coverage, list[FootfitError]]:
    """The coverage of a CSV or of scans, and the errors of the scans that failed.

    Raises
    ------
    BadOption
        A CSV stands beside other feet, or an option does not go with what is given.
    """
    from dataclasses import replace

    from footfit.api.populations import is_table
    from footfit.cli.answers import failures_last, sources_of
    from footfit.cli.console import error_line
    from footfit.cli.progress import progress
    from footfit.errors import BadOption

    if any(map(is_table, feet)):
        if len(feet) > 1:
            raise BadOption("give one CSV of measures, or scans: not both, and not several CSVs")
        if asker.asked["cache"] is not None:
            raise BadOption("--cache goes with scans: the measures of a CSV are there already")
        return asker.of_table(Path(feet[0])), []
    if asker.asked["group_by"]:
        raise BadOption("--by goes with a CSV of measures: scans have no columns")
    sources = sources_of(feet, reading, split=batch.split, quiet=mode.quiet)
    outputs.keep(sources)
    errors: list[FootfitError] = []
    many = replace(mode, total=len(sources))
    with failures_last(mode) as say_failure, progress(many) as bar:

        def measured() -> Iterator[FootOutcome]:
            for outcome in bar.items(asker.measured(sources)):
                if outcome.error is not None:
                    errors.append(outcome.error)
                    say_failure(error_line(outcome.error, as_json=mode.json, verbose=mode.verbose))
                yield outcome

        return asker.of_scans(measured()), errors
