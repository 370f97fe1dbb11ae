"""The named places along a foot or last where it is cut."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Station:
    """A named place along the foot: a share of its length, or ``oblique``, through MT1 and MT5."""

    name: str
    share: float
    oblique: bool = False


STATIONS = (
    Station("heel", 1.0 / 6.0),
    Station("arch", 0.38),
    Station("instep", 0.50),
    Station("waist", 0.58),
    Station("ball", 0.68, oblique=True),
    Station("toes", 0.88),
)
