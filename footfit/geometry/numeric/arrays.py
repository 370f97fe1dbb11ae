"""The array types of geometry, and products of rows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]


def row_dots(rows: Floats, others: Floats) -> Floats:
    """The dot product of each row (k, d) with the other row, (k,)."""
    products: Floats = np.einsum("ij,ij->i", rows, others)
    return products


def row_lengths(rows: Floats) -> Floats:
    """The length of each row (k, d), (k,)."""
    return np.sqrt(row_dots(rows, rows))
