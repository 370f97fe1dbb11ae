"""What a person sees: answers on stdout, everything else on stderr."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable
from contextlib import suppress
from typing import TYPE_CHECKING

from footfit.errors import BadOption, FootfitError
from footfit.report.json import json_line
from footfit.report.wording.text import visible

if TYPE_CHECKING:
    from rich.console import RenderableType

    from footfit.results import Notice

PLAIN_WIDTH = 80


class ReaderGone(Exception):
    """Nobody reads stdout any more (``| head``). Not an OSError, which Typer turns into exit 1."""


def answer(text: str) -> None:
    """Write to stdout as UTF-8, whatever the locale is.

    Raises
    ------
    BadOption
        The disk behind stdout is full.
    ReaderGone
        Nobody reads stdout.
    """
    data = text if text.endswith("\n") else text + "\n"
    try:
        sys.stdout.buffer.write(data.encode("utf-8", "backslashreplace"))
        sys.stdout.flush()
    except BrokenPipeError as error:
        raise ReaderGone from error
    except OSError as error:
        raise BadOption(f"the answer could not be written to stdout: {error.strerror}") from error


def show(renderable: RenderableType) -> None:
    """Write a table to stdout, in colour if a terminal shows it and NO_COLOR is not set."""
    from footfit.report.terminal.scan_tables import terminal_text

    colour = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else PLAIN_WIDTH
    answer(terminal_text(renderable, width=width, colour=colour))


def say(message: str, *, quiet: bool = False) -> None:
    """Write one line to stderr, unless ``quiet``."""
    if not quiet:
        data = visible(message) + "\n"
        with suppress(OSError):  # the disk is full or nobody reads: there is no other place for it
            sys.stderr.buffer.write(data.encode("utf-8", "backslashreplace"))
            sys.stderr.flush()


def say_notices(notices: Iterable[Notice], path: str | None, *, quiet: bool) -> None:
    """Write each notice as one line that names its file."""
    where = f"{path}: " if path else ""
    for notice in notices:
        say(f"{where}{notice.message}", quiet=quiet)


def error_line(error: FootfitError, *, as_json: bool) -> str:
    """An error as one line: words, or the ``footfit.error/1`` document."""
    if as_json:
        return json_line(error.to_dict())
    where = f"{error.path}: " if error.path else ""
    return visible(f"footfit: {where}{error.message}")
