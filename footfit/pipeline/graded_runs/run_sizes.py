"""Sizes and widths of a run: from labels and file names to numbers that rise."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import label_number, system_named

_IN_NAME = re.compile(
    r"(eu|uk|us|fr|mp|jp|kr|cn)?(\d{1,3}(?:[.,]\d{1,3})?)([a-z]{0,4})", re.IGNORECASE
)
SIDES = ("l", "r", "left", "right")
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True, slots=True)
class SizeLabel:
    """A size and a width as they are marked, where they come from, and what else is marked."""

    size: str
    width: str | None
    size_from: str
    size_system: str | None = None
    style: str | None = None
    family: str | None = None


def size_in_name(stem: str) -> SizeLabel | None:
    """The size and the width in a file's name; None if it has none.

    The last part that is a number counts, if need be with a size system before it, and with the
    width behind it or in the next part. The words before it are the style.

    Examples
    --------
    >>> label = size_in_name("derby_EU42_G_right_h25")
    >>> label.size, label.width
    ('42', 'G')
    >>> size_in_name("derby-42,5H").width, size_in_name("derby")
    ('H', None)
    """
    parts = re.split(r"[_\-\s]+", stem)
    for at, text in reversed(list(enumerate(parts))):
        size = _IN_NAME.fullmatch(text)
        if size is None:
            continue
        width = size[3] or _width_in(parts[at + 1 : at + 2])
        words = (part for part in parts[:at] if part.isalpha() and part.lower() not in SIDES)
        return SizeLabel(
            size=size[2].replace(",", "."),
            width=width or None,
            size_from="file name",
            size_system=size[1] and size[1].lower(),
            style=" ".join(words) or None,
        )
    return None


def _width_in(parts: Sequence[str]) -> str:
    """The width in the part after a size; none if that is a side or longer than a width."""
    text = "".join(parts)
    return text if re.fullmatch(r"[A-KM-QS-Z]{1,4}", text) else ""


def size_number(label: str | None, system_name: str | None, last: str) -> float:
    """A size on the adults' scale of its system.

    Raises
    ------
    BadOption
        The label is no number.

    Examples
    --------
    >>> size_number("42 1/2", "eu", "a"), size_number("12C", "uk", "a")
    (42.5, -1.0)
    """
    number = label_number(label)
    if number is None:
        words = (
            f"the last {last!r} has no size that is a number"
            if label
            else (f"the size of {last!r} is not known")
        )
        raise BadOption(f"{words}: give it with --manifest, or footfit edit-last NAME --size 42")
    value, child = number
    system = system_named(system_name)
    return value - (system.child_add or 0.0) if child and system is not None else value


def width_numbers(widths: Sequence[str], order: Sequence[str] = ()) -> dict[str, float]:
    """Each width as a number that rises: by an ``order``, as a number, or by the alphabet.

    Raises
    ------
    BadOption
        The widths are neither all in the order, nor all numbers, nor all single letters.

    Examples
    --------
    >>> width_numbers(["G", "E"]), width_numbers(["95", "100"]), width_numbers(["EE"], ["E", "EE"])
    ({'G': 6.0, 'E': 4.0}, {'95': 95.0, '100': 100.0}, {'EE': 1.0})
    """
    places = {name.casefold(): float(at) for at, name in enumerate(order)}
    if all(width.casefold() in places for width in widths):
        return {width: places[width.casefold()] for width in widths}
    numbers = {width: label_number(width) for width in widths}
    if all(number is not None for number in numbers.values()):
        return {width: number[0] for width, number in numbers.items() if number is not None}
    if all(len(width) == 1 and width.upper() in LETTERS for width in widths):
        return {width: float(LETTERS.index(width.upper())) for width in widths}
    known = f"widths of the rule ({', '.join(order)}), " if order else ""
    words = f"the widths {', '.join(widths)} have no order that is known: take {known}letters from"
    raise BadOption(f"{words} A to Z or numbers, or list them as widths in a rule of your own")
