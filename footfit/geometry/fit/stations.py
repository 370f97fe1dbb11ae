"""The named places along a foot or last where it is cut, and what a cut there is."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.geometry.numeric.arrays import Floats


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


@dataclass(frozen=True, slots=True)
class NamedSection:
    """The section of a right shape by one plane.

    Attributes
    ----------
    plane : (4, 4)
        From the plane's own axes (across, up, out of it) to the canonical frame.
    points_mm : (n, 2)
        Its longest loop in the plane's axes, across to the medial side and up.
    """

    plane: Floats
    points_mm: Floats
