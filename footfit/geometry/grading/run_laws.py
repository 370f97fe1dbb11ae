"""The law of a graded run: by how much a measure grows from size to size, and where it breaks.

A run is judged against itself. Its increment is the median of those between neighbours, so that a
wrong last, or a wrong step, does not move what the others are judged by.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.numeric.arrays import Floats

LawName = Literal["arithmetic", "geometric"]
GEOMETRIC_BY = 0.5
"""A run is geometric if that leaves less than this share of what the arithmetic law leaves."""
LEAST_MM = 0.05
"""Both laws fit a run that the arithmetic one misses by less than this, on average."""


@dataclass(frozen=True, slots=True)
class Steps:
    """The increments of one measure between neighbours.

    ``value_mm`` (n,) is the measure, ``place`` (n,) the size or the width as a number that rises.
    """

    place: Floats
    value_mm: Floats

    @property
    def increment_mm(self) -> Floats:
        """From each last to the next, (n - 1,)."""
        return np.diff(self.value_mm)

    def per_step(self, law: LawName) -> float:
        """The run's own increment: mm a whole size, or the natural logarithm of its ratio."""
        if law == "arithmetic":
            return median_rate([self])
        return median_rate([Steps(self.place, np.log(self.value_mm))])

    def expected_mm(self, law: LawName, per_step: float) -> Floats:
        """What the increments would be by a law, (n - 1,).

        Examples
        --------
        >>> steps = Steps(np.array([40.0, 41.0, 42.0]), np.array([200.0, 205.0, 211.0]))
        >>> steps.expected_mm("arithmetic", 5.0).tolist()
        [5.0, 5.0]
        >>> steps.expected_mm("geometric", float(np.log(1.02))).round(3).tolist()
        [4.0, 4.1]
        """
        step = np.diff(self.place)
        if law == "arithmetic":
            return np.asarray(per_step * step)
        return np.asarray(self.value_mm[:-1] * np.expm1(per_step * step))

    def near_mm(self, count: int) -> Floats:
        """What the increments would be by the median of so many steps about each, (n - 1,).

        Examples
        --------
        >>> steps = Steps(np.arange(7.0), np.array([0.0, 1.0, 2.0, 7.0, 4.0, 6.0, 9.0]))
        >>> steps.near_mm(5).tolist()
        [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]
        """
        step = np.diff(self.place)
        rates = self.increment_mm / step
        starts = np.clip(np.arange(len(rates)) - count // 2, 0, max(len(rates) - count, 0))
        medians = [np.median(rates[start : start + count]) for start in starts]
        return np.asarray(medians * step)


def median_rate(runs: Iterable[Steps]) -> float:
    """The median increment between neighbours, over the whole sizes between them.

    Examples
    --------
    >>> median_rate([Steps(np.arange(5.0), np.array([0.0, 5.0, 10.0, 17.0, 22.0]))])
    5.0
    """
    return float(np.median(np.concatenate([run.increment_mm / np.diff(run.place) for run in runs])))


def likely_law(runs: Iterable[Steps]) -> LawName:
    """The law that runs of several measures follow, such as lengths and girths.

    Examples
    --------
    >>> place = np.arange(9.0)
    >>> likely_law([Steps(place, 240.0 + 5.0 * place)])
    'arithmetic'
    >>> likely_law([Steps(place, 240.0 * 1.02**place)])
    'geometric'
    """
    left_mm: dict[LawName, list[float]] = {"arithmetic": [], "geometric": []}
    for run in runs:
        for law, misses in left_mm.items():
            off = run.increment_mm - run.expected_mm(law, run.per_step(law))
            misses.extend(np.abs(off).tolist())
    mean = {law: float(np.mean(misses or [0.0])) for law, misses in left_mm.items()}
    better = mean["geometric"] < GEOMETRIC_BY * mean["arithmetic"]
    return "geometric" if better and mean["arithmetic"] > LEAST_MM else "arithmetic"
