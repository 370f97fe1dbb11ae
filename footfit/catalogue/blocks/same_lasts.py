"""Whether two columns of lasts say the same: a block, and the rows that it is made of."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np

from footfit.results.columns.last_columns import ARRAYS, LastColumns, joined

TOLERANCE = 1e-9
"""Of what is computed for a block: on another machine the last bits may differ."""


def same_lasts(one: LastColumns, other: LastColumns) -> bool:
    """Whether two columns of lasts, of one vocabulary, say the same; toes are only compared if both
    have them.
    """
    if len(one) != len(other) or one.names != other.names:
        return False
    if one.toes is None or other.toes is None:
        one, other = replace(one, toes=None), replace(other, toes=None)
    both = joined([one, other])  # gives them the same measures, and profiles of one length
    one, other = both.taken(slice(0, len(one))), both.taken(slice(len(one), None))
    parts = ((one.measures, other.measures), (one.flare, other.flare), (one.toes, other.toes))
    return all(_same(getattr(one, name), getattr(other, name)) for name in ARRAYS) and all(
        _same(getattr(a, part.name), getattr(b, part.name), TOLERANCE * (a is one.toes))
        for a, b in parts
        if a is not None and b is not None
        for part in fields(a)
    )


def _same(one: Any, other: Any, tolerance: float = 0.0) -> bool:
    if isinstance(one, tuple):
        return bool(one == other)
    if np.array_equal(one, other, equal_nan=one.dtype.kind == "f"):  # the usual case, and quick
        return True
    return tolerance > 0.0 and bool(
        np.allclose(one, other, rtol=tolerance, atol=tolerance, equal_nan=True)
    )
