"""What says how a last stands: its tread, its bottom, its seat, and what people say of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class StanceLabels:
    """What people say of how a last stands, in mm; None where nothing is said.

    ``heel_height_mm`` is the seat over the ground at the rearmost point, ``platform_mm`` the height
    of the forepart over the same ground, ``toe_spring_mm`` the bottom's height at the tip over the
    forepart's ground. What counts is the heel less the platform.
    """

    heel_height_mm: float | None = None
    toe_spring_mm: float | None = None
    platform_mm: float = 0.0

    @property
    def drop_mm(self) -> float | None:
        """The heel less the platform: how high the last itself stands.

        Examples
        --------
        >>> StanceLabels(60.0, platform_mm=15.0).drop_mm
        45.0
        """
        return None if self.heel_height_mm is None else self.heel_height_mm - self.platform_mm


NO_LABELS = StanceLabels()


@dataclass(frozen=True, slots=True)
class Cue:
    """A ground by one cue and its standard deviation, both in radians.

    ``name`` is "tread" (the slope of the bottom near its tread), "bottom" (a model of
    shank, tread and toe spring), "seat" (the pitch that seats have under such heels), "shape" (all
    three) or "label"; of two labels "heel_label" and "spring_label" too.
    """

    name: str
    ground: float
    sd: float


def combined(name: str, cues: Iterable[Cue]) -> Cue:
    """The mean of some cues, each by its inverse variance.

    Examples
    --------
    >>> combined("shape", [Cue("tread", 0.1, 0.01), Cue("bottom", 0.2, 0.01)]).ground.round(3)
    np.float64(0.15)
    """
    grounds, weights = np.array([(cue.ground, cue.sd**-2) for cue in cues]).T
    return Cue(name, grounds @ weights / weights.sum(), float(weights.sum() ** -0.5))


def doubted(name: str, cues: Iterable[Cue]) -> Cue:
    """The mean of some cues, less sure if they contradict each other.

    The standard deviation grows by half of Birge's ratio, sqrt(chi^2 / (n - 1)), if that is more
    than 1: cues within some two standard deviations of each other are usual.

    Examples
    --------
    >>> round(doubted("shape", [Cue("tread", 0.1, 0.01), Cue("seat", 0.12, 0.01)]).sd, 4)
    0.0071
    >>> round(doubted("shape", [Cue("tread", 0.1, 0.01), Cue("seat", 0.2, 0.01)]).sd, 4)
    0.025
    """
    cues = tuple(cues)
    mean = combined(name, cues)
    chi_squared = sum(((cue.ground - mean.ground) / cue.sd) ** 2 for cue in cues)
    ratio = float(np.sqrt(chi_squared / max(len(cues) - 1, 1)))
    return Cue(name, mean.ground, mean.sd * max(1.0, 0.5 * ratio))


def agreed(name: str, cues: Iterable[Cue]) -> Cue:
    """The mean of some cues, with a standard deviation that covers how far they are apart.

    Examples
    --------
    >>> mean = agreed("label", [Cue("heel_label", 0.1, 0.01), Cue("spring_label", 0.3, 0.01)])
    >>> round(mean.ground, 3), round(mean.sd, 3)
    (np.float64(0.2), 0.1)
    """
    cues = tuple(cues)
    mean = combined(name, cues)
    weights = np.array([cue.sd**-2 for cue in cues])
    apart = np.array([cue.ground - mean.ground for cue in cues])
    spread = float(np.sqrt(weights @ apart**2 / weights.sum()))
    return Cue(name, mean.ground, max(mean.sd, spread))
