"""A change of a short stretch of a last: finer than the splines along the arc can be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.deform.chart import eased
from footfit.geometry.numeric.arrays import Floats

HumpCurve = Literal["wider", "higher", "aside"]


@dataclass(frozen=True, slots=True)
class Hump:
    """What is added to a curve of a field between two places of the arc; 0 outside of them.

    Attributes
    ----------
    curve : str
        ``wider`` and ``higher`` are the curves of a field; ``aside`` moves sections to the medial
        side.
    size : float
        What is added at the peak: the logarithm of a scale, or mm.
    back, peak, front : float
        Where it begins, is largest, and ends. It and its first two derivatives are 0 at both ends.
    """

    curve: HumpCurve
    size: float
    back: float
    peak: float
    front: float

    def at(self, share: Floats) -> Floats:
        """What is added at shares of the arc (n,), (n,)."""
        rising = eased((share - self.back) / (self.peak - self.back))
        falling = eased((self.front - share) / (self.front - self.peak))
        return np.asarray(self.size * rising * falling)
