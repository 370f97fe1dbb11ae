"""How a command answers: each mesh as it comes, warnings on stderr, one exit code at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import typer

from footfit.cli.console import answer, error_line, is_terminal, say, say_notices, show
from footfit.cli.options import STDOUT
from footfit.cli.signals import LISTENER
from footfit.errors import BadOption, FootfitError, SeveralFeet

if TYPE_CHECKING:
    from footfit.cli.options import Batch, OutputMode, Scale
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
    **options: Any,
) -> None:
    """Run a verb of `footfit.api` on each mesh, answer each one as it comes, and exit.

    Raises
    ------
    Exit
        Always; with the exit code that the failures share.
    BadOption, OutputExists, UnreadableFile
        Before any work, if an output cannot be written or there is no mesh.
    """
    from footfit.api import scans

    outputs.refuse(as_json=mode.json)
    sources = sources_of(meshes, reading, split=batch.split, quiet=mode.quiet)
    outputs.require_one(sources)
    outputs.keep(sources)
    outcomes = scans.outcomes(verb, sources, jobs=batch.jobs, **reading.keywords(), **options)
    raise typer.Exit(answer_outcomes(outcomes, replace(mode, total=len(sources)), outputs))


def answer_outcomes(
    outcomes: Iterable[Outcome[Any, T]],
    mode: OutputMode,
    outputs: Outputs,
    then: Callable[[T], object] | None = None,
) -> int:
    """Answer each outcome as it comes, write its files, and call ``then``; return the exit code.

    One bad mesh does not stop the others: it has a line of its own, and it sets the exit code.
    """
    from footfit.pipeline.batch.runs import common_code

    mode = replace(mode, answers=outputs.csv != STDOUT)
    errors: list[FootfitError] = []
    tables: list[T] = []
    with failures_last(mode) as say_failure:
        for outcome in watched_items(outcomes, mode):
            result = outcome.value
            if result is None:
                assert outcome.error is not None
                errors.append(outcome.error)
                line = error_line(_advised(outcome.error), as_json=mode.json, verbose=mode.verbose)
                if mode.json and mode.answers:
                    answer(line)
                say_failure(line)
                continue
            tell(result, mode)
            outputs.write(result)
            if outputs.csv is not None:
                tables.append(result)
            if then is not None:
                then(result)
    if errors and mode.total > 1:
        say(f"{len(errors)} of {mode.total} meshes failed", quiet=mode.quiet or mode.json)
    outputs.write_csv(tables)
    return common_code(int(error.exit) for error in errors)


def _advised(error: FootfitError) -> FootfitError:
    """The error, with the advice to use --split: only commands that take many meshes have it."""
    if not isinstance(error, SeveralFeet):
        return error
    return SeveralFeet(f"{error.message}, or add --split to take them apart", error.path)


def answer_result(result: Any, mode: OutputMode, outputs: Outputs) -> None:
    """Write the files of a single result, and tell the result."""
    outputs.write(result)
    tell(result, replace(mode, answers=outputs.csv != STDOUT))
    outputs.write_csv([result])


def sources_of(
    meshes: Sequence[str], reading: Scale, *, split: bool = False, quiet: bool = False
) -> list[Source]:
    """The meshes that a command is given; ``-`` stands for standard input.

    Raises
    ------
    BadOption
        ``-`` stands beside other meshes.
    UnreadableFile
        A folder or glob holds no mesh, or standard input cannot be read.
    """
    from footfit.api import scans
    from footfit.pipeline.batch.sources import left_out, stdin_source

    if "-" not in meshes:
        sources = scans.sources(list(meshes), split=split, **reading.keywords())
        for mesh in meshes:
            say_notices(left_out(mesh), mesh, quiet=quiet)
        return sources
    if list(meshes) != ["-"]:
        raise BadOption("- reads one mesh from standard input; give it alone")
    stream = None if sys.stdin is None else sys.stdin.buffer
    source = stdin_source(stream, reading.format)
    return scans.sources([source], split=split, **reading.keywords())


def tell(value: Any, mode: OutputMode) -> None:
    """Write the notices of a result to stderr, and the result to stdout."""
    from footfit.cli.answer_forms import FORMS

    form = FORMS[type(value)]
    path, notices = form.notices(value)
    say_notices(notices, path, quiet=mode.quiet)
    if not mode.answers:
        return
    if mode.json:
        from footfit.report.json import json_line

        answer(json_line(value.to_dict()))
    else:
        show(form.table(value))


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


def watched_items(items: Iterable[T], mode: OutputMode) -> Iterator[T]:
    """The items, with a count for an interruption, and a progress bar if a person watches."""
    LISTENER.total = mode.total
    watched = mode.total > 1 and not (mode.quiet or mode.json) and is_terminal(sys.stderr)
    for item in _with_a_bar(items, mode.total) if watched else items:
        yield item
        LISTENER.done += 1


def _with_a_bar(items: Iterable[T], total: int) -> Iterator[T]:
    """The items with a progress bar, which is hidden while an item is answered."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    columns = (BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    task = bar.add_task("", total=total)
    bar.start()
    try:
        for item in items:
            bar.stop()
            yield item
            bar.advance(task)
            bar.start()
    finally:
        bar.stop()
