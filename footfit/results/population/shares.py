"""Shares of feet with their intervals, and how measures are distributed."""

from __future__ import annotations

import math
from dataclasses import dataclass

from footfit.results.values import Json, Part, fields

Z95 = 1.959963984540054
"""How many standard deviations hold 95 % of a normal distribution."""


@dataclass(frozen=True, slots=True)
class Share(Part):
    """So many of ``of`` feet, with the 95 % interval of Wilson for the population they are from.

    ``value``, ``low`` and ``high`` are from 0 to 1; None if there are no feet.

    Examples
    --------
    >>> share = Share(45, 50)
    >>> round(share.value, 3), round(share.low, 3), round(share.high, 3)
    (0.9, 0.786, 0.957)
    >>> Share(0, 0).value
    """

    count: int
    of: int

    @property
    def value(self) -> float | None:
        """The share of the feet that were looked at."""
        return self.count / self.of if self.of else None

    @property
    def low(self) -> float | None:
        """The lower end of the interval."""
        return None if self.value is None else max(0.0, self._middle - self._half)

    @property
    def high(self) -> float | None:
        """The upper end of the interval."""
        return None if self.value is None else min(1.0, self._middle + self._half)

    @property
    def _middle(self) -> float:
        assert self.value is not None
        return (self.value + Z95**2 / (2 * self.of)) / (1 + Z95**2 / self.of)

    @property
    def _half(self) -> float:
        assert self.value is not None
        n, p = self.of, self.value
        spread = math.sqrt(p * (1 - p) / n + Z95**2 / (4 * n**2))
        return Z95 * spread / (1 + Z95**2 / n)

    def _keys(self) -> Json:
        return fields(self) | {"share": self.value, "low": self.low, "high": self.high}


@dataclass(frozen=True, slots=True)
class Served(Part):
    """How many feet have a good last, and how many at least an acceptable one."""

    good: Share
    acceptable: Share


@dataclass(frozen=True, slots=True)
class ServedGroup(Part):
    """The feet of one group: one size, one width, one value of a column."""

    group: str
    served: Served

    def _keys(self) -> Json:
        return {"group": self.group, **self.served.to_dict()}


@dataclass(frozen=True, slots=True)
class ServedBy(Part):
    """The feet in groups by one thing: "size", "width", "flare", or the name of a column."""

    by: str
    groups: tuple[ServedGroup, ...]


@dataclass(frozen=True, slots=True)
class ServedZone(Part):
    """One criterion by itself, over the ``judged`` feet for which any last could be judged in it.

    ``alone`` counts feet that any last serves in this zone, whatever else; ``with_length`` those
    that any last serves in it and in length; ``best_last`` those whose best last does.
    """

    zone: str
    label: str
    counts: bool
    required: bool
    judged: int
    alone: Served
    with_length: Served
    best_last: Served


@dataclass(frozen=True, slots=True)
class Distribution(Part):
    """A measure, or the flare angle, of the feet that have it: ``unit`` is "mm" or "deg"."""

    measure: str
    unit: str
    feet: int
    mean: float
    sd: float | None
    percentiles: tuple[tuple[int, float], ...]

    def _keys(self) -> Json:
        keys = fields(self, "percentiles")
        known = {f"p{percent:02d}": value for percent, value in self.percentiles}
        rounded = {name: None if v is None else round(v, 3) for name, v in known.items()}
        sd = None if self.sd is None else round(self.sd, 3)
        return keys | {"mean": round(self.mean, 3), "sd": sd} | rounded
