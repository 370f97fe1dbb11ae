"""How a batch is answered: each mesh as it comes, warnings beside, one exit code at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import typer

from footfit.cli.console import answer, error_line, say, say_notices, show
from footfit.cli.options import STDOUT
from footfit.cli.signals import LISTENER
from footfit.errors import BadOption, FootfitError

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
    """Do a verb of `footfit.api` with each mesh, answer each as it comes, and exit.

    Raises
    ------
    Exit
        With the failures' common code.
    BadOption, OutputExists, UnreadableFile
        Before any work: an output cannot be written, or there is no mesh.
    """
    from footfit.api import scans

    outputs.refuse(as_json=mode.json)
    sources = sources_of(meshes, reading, split=batch.split)
    outputs.require_one(sources)
    outcomes = scans.outcomes(verb, sources, jobs=batch.jobs, **reading.keywords(), **options)
    raise typer.Exit(answer_outcomes(outcomes, replace(mode, total=len(sources)), outputs))


def answer_outcomes(
    outcomes: Iterable[Outcome[Any, T]],
    mode: OutputMode,
    outputs: Outputs,
    then: Callable[[T], object] | None = None,
) -> int:
    """Tell each outcome as it comes, write the files, do ``then``; return the exit code."""
    kept: list[T] = []

    def written(result: T) -> None:
        outputs.write(result)
        if outputs.csv is not None:
            kept.append(result)
        if then is not None:
            then(result)

    code = tell_outcomes(outcomes, replace(mode, answers=outputs.csv != STDOUT), written)
    outputs.write_csv(kept)
    return code


def answer_result(result: Any, mode: OutputMode, outputs: Outputs) -> None:
    """Write the files of a single result, and tell it."""
    outputs.write(result)
    tell(result, replace(mode, answers=outputs.csv != STDOUT))
    outputs.write_csv([result])


def sources_of(meshes: Sequence[str], reading: Scale, *, split: bool = False) -> list[Source]:
    """The meshes that a command was given, standard input among them.

    Raises
    ------
    BadOption
        ``-`` beside other meshes, or without ``--format``.
    UnreadableFile
        A folder or glob without a mesh.
    """
    from footfit.api import inputs
    from footfit.pipeline.batch.sources import stdin_source

    if "-" not in meshes:
        return inputs.sources(list(meshes), split=split, **reading.keywords())
    if list(meshes) != ["-"]:
        raise BadOption("- reads one mesh from standard input; give it alone")
    if reading.format is None:
        raise BadOption("a mesh on standard input needs --format, for example --format stl")
    source = stdin_source(sys.stdin.buffer, reading.format.value)
    return inputs.sources([source], split=split, **reading.keywords())


def tell_outcomes(
    outcomes: Iterable[Outcome[Any, T]], mode: OutputMode, then: Callable[[T], object]
) -> int:
    """Tell each outcome as it comes, and do ``then`` with its value; return the exit code.

    One bad mesh stops nothing: its line says so, and the code at the end is the failures'.
    """
    from footfit.pipeline.batch.runs import common_code

    errors: list[FootfitError] = []
    with failures_last(mode) as tell_failure:
        for outcome in counted(outcomes, mode):
            if outcome.value is None:
                assert outcome.error is not None
                errors.append(outcome.error)
                line = error_line(outcome.error, as_json=mode.json)
                if mode.json and mode.answers:
                    answer(line)
                tell_failure(line)
                continue
            tell(outcome.value, mode)
            then(outcome.value)
    if errors and mode.total > 1:
        say(f"{len(errors)} of {mode.total} meshes failed", quiet=mode.quiet or mode.json)
    return common_code(int(error.exit) for error in errors)


def tell(value: Any, mode: OutputMode) -> None:
    """One result: its notices on stderr, itself on stdout."""
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
    """Say failures as they come; with --json after everything else, so that stderr's last line is
    one, whatever warnings the later meshes have.
    """
    lines: list[str] = []
    try:
        yield lines.append if mode.json else say
    finally:
        for line in lines:
            say(line)


def counted(items: Iterable[T], mode: OutputMode) -> Iterator[T]:
    """``items``, counted for who interrupts them, and behind a progress bar where a person
    watches several meshes go by.
    """
    LISTENER.total = mode.total
    shown = mode.total > 1 and not (mode.quiet or mode.json) and sys.stderr.isatty()
    for item in _behind_a_bar(items, mode.total) if shown else items:
        yield item
        LISTENER.done += 1


def _behind_a_bar(items: Iterable[T], total: int) -> Iterator[T]:
    """The bar is taken down while an item is dealt with: its answer has the screen to itself."""
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
