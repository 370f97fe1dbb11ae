"""The array types of geometry, and products of rows."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Number = TypeVar("Number", bound=np.generic)


def row_dots(rows: Floats, others: Floats) -> Floats:
    """The dot product of each row (k, d) with the other row, (k,)."""
    products: Floats = np.einsum("ij,ij->i", rows, others)
    return products


def row_lengths(rows: Floats) -> Floats:
    """The length of each row (k, d), (k,)."""
    return np.sqrt(row_dots(rows, rows))


def distinct(values: NDArray[Number]) -> NDArray[Number]:
    """Each of some values once, in order. ``np.unique`` does so too, but it loads ``numpy.ma``.

    Examples
    --------
    >>> distinct(np.array([[2, 1], [2, 3]])).tolist()
    [1, 2, 3]
    """
    ordered = np.sort(values, axis=None)
    new = np.ones(len(ordered), dtype=bool)
    new[1:] = ordered[1:] != ordered[:-1]
    return ordered[new]
