"""``footfit check-run``: does a graded run keep its increments?"""

from __future__ import annotations

from pathlib import Path

import typer

from footfit.cli import options


def check_run(
    run: list[str] = options.argument(
        "FAMILY|FILE",
        "Give a family of the catalogue, or the lasts of a run: files, folders, globs or names.",
    ),
    manifest: Path | None = options.option(
        "--manifest",
        "Take the sizes of files, and how they stand, from this CSV. Else from run.csv beside "
        "them, or the sizes from their names.",
        "CSV",
    ),
    rule: str | None = options.option(
        "--rule",
        "Compare with a grading rule, by its name or its .toml file. Else with the run itself.",
        "NAME|FILE",
    ),
    tolerance: str | None = options.option(
        "--tolerance",
        "Allow so many mm by kind of measure. Else girth=2,length=1.5,width=1,height=1.5.",
        "KIND=MM,...",
    ),
    csv: Path | None = options.CSV,
    jobs: int = options.JOBS,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """Check a run of graded lasts: by how much each measure grows from size to size.

    It exits with 7 if an increment is farther off than the tolerance. With --rule it does so too
    if small misses add up to more than that over the run.

    Example: footfit check-run run/ --rule eu
    """
    from footfit.api.last_making import check_run as check
    from footfit.cli.answers import answer_result
    from footfit.cli.console import error_line, say
    from footfit.cli.outputs import Outputs
    from footfit.cli.progress import progress
    from footfit.errors import CheckFailed
    from footfit.pipeline.batch.runs import common_code
    from footfit.results import RunCheck

    outputs = Outputs(table=RunCheck, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    with progress(mode) as bar:
        bar.show()
        checked = check(
            list(run),
            catalogue=lasts.path(),
            manifest=manifest,
            rule=rule,
            tolerance=tolerance,
            jobs=jobs,
        )
    answer_result(checked, mode, outputs)
    errors = list(checked.failed)
    if checked.broken_words:
        errors.append(CheckFailed(checked.broken_words))
    for error in errors:
        say(error_line(error, as_json=mode.json, verbose=mode.verbose))
    raise typer.Exit(common_code(int(error.exit) for error in errors))
