"""Numbers out of text, in NumPy: what the text formats (ASCII STL, OBJ, PLY, OFF) share."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Floats, Ints

BLANK = 32
"""A space: everything up to it is taken as white space."""
_NEWLINE = 10
_Number = TypeVar("_Number", np.float64, np.int64)


@dataclass(frozen=True, slots=True)
class Lines:
    """Where the words of a text are, line by line.

    ``buffer`` (b,) uint8; ``words`` (w,) the offset of each word; ``first`` (k + 1,) the number
    of each line's first word, for the k lines that have one; ``lines`` (k, 2) the offsets where
    those lines begin and end.
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
    """The text without a byte-order mark, its lines ended by newlines."""
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
        A word is no number.

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
        A word is no integer.
    """
    return _numbers(text, count, np.int64)


def _numbers(text: bytes, count: int, dtype: type[_Number]) -> NDArray[_Number]:
    if count == 0:
        return np.empty(0, dtype=dtype)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)  # how older NumPy says "no number"
            values = np.fromstring(text, dtype=dtype, sep=" ")
    except (ValueError, DeprecationWarning) as error:
        raise DamagedMesh("a word stands where a number should: export the mesh again") from error
    if len(values) != count:
        raise DamagedMesh("two numbers run into each other: export the mesh again")
    return values
