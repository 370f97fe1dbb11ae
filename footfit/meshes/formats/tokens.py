"""Numbers in text, read by NumPy, for all text formats (ASCII STL, OBJ, PLY, OFF)."""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Floats, Ints

BLANK = 32
"""A space; every character up to it counts as white space."""
_NEWLINE = 10
_DECIMAL_COMMA = re.compile(rb"(?<!\S)[-+]?\d*,\d+(?:[eE][-+]?\d+)?(?!\S)")
_Number = TypeVar("_Number", np.float64, np.int64)


@dataclass(frozen=True, slots=True)
class Lines:
    """Where the words of a text are, line by line.

    ``buffer`` (b,) uint8 is the text; ``words`` (w,) is the offset of each word. For the k lines
    that have a word, ``first`` (k + 1,) is the number of the first word, and ``lines`` (k, 2) are
    the offsets where the line begins and ends.
    """

    buffer: NDArray[np.uint8]
    words: Ints
    first: Ints
    lines: Ints

    @property
    def counts(self) -> Ints:
        """How many words each line has, (k,)."""
        return np.diff(self.first)


def unix_text(data: bytes) -> bytes:
    """The text without a byte-order mark, with newlines at the ends of its lines."""
    text = data.removeprefix(b"\xef\xbb\xbf")
    return text if b"\n" in text or b"\r" not in text else text.replace(b"\r", b"\n")


def text_lines(text: bytes) -> Lines:
    r"""The words and lines of a text.

    Examples
    --------
    >>> text_lines(b"v 1 2\n\n f 3").counts.tolist()
    [3, 2]
    """
    buffer = np.frombuffer(text, dtype=np.uint8)
    words = word_offsets(buffer)
    ends = np.append(np.flatnonzero(buffer == _NEWLINE), len(buffer))
    begins = np.append(0, ends[:-1] + 1)
    upto = np.searchsorted(words, ends)
    filled = np.diff(upto, prepend=0) > 0
    first = np.append(0, upto[filled])
    return Lines(buffer, words, first, np.stack([begins, ends], axis=1)[filled])


def word_offsets(buffer: NDArray[np.uint8]) -> Ints:
    """Where each word begins in a buffer of characters, (w,)."""
    begins = buffer > BLANK
    begins[1:] &= buffer[:-1] <= BLANK
    return np.flatnonzero(begins).astype(np.int64, copy=False)


def floats(text: bytes, count: int) -> Floats:
    r"""Exactly ``count`` white-space separated numbers, (count,) float64.

    Raises
    ------
    DamagedMesh
        A word is not a number.

    Examples
    --------
    >>> floats(b" 1 -2.5e1\t3 ", 3).tolist()
    [1.0, -25.0, 3.0]
    """
    return _numbers(text, count, np.float64)


def integers(text: bytes, count: int) -> Ints:
    """Exactly ``count`` white-space separated integers, (count,) int64.

    Raises
    ------
    DamagedMesh
        A word is not an integer.
    """
    return _numbers(text, count, np.int64)


def coordinates(values: Floats, first: Ints, counts: Ints) -> Floats:
    """The vertices (n, 3) of lines whose ``counts`` (n,) numbers begin at ``first`` (n,).

    Raises
    ------
    DamagedMesh
        A line has fewer than three numbers.
    """
    if (counts < 3).any():
        raise DamagedMesh("a vertex of the file lacks a coordinate: export the mesh again")
    vertices: Floats = values[first[:, None] + np.arange(3)]
    return vertices


def _numbers(text: bytes, count: int, dtype: type[_Number]) -> NDArray[_Number]:
    if count == 0:
        return np.empty(0, dtype=dtype)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)  # so older NumPy says "not a number"
            values = np.fromstring(text, dtype=dtype, sep=" ")
    except (ValueError, DeprecationWarning) as error:
        raise DamagedMesh(_bad_number(text)) from error
    if len(values) != count:
        raise DamagedMesh("two numbers of the file are not separated: export the mesh again")
    return values


def _bad_number(text: bytes) -> str:
    """What is wrong with a text in which a word is not a number."""
    comma = _DECIMAL_COMMA.search(text)
    if comma is None:
        return "the file has a word where a number belongs: export the mesh again"
    number = comma[0].decode("ascii")[:40]
    return (
        f"the file writes numbers with a decimal comma, such as {number}: set the exporter to a"
        " decimal point, or replace the commas in the file by points"
    )
