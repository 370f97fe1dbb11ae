"""Names of many lasts in one run of bytes: only those that are looked at become texts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import overload

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.numeric.arrays import Ints

ERRORS = "surrogatepass"
"""A name with a broken byte is kept as it is stored."""


class PackedNames(Sequence[str]):
    """The names of some lasts. ``ends`` says where each of all names ends in ``text``, which is
    UTF-8; ``rows`` (n,) are those that are meant.
    """

    def __init__(self, text: NDArray[np.uint8], ends: Ints, rows: Ints) -> None:
        self.text, self.ends, self.rows = text, ends, rows

    def __len__(self) -> int:
        return len(self.rows)

    @overload
    def __getitem__(self, place: int) -> str: ...

    @overload
    def __getitem__(self, place: slice) -> PackedNames: ...

    def __getitem__(self, place: int | slice) -> str | PackedNames:
        if isinstance(place, slice):
            return PackedNames(self.text, self.ends, self.rows[place])
        row = int(self.rows[place])
        start = int(self.ends[row - 1]) if row else 0
        return str(self.text.data[start : int(self.ends[row])], "utf-8", ERRORS)

    def __iter__(self) -> Iterator[str]:
        ends = self.ends[self.rows].tolist()
        starts = np.where(self.rows > 0, self.ends[self.rows - 1], 0).tolist()
        view = self.text.data
        for start, end in zip(starts, ends, strict=True):
            yield str(view[start:end], "utf-8", ERRORS)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    __hash__ = None  # type: ignore[assignment]

    def taken(self, rows: Ints) -> PackedNames:
        """Some of these names, in the order of ``rows``."""
        return PackedNames(self.text, self.ends, self.rows[rows])


def packed(names: Sequence[str]) -> tuple[NDArray[np.uint8], Ints]:
    """Names as bytes, and where each ends.

    Examples
    --------
    >>> list(PackedNames(*packed(["derby 41", "pump"]), np.array([1, 0])))
    ['pump', 'derby 41']
    """
    each = [name.encode("utf-8", ERRORS) for name in names]
    ends = np.cumsum([len(name) for name in each], dtype=np.int64)
    return np.frombuffer(b"".join(each), np.uint8), ends
