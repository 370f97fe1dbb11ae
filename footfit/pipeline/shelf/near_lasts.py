"""Which lasts are near a shape by flare, or by flare and size: all distances, or the least."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.catalogue.blocks.block_bytes import BOTTOM, MEASURES, PLAN
from footfit.geometry.flare.profile_sketch import Sketches, least_squares
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.pipeline.shelf.nearness import extent_squares, feet_distance, shape_distance
from footfit.pipeline.shelf.shelf import Lasts
from footfit.results import Profiled
from footfit.results.columns.last_columns import LastColumns

FIRST_PICKED = 64
"""So many lasts with the least bounds say how near the best are at least."""
MARGIN = 1e-5
"""More than distances are rounded by, when they are compared, and more than bounds are."""


@dataclass(frozen=True, slots=True)
class Shape:
    """What lasts are compared with: one foot, or two of which one is the ``longer``."""

    feet: tuple[Profiled, ...]
    longer: int
    with_size: bool

    @property
    def parts(self) -> tuple[str, ...]:
        """What a distance reads of lasts."""
        return (MEASURES, PLAN, BOTTOM) if self.with_size else (PLAN, BOTTOM)

    def distances(self, lasts: LastColumns) -> Floats:
        """The distances of n lasts, (n,)."""
        if self.with_size:
            return shape_distance(self.feet, self.longer, lasts)
        return feet_distance(self.feet, lasts)

    def least_distances(self, lasts: LastColumns, known: Sketches) -> Floats | None:
        """Lower bounds (n,) of the distances of n lasts, from their sketches; NaN where nothing is
        known. None if a foot has no sketch.
        """
        least = least_squares([foot.flare for foot in self.feet], known)
        if least is None:
            return None
        squares: Floats = np.maximum(least, 0.0, out=least)
        if self.with_size:
            squares = squares + extent_squares(self.feet[self.longer], lasts)
        return np.asarray(np.sqrt(squares))


def all_distances(shape: Shape, lasts: Lasts, chosen: Bools) -> Floats:
    """The distance (n,) of each last that is ``chosen`` (n,)."""
    distance = np.full(len(chosen), np.nan)
    for start, chunk in lasts.chunks(shape.parts):
        some = np.arange(len(chunk))
        if (chunk.stations != len(shape.feet[0].flare.stations)).any():  # of outdated profiles
            some = np.flatnonzero(chosen[start : start + len(chunk)])
            chunk = chunk.taken(some)
        distance[start + some] = shape.distances(chunk)
    return distance


def least_of(
    shape: Shape, lasts: Lasts, chosen: Bools, top: int, reach: float
) -> tuple[Ints, Floats] | None:
    """The rows of the best ``top`` lasts of those that are ``chosen`` (n,), and of all that are at
    most ``reach`` further away than the last of them, with the distances (n,) of all lasts, which
    are NaN for the others.

    Bounds from sketches leave the others out; every distance is exact. None if the lasts have no
    sketches, or the shape has none.
    """
    known = lasts.sketches()
    least = None if known is None else shape.least_distances(lasts.base, known)
    if least is None:
        return None
    rows = np.flatnonzero(chosen)
    if len(rows) < len(least):
        least = least[rows]
    count = min(max(FIRST_PICKED, top), len(rows) - 1)
    distance = np.full(len(chosen), np.nan)
    first = rows[np.argpartition(least, count)[:count]]
    _measure(shape, lasts, first, distance)
    best = np.sort(distance[first])[:top]
    known_best = len(best) == top and np.isfinite(best[-1])
    limit = float(best[-1] + reach) * (1.0 + MARGIN) + MARGIN if known_best else np.inf
    rows = rows[~(least > limit)]  # a last without a sketch has no bound
    _measure(shape, lasts, rows, distance)
    return rows, distance


def _measure(shape: Shape, lasts: Lasts, rows: Ints, distance: Floats) -> None:
    """Put the distances of some lasts in their places."""
    start = 0
    for chunk in lasts.picked(rows, shape.parts):
        distance[rows[start : start + len(chunk)]] = shape.distances(chunk)
        start += len(chunk)
