"""The one place where an error becomes a line and an exit code."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

from footfit.cli.console import (
    AnswerLost,
    ReaderGone,
    answer,
    check_stdout,
    drop_stdout,
    error_line,
    open_closed_streams,
    say,
)
from footfit.cli.signals import CODES, LISTENER, Stopped
from footfit.errors import BadOption, ExitCode, FootfitError

REPORT_TO = "please report it with the command that you typed (docs/exit-codes.md says how)"


def run_guarded(application: Callable[..., Any], arguments: Sequence[str]) -> int:
    """Run the application on ``arguments``, say what goes wrong, and return the exit code."""
    open_closed_streams()
    with LISTENER.listen():
        try:
            code = _run(application, arguments)
            LISTENER.put_off()
            return code
        except Stopped as stopped:
            say(LISTENER.words(stopped.number))
            return int(CODES[stopped.number])


def _run(application: Callable[..., Any], arguments: Sequence[str]) -> int:
    as_json, verbose = "--json" in arguments, "--verbose" in arguments
    LISTENER.heed()
    try:
        code = application(args=list(arguments), prog_name="footfit", standalone_mode=False)
        if not code:
            check_stdout()
    except FootfitError as error:
        if isinstance(error, AnswerLost) and sys.stdout is not None:
            drop_stdout()
        for each in (error, *error.others):
            say(error_line(each, as_json=as_json, verbose=verbose))
        return int(error.exit)
    except ReaderGone:
        drop_stdout()
        return int(ExitCode.OK)
    except SystemExit as ended:
        if isinstance(ended.__context__, BrokenPipeError):  # Typer wrote it: --show-completion
            return int(ExitCode.OK)
        raise
    except Exception as error:  # noqa: BLE001 - no traceback may reach the user
        return _say_unexpected(error, arguments, as_json=as_json, verbose=verbose)
    return code if isinstance(code, int) else int(ExitCode.OK)


def _say_unexpected(
    error: Exception, arguments: Sequence[str], *, as_json: bool, verbose: bool
) -> int:
    """Say a usage error of the command-line library, or a bug; return the exit code."""
    words = getattr(error, "format_message", None)
    if words is not None and getattr(error, "exit_code", None) == int(ExitCode.USAGE):
        from footfit.cli.usage_words import plain_words

        context = getattr(error, "ctx", None)
        command = context.command_path if context is not None else "footfit"
        message = str(words())
        if type(error).__name__ == "NoArgsIsHelpError":  # its message is the help
            with suppress(ReaderGone, AnswerLost):
                answer(message)
            message = "No command given"
        message = plain_words(" ".join(message.split()), arguments)
        stop = "" if message.endswith("?") else "."
        say(error_line(BadOption(f"{message}{stop} See {command} -h"), as_json=as_json))
        return int(ExitCode.USAGE)
    if verbose:
        import traceback

        traceback.print_exception(error)
    bug = FootfitError(f"a bug: {type(error).__name__}: {error}; {REPORT_TO}")
    bug.code = "bug"  # type: ignore[misc]
    say(error_line(bug, as_json=as_json))
    return int(ExitCode.BUG)
