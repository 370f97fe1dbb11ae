"""The trueness that a measure should state, fitted to errors of lasts or feet.

A measure states one number for each heel, and footfit does not know of which family a last is. So
the numbers are those with which other lasts of all families are likeliest to be within the bar.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize
from scipy.special import ndtr

from footfit.geometry.measures.measure_table import HEELS_MM
from footfit.geometry.numeric.arrays import Floats, Ints

RATIO_SD = 0.13  # of the ratio of a cell of 40 lasts, in its logarithm
SOFT = 0.25  # how softly an error over its total counts as more than 2
UNLIKELY = 0.02  # no number serves every cell: one that is lost counts no more than this
MISSED_COST = 10.0  # of each true value that a cell misses beyond what it may, over its number
ALL_COST = 60.0  # the same, over all cells
STARTS = (0.3, 0.7, 1.1)  # over the errors' root mean square


@dataclass(frozen=True)
class Fitted:
    """What a measure's errors (n,) are fitted by.

    ``other_sd`` (n,) is the total without the part of the trueness, ``shares`` (n, heels) what the
    number of each heel counts for a last, ``cells`` which errors are of one family and band.
    ``ratios`` are the least and the greatest mean total over the root mean square error, ``missed``
    the share of true values that may lie outside of two totals.
    """

    error: Floats
    other_sd: Floats
    shares: Floats
    cells: Sequence[Ints]
    ratios: tuple[float, float]
    missed: float

    def total(self, sds: Floats) -> Floats:
        """The total standard deviations (n,) with a trueness (heels,)."""
        return np.asarray(np.hypot(self.other_sd, self.shares @ np.abs(sds)))

    def cost(self, sds: Floats) -> float:
        """How unlikely other lasts are within the bar with a trueness (heels,)."""
        total = self.total(sds)
        missed = ndtr((np.abs(self.error) / total - 2.0) / SOFT)
        cost = ALL_COST * max(float(missed.mean()) - self.missed, 0.0)
        for cell in self.cells:
            rms = np.sqrt(np.square(self.error[cell]).mean())
            ratio = np.log(total[cell].mean() / rms)
            low, high = ndtr((np.log(self.ratios) - ratio) / RATIO_SD)
            cost -= float(np.log(high - low + UNLIKELY))
            cost += MISSED_COST * max(float(missed[cell].mean()) - self.missed, 0.0)
        return cost

    def sds(self) -> Floats:
        """The trueness (heels,) of the least cost."""
        rms = np.sqrt(np.square(self.error).mean())
        start = np.full(self.shares.shape[1], rms)
        tried = [minimize(self.cost, share * start, method="Nelder-Mead") for share in STARTS]
        return np.abs(min(tried, key=lambda each: float(each.fun)).x)


def heel_shares(heels_mm: Sequence[float | None], kind: str) -> Floats:
    """What the number of each of ``HEELS_MM`` counts at some heels, (n, heels); (n, 1) of feet."""
    if kind == "foot":
        return np.ones((len(heels_mm), 1))
    known = np.array([np.nan if heel is None else heel for heel in heels_mm])
    known = np.where(np.isnan(known), HEELS_MM[-1], known)
    return np.column_stack([np.interp(known, HEELS_MM, row) for row in np.eye(len(HEELS_MM))])
