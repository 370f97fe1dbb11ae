"""Which sides two lasts have that are compared: a doubtful side is decided by the other last."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from footfit.errors import SideUndecided
from footfit.geometry.fit.laid_bottoms import laid_bottom
from footfit.results import Notice, Profiled

CLEARLY = 0.5
"""The other side is taken if the bottoms then lie so many times as far apart, or less."""


class Pair(NamedTuple):
    """Two lasts, and what was decided of their sides."""

    first: Profiled
    second: Profiled
    notices: tuple[Notice, ...]


def closest_sides(firsts: Sequence[Profiled], seconds: Sequence[Profiled]) -> Pair:
    """The sides with which the bottoms of two lasts lie closest.

    Parameters
    ----------
    firsts, seconds : sequence of Profiled
        Each last by its detected or given side, and then by the other one if that is not sure; by
        both given sides if none was detected.

    Raises
    ------
    SideUndecided
        Neither of the two shows its side.
    """
    if not _is_decided(firsts) and not _is_decided(seconds):
        words = "neither last shows which side it is: give --side left or --side right for both"
        raise SideUndecided(words)
    if len(firsts) > 1 and len(seconds) > 1:  # both are doubtful: the better known one stays
        firsts, seconds = (firsts[:1], seconds) if _is_decided(firsts) else (firsts, seconds[:1])
    if len(firsts) == len(seconds) == 1:
        return Pair(firsts[0], seconds[0], ())
    pairs = list(product(firsts, seconds))
    apart = [
        laid_bottom(one.aligned.prepared.shape, other.aligned.prepared.shape).rms_mm
        for one, other in pairs
    ]
    decided = _is_decided(firsts) and _is_decided(seconds)
    best = int(apart[1] < (CLEARLY if decided else 1.0) * apart[0])
    doubtful = pairs[best][0] if len(firsts) > 1 else pairs[best][1]
    alignment = doubtful.aligned.alignment
    words = (
        f"the side is not sure, and is taken as {alignment.side.side}: the bottoms then lie"
        f" closer ({apart[best]:.2f} mm, and {apart[1 - best]:.2f} mm as the other side)"
    )
    notice = Notice("side_from_other_last", words, alignment.info.path)
    return Pair(*pairs[best], (notice,) if best or not decided else ())


def _is_decided(lasts: Sequence[Profiled]) -> bool:
    """Whether the first of the candidates has the side that the shape shows, or that was given."""
    return len(lasts) == 1 or lasts[0].aligned.alignment.side.source == "detected"
