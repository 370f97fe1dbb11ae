"""A usage error in plain words: what the command-line library says, said again."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches

_VALUE = r"Invalid value for '(?P<name>[^']+)'(?: / '[^']+')*: (?P<value>.+?)"
_UNIT_OF = {"int": "a whole number", "float": "a number"}


def plain_words(message: str, arguments: Sequence[str] = ()) -> str:
    """A message of the command-line library in our words; one that is not known stays as it is.

    Examples
    --------
    >>> plain_words("Invalid value for '--top': 0 is not in the range x>=1.")
    '--top takes 1 or more, not 0'
    >>> plain_words("No such option: --unit (Possible options: --quiet, --units)")
    'there is no option --unit; did you mean --units?'
    >>> plain_words("No such option: -f", ("measure", "-foot.stl"))
    '-foot.stl is taken for an option: for a file of this name write ./-foot.stl'
    """
    from footfit.pipeline.batch.sources import MESH_SUFFIXES

    for argument in arguments:
        if argument == "--":
            break
        is_file = argument.lower().endswith(MESH_SUFFIXES) or os.path.lexists(argument)
        if argument[:1] == "-" and is_file:
            words = f"{argument} is taken for an option: for a file of this name write"
            return f"{words} ./{argument}"
    if arguments and arguments[0].startswith("--") and message.startswith("No such option"):
        return f"there is no option {arguments[0]} before a command: write it after the command"
    for pattern, words_of in _KNOWN:
        if match := pattern.fullmatch(message):
            return words_of(match)
    return message.removesuffix(".")


def _in_range(match: re.Match[str]) -> str:
    ends = re.fullmatch(r"([\d.-]+)<=x<=([\d.-]+)", match["range"])
    least = re.fullmatch(r"x>=([\d.-]+)", match["range"])
    within = match["range"]
    if ends:
        within = f"{ends[1]} to {ends[2]}"
    elif least:
        within = f"{least[1]} or more"
    return f"{match['name']} takes {within}, not {match['value']}"


def _a_number(match: re.Match[str]) -> str:
    words = f"{match['name']} takes {_UNIT_OF[match['kind']]}, not {match['value']}"
    comma = re.fullmatch(r"'(\d+),(\d+)'", match["value"])
    return f"{words}: write {comma[1]}.{comma[2]}" if comma else words


def _one_of(match: re.Match[str]) -> str:
    *first, last = match["choices"].replace("'", "").split(", ")
    names = f"{', '.join(first)} or {last}" if first else last
    return f"{match['name']} takes {names}, not {match['value']}"


def _no_option(match: re.Match[str]) -> str:
    options = re.findall(r"--[\w-]+", match["options"] or "")
    close = get_close_matches(match["name"], options, n=1)
    words = f"there is no option {match['name']}"
    if not close and not match["name"].startswith("--"):
        return f"{words}; before a name that begins with - write --"
    return f"{words}; did you mean {close[0]}?" if close else words


def _no_command(match: re.Match[str]) -> str:
    close = f"; did you mean {match['close']}?" if match["close"] else ""
    return f"there is no command {match['name']}{close}"


_KNOWN: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], str]], ...] = (
    (re.compile(rf"{_VALUE} is not in the range (?P<range>.+?)\.?"), _in_range),
    (re.compile(rf"{_VALUE} is not a valid (?P<kind>int|float)(eger)?( range)?\.?"), _a_number),
    (re.compile(rf"{_VALUE} is not one of (?P<choices>.+?)\.?"), _one_of),
    (
        re.compile(r"No such option: (?P<name>\S+?)\.?( \(Possible options: (?P<options>.+)\))?"),
        _no_option,
    ),
    (
        re.compile(r"No such command (?P<name>'.*?')\.( Did you mean '?(?P<close>[\w-]+).*)?"),
        _no_command,
    ),
    (
        re.compile(r"Got unexpected extra arguments?(\(s\))? \((?P<more>.*)\)\.?"),
        lambda match: f"there are too many arguments: {match['more']}",
    ),
    (
        re.compile(r"Option '(?P<name>[^']+)' requires an argument\.?"),
        lambda match: f"{match['name']} needs a value",
    ),
    (
        re.compile(r"Missing (argument|option) '(?P<name>[^']+)'.*"),
        lambda match: f"{match['name']} is missing",
    ),
)
"""What the library says, and what we say."""
