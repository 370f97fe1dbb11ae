"""What a person sees: answers on stdout, everything else on stderr."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable
from contextlib import suppress
from typing import TYPE_CHECKING, TextIO

from footfit.errors import BadOption, FootfitError
from footfit.report.json import json_line
from footfit.report.wording.text import visible

if TYPE_CHECKING:
    from rich.console import RenderableType

    from footfit.results import Notice

PLAIN_WIDTH = 80
"""The width of tables in a file or a pipe. A narrower table loses columns, so a terminal that is
narrower wraps the lines itself.
"""


class ReaderGone(Exception):
    """Nobody reads stdout any more (``| head``). Not an OSError, which Typer turns into exit 1."""


class AnswerLost(BadOption):
    """The answer could not be written to stdout."""

    code = BadOption.code


def open_closed_streams() -> None:
    """Open the null device where a standard stream is closed (``>&-``).

    Without this, the next file that is opened gets the number of the stream, and what a library
    prints goes into that file. ``sys.stdout`` stays None.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)


def answer(text: str) -> None:
    """Write to stdout as UTF-8, whatever the locale is.

    If stdout is closed, nothing is written and the work goes on; `check_stdout` says so at the end.

    Raises
    ------
    AnswerLost
        The disk behind stdout is full.
    ReaderGone
        Nobody reads stdout.
    """
    if sys.stdout is None:
        return
    data = text if text.endswith("\n") else text + "\n"
    try:
        sys.stdout.buffer.write(data.encode("utf-8", "backslashreplace"))
        sys.stdout.flush()
    except BrokenPipeError as error:
        raise ReaderGone from error
    except OSError as error:
        words = f"the answer could not be written to stdout: {error.strerror}"
        raise AnswerLost(words) from error


def check_stdout() -> None:
    """Refuse a closed stdout at the end of the work: every command has an answer.

    Raises
    ------
    AnswerLost
        stdout is closed.
    """
    if sys.stdout is None:
        words = (
            "the answer is lost, because stdout is closed; add > /dev/null if you need no answer"
        )
        raise AnswerLost(words)


def drop_stdout() -> None:
    """Send what is left in the buffer of stdout nowhere; else Python complains at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def is_terminal(stream: TextIO | None) -> bool:
    """Does a person see this stream, in a terminal that can move its cursor and show colours?"""
    shown = stream is not None and stream.isatty()
    return shown and os.environ.get("TERM") != "dumb"


def show(renderable: RenderableType) -> None:
    """Write a table to stdout, in colour if a terminal shows colours and NO_COLOR is not set."""
    from footfit.report.terminal.scan_tables import terminal_text

    colour = is_terminal(sys.stdout) and not os.environ.get("NO_COLOR")
    seen = sys.stdout is not None and sys.stdout.isatty()
    columns = shutil.get_terminal_size().columns if seen else PLAIN_WIDTH
    answer(terminal_text(renderable, width=max(columns, PLAIN_WIDTH), colour=colour))


def say(message: str, *, quiet: bool = False) -> None:
    """Write one line to stderr, unless ``quiet``."""
    if not quiet and sys.stderr is not None:
        data = visible(message) + "\n"
        with suppress(OSError):  # the disk is full or nobody reads: there is no other place for it
            sys.stderr.buffer.write(data.encode("utf-8", "backslashreplace"))
            sys.stderr.flush()


def say_notices(notices: Iterable[Notice], path: str | None, *, quiet: bool) -> None:
    """Write each notice as one line; the path that it speaks of stands first."""
    for notice in notices:
        about = notice.path or path
        say(f"{about}: {notice.message}" if about else notice.message, quiet=quiet)


def error_line(error: FootfitError, *, as_json: bool, verbose: bool = False) -> str:
    """An error as one line: words, or the ``footfit.error/1`` document.

    ``verbose`` adds the numbers behind it; else the line says how to see them.
    """
    if error.details:
        more = error.details if verbose else "the numbers with --verbose"
        error = type(error)(f"{error.message} ({more})", error.path)
    if as_json:
        return json_line(error.to_dict())
    where = f"{error.path}: " if error.path else ""
    return visible(f"footfit: {where}{error.message}")
