"""Which lasts of a large catalogue are nearest by flare, without a look at every profile."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from footfit.catalogue.blocks.search_file import SearchFile
from footfit.geometry.flare.profile_sketch import least_squares
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.shelf.nearness import curves_distance
from footfit.results import Profiled

FIRST_PICKED = 64
"""So many lasts with the least bounds say how near the best are at least."""
PICKED = 1024
"""So many lasts are looked at together: their profiles stay in the processor's cache."""
MARGIN = 1e-5
"""More than distances are rounded by when they are compared, and than bounds are wrong by."""


def nearest_by_flare(
    feet: Sequence[Profiled], search: SearchFile, chosen: Bools, top: int, reach: float
) -> tuple[Ints, Floats] | None:
    """The rows of the best ``top`` lasts of those that are ``chosen`` (n,), and of all that are at
    most ``reach`` further away than the last of them, with the distances (n,) of all lasts, which
    are NaN for the others.

    Bounds from sketches leave the others out; every distance is exact. None if a foot has no
    sketch. More than ``top`` lasts are chosen.
    """
    least = least_squares([foot.flare for foot in feet], search.sketches())
    if least is None:
        return None
    rows = np.flatnonzero(chosen)
    if len(rows) < len(least):
        least = least[rows]
    count = min(max(FIRST_PICKED, top), len(rows) - 1)
    distance = np.full(len(chosen), np.nan)
    first = rows[np.argpartition(least, count)[:count]]
    _measure(feet, search, first, distance)
    limit = (float(np.sort(distance[first])[top - 1]) + reach) * (1.0 + MARGIN) + MARGIN
    rows = rows[~(least > limit**2)]  # what has no bound is looked at; NaN leaves out nothing
    _measure(feet, search, rows, distance)
    return rows[~(distance[rows] > limit)], distance


def _measure(feet: Sequence[Profiled], search: SearchFile, rows: Ints, distance: Floats) -> None:
    """Put the distances of some lasts in their places."""
    for start in range(0, len(rows), PICKED):
        some = rows[start : start + PICKED]
        distance[some] = curves_distance(feet, search.curves(some))
