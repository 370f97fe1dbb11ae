"""How a command answers: each mesh as it comes, warnings on stderr, one exit code at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import typer

from footfit.cli.console import (
    AnswerLost,
    ReaderGone,
    answer,
    drop_stdout,
    error_line,
    say,
    say_notices,
    show,
)
from footfit.cli.notices import Notices
from footfit.cli.options import STDOUT, Reading
from footfit.cli.outputs import say_written
from footfit.cli.progress import Progress, progress
from footfit.errors import BadOption, FootfitError, SeveralFeet

if TYPE_CHECKING:
    from footfit.cli.options import Batch, Lasts, OutputMode, Scale
    from footfit.cli.outputs import Outputs
    from footfit.pipeline.batch.runs import Outcome
    from footfit.pipeline.batch.sources import Source

T = TypeVar("T")


def answer_scans(
    verb: Callable[..., Any],
    meshes: Sequence[str],
    reading: Scale,
    batch: Batch,
    mode: OutputMode,
    outputs: Outputs,
    lasts: Lasts,
    **options: Any,
) -> None:
    """Run a verb of `footfit.api` on each mesh, answer each one as it comes, and exit.

    A mesh may be a file, or a last of ``lasts`` by its name.

    Raises
    ------
    Exit
        Always; with the exit code that the failures share.
    BadOption, OutputExists, UnreadableFile
        Before any work, if an output cannot be written or there is no mesh.
    ClusterUnusable
        The cluster that is to work cannot be used.
    """
    from footfit.api import scans
    from footfit.pipeline.customers.customer import file_stem

    outputs.refuse(as_json=mode.json)
    sources = sources_of(meshes, reading, lasts, split=batch.split, quiet=mode.quiet)
    outputs = outputs.placed([file_stem(source.path) for source in sources], sources)
    with batch.at_work() as jobs:
        outcomes = scans.outcomes(verb, sources, jobs=jobs, **reading.keywords(), **options)
        code = answer_outcomes(outcomes, replace(mode, total=len(sources)), outputs)
    raise typer.Exit(code)


def answer_outcomes(
    outcomes: Iterable[Outcome[Any, T]],
    mode: OutputMode,
    outputs: Outputs,
    then: Callable[[Outcome[Any, T]], object] | None = None,
    scans: int = 1,
    noun: str = "meshes",
) -> int:
    """Answer each outcome as it comes, write its files, and call ``then``; return the exit code.

    ``scans`` is how many scans a single customer has, ``noun`` what the outcomes are of.

    One bad mesh does not stop the others: it has a line of its own, and it sets the exit code.
    """
    from footfit.pipeline.batch.runs import common_code

    mode = replace(mode, answers=outputs.csv != STDOUT)
    errors: list[FootfitError] = []
    tables: list[Any] = []
    notices = Notices(mode)
    lost: Exception | None = None
    with failures_last(mode) as say_failure, progress(mode, scans) as bar:
        for number, outcome in enumerate(bar.items(outcomes)):
            if then is not None:
                then(outcome)
            result = outcome.value
            if result is None:
                assert outcome.error is not None
                errors.append(outcome.error)
                if outputs.csv is not None and outputs.failed_table is not None:
                    tables.append(outputs.failed_table(outcome.item, outcome.error))
                line = error_line(_advised(outcome.error), as_json=mode.json, verbose=mode.verbose)
                if mode.json and mode.answers:
                    answer(line)
                say_failure(line)
                continue
            try:
                tell(result, mode, notices)
            except (ReaderGone, AnswerLost) as error:
                if not outputs.paths:
                    raise
                lost, mode = error, replace(mode, answers=False)  # the files are still wanted
                drop_stdout()
            write_files(outputs, result, mode, bar, number)
            if outputs.csv is not None:
                tables.append(outputs.as_table(result))
        notices.close()
        if errors and mode.total > 1:
            say(f"{len(errors)} of {mode.total} {noun} failed", quiet=mode.quiet or mode.json)
        say_written(outputs.write_csv(tables), quiet=mode.quiet)
    if isinstance(lost, AnswerLost) and not errors:
        raise lost
    return common_code(int(error.exit) for error in errors)


def _advised(error: FootfitError) -> FootfitError:
    """The error, with the advice to use --split: only commands that take many meshes have it."""
    if not isinstance(error, SeveralFeet):
        return error
    return SeveralFeet(f"{error.message}, or add --split to take them apart", error.path)


def answer_result(result: Any, mode: OutputMode, outputs: Outputs) -> None:
    """Tell a single result, and write its files, also if nobody reads the answer."""
    lost: Exception | None = None
    try:
        tell(result, replace(mode, answers=outputs.csv != STDOUT))
    except (ReaderGone, AnswerLost) as error:
        lost = error
    with progress(mode) as bar:
        write_files(outputs, result, mode, bar, with_csv=True)
    if outputs.csv == STDOUT:
        outputs.write_csv([result])
    if lost is not None:
        raise lost


def write_files(
    outputs: Outputs,
    result: Any,
    mode: OutputMode,
    bar: Progress,
    number: int = 0,
    *,
    with_csv: bool = False,
) -> None:
    """Write the files of a result; the bar of a single customer names this phase."""
    if mode.total == 1 and outputs.writes_files:
        bar.show()
        bar.begin("page")
    written = outputs.write(result, number, with_csv=with_csv)
    bar.hide()
    say_written(written, quiet=mode.quiet)


def sources_of(
    meshes: Sequence[str],
    reading: Scale,
    lasts: Lasts | None = None,
    *,
    split: bool = False,
    sides_given: bool = False,
    quiet: bool = False,
) -> list[Source]:
    """The meshes that a command is given; ``-`` stands for standard input.

    What is no file is a last of ``lasts`` by its name, if the command takes lasts. A manifest may
    give the sides.

    Raises
    ------
    BadOption
        ``-`` stands beside other meshes; a side is to be taken in any case, and none is given.
    UnreadableFile
        A folder or glob holds no mesh, or standard input cannot be read.
    """
    from footfit.api import scans
    from footfit.pipeline.batch.sources import left_out, stdin_source

    forced = isinstance(reading, Reading) and reading.force_side and reading.side == "auto"
    if forced and not sides_given:
        raise BadOption("--force-side goes with --side left or right")
    if "-" not in meshes:
        named = {} if lasts is None else _named(meshes, lasts, quiet=quiet)
        sources = scans.sources(list(meshes), split=split, named=named, **reading.keywords())
        for mesh in meshes:
            say_notices(left_out(mesh), mesh, quiet=quiet)
        return sources
    if list(meshes) != ["-"]:
        raise BadOption("- reads one mesh from standard input; give it alone")
    stream = None if sys.stdin is None else sys.stdin.buffer
    source = stdin_source(stream, reading.format)
    return scans.sources([source], split=split, **reading.keywords())


def _named(meshes: Sequence[str], lasts: Lasts, *, quiet: bool) -> dict[str, Source]:
    """The meshes that are no files; where a file has the name of a last, say that it is taken."""
    from footfit.pipeline.batch.sources import is_no_path

    say_hidden_lasts([mesh for mesh in meshes if not is_no_path(mesh)], lasts, quiet=quiet)
    if not any(map(is_no_path, meshes)):
        return {}
    from footfit.pipeline.library.named_lasts import named_sources

    return named_sources(meshes, lasts.path())


def say_hidden_lasts(meshes: Sequence[str], lasts: Lasts, *, quiet: bool) -> None:
    """Say of each mesh that is a file whether a last of the catalogue has its name."""
    bare = [mesh for mesh in meshes if Path(mesh).name == mesh]
    if not bare:  # the usual case: nothing is imported for it
        return
    from footfit.pipeline.library.named_lasts import hidden_lasts

    with suppress(FootfitError):  # the settings file may be wrong: files need no catalogue
        say_notices(hidden_lasts(bare, lasts.path()), None, quiet=quiet)


def tell(value: Any, mode: OutputMode, notices: Notices | None = None) -> None:
    """Write the notices of a result to stderr, and the result to stdout.

    ``notices`` are those of a batch.
    """
    from footfit.cli.answer_forms import form_of

    (notices or Notices(replace(mode, total=1))).say(value)
    if not mode.answers:
        return
    if mode.json:
        from footfit.report.json import json_line

        answer(json_line(value.to_dict()))
    else:
        show(form_of(value).table(value))


@contextmanager
def failures_last(mode: OutputMode) -> Iterator[Callable[[str], None]]:
    """Give what says a failure: at once, and with --json after all other messages.

    A script that reads JSON finds the error in the last line of stderr.
    """
    lines: list[str] = []
    try:
        yield lines.append if mode.json else say
    finally:
        for line in lines:
            say(line)
