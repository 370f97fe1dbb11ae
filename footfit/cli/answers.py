"""How a batch is answered: each mesh as it comes, warnings beside, one exit code at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from footfit.cli.console import answer, error_line, say, say_notices, show
from footfit.cli.signals import LISTENER
from footfit.errors import BadOption, FootfitError

if TYPE_CHECKING:
    from footfit.pipeline.batch.runs import Outcome
    from footfit.pipeline.batch.sources import ReadingOptions, Source

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Voice:
    """How to speak: JSON lines or tables; with or without messages; how many are awaited.

    ``answers`` False: stdout is taken by something else (``--csv -``).
    """

    as_json: bool
    quiet: bool
    total: int = 1
    answers: bool = True


def sources_of(arguments: Sequence[str], format: str | None) -> list[Source]:
    """The meshes that a command was given, standard input among them.

    Raises
    ------
    BadOption
        ``-`` beside other meshes, or without ``--format``.
    UnreadableFile
        A folder or glob without a mesh.
    """
    from footfit.pipeline.batch.sources import mesh_sources, stdin_source

    if "-" not in arguments:
        return mesh_sources(arguments)
    if list(arguments) != ["-"]:
        raise BadOption("- reads one mesh from standard input; give it alone")
    if format is None:
        raise BadOption("a mesh on standard input needs --format, for example --format stl")
    return [stdin_source(sys.stdin.buffer, format)]


def split_where_asked(
    sources: list[Source], reading: ReadingOptions, *, split: bool
) -> list[Source]:
    """The sources, those of several feet taken apart where that was asked for."""
    if not split:
        return sources
    from footfit.pipeline.scan.split import split_sources

    return split_sources(sources, reading)


def only_one(sources: Sequence[Source], *outputs: Path | None, unless: str = "") -> None:
    """Refuse an output file for several meshes; ``unless`` names another way out.

    Raises
    ------
    BadOption
        Several meshes would be written over one another.
    """
    named = [str(path) for path in outputs if path is not None]
    if named and len(sources) != 1:
        words = f"is one file and there are {len(sources)} meshes; give one mesh"
        raise BadOption(f"{words}, or {unless}" if unless else words, named[0])


def told(
    outcomes: Iterable[Outcome[Any, T]],
    voice: Voice,
    then: Callable[[T], object] | None = None,
) -> int:
    """Say each outcome as it comes, and do ``then`` with its value; return the exit code.

    One bad mesh stops nothing: its line says so, and the code at the end is the failures'.
    """
    from footfit.pipeline.batch.runs import common_code

    errors: list[FootfitError] = []
    with failures_last(voice) as tell_failure:
        for outcome in counted(outcomes, voice):
            if outcome.value is None:
                assert outcome.error is not None
                errors.append(outcome.error)
                line = error_line(outcome.error, as_json=voice.as_json)
                if voice.as_json and voice.answers:
                    answer(line)
                tell_failure(line)
                continue
            tell(outcome.value, voice)
            if then is not None:
                then(outcome.value)
    if errors and voice.total > 1:
        say(f"{len(errors)} of {voice.total} meshes failed", quiet=voice.quiet or voice.as_json)
    return common_code(int(error.exit) for error in errors)


def tell(value: Any, voice: Voice) -> None:
    """One result: its notices on stderr, itself on stdout."""
    from footfit.cli.answer_forms import FORMS

    form = FORMS[type(value)]
    path, notices = form.notices(value)
    say_notices(notices, path, quiet=voice.quiet)
    if not voice.answers:
        return
    if voice.as_json:
        from footfit.report.json import json_line

        answer(json_line(value.to_dict()))
    else:
        show(form.table(value))


@contextmanager
def failures_last(voice: Voice) -> Iterator[Callable[[str], None]]:
    """Say failures as they come; with --json after everything else, so that stderr's last line is
    one, whatever warnings the later meshes have.
    """
    lines: list[str] = []
    try:
        yield lines.append if voice.as_json else say
    finally:
        for line in lines:
            say(line)


def counted(items: Iterable[T], voice: Voice) -> Iterator[T]:
    """``items``, counted for who interrupts them, and behind a progress bar where a person
    watches several meshes go by.
    """
    LISTENER.total = voice.total
    shown = voice.total > 1 and not (voice.quiet or voice.as_json) and sys.stderr.isatty()
    for item in _behind_a_bar(items, voice.total) if shown else items:
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
