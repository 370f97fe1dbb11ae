"""Why a base is refused: one target that is out of reach alone, or a few that are so together.

A search that misses its targets spreads the miss over them, so the largest miss may be of a target
that is easy to meet. So each target is tried alone. Then those are left free without which the
others are missed all the same: what remains pulls against each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from footfit.errors import FootfitError
from footfit.number_words import plain
from footfit.pipeline.last_making.custom.custom_aims import LENGTH, CustomAim
from footfit.pipeline.last_making.custom.custom_field import CUSTOM, limit_words
from footfit.pipeline.last_making.custom.custom_tries import (
    FLATTER,
    SLIMMER,
    UNZONED,
    Attempt,
    Given,
    attempt_in,
    on_light_copy,
)

Row = int
"""Of a firm aim among the aims of a last."""


def reason(given: Given, aims: Sequence[CustomAim]) -> str | None:
    """Why no search meets the firm aims of a base, in words; None if one meets them.

    The tries are made on a light copy, and keep no zone good.
    """
    light, there = on_light_copy(given, aims)
    tries: dict[tuple[Row, ...], Attempt | None] = {}

    def attempt(*rows: Row) -> Attempt | None:
        if rows not in tries:
            tries[rows] = _attempt(light, there, rows)
        return tries[rows]

    def met(*rows: Row) -> bool:
        found = attempt(*rows)
        return found is not None and not found.worth[0]

    firm = [row for row, aim in enumerate(aims) if aim.firm]
    if met(*firm):
        return None
    order = _most_missed_first(aims, firm, attempt(*firm))
    turned = (
        f", with the flare turned by {plain(abs(given.turn_deg))} deg" if given.turn_deg else ""
    )
    for row in order:
        if not met(row):
            return _alone_words(aims[row], attempt(row)) + turned
    left = [row for row in firm if aims[row].measure != LENGTH]
    for row in reversed(order):  # what the others miss without it is not its fault
        others = [other for other in left if other != row]
        if row in left and len(left) > 2 and not met(*others):
            left = others
    return _together_words([aims[row] for row in left]) + turned


def _attempt(given: Given, aims: Sequence[CustomAim], rows: Sequence[Row]) -> Attempt | None:
    """The best try at some of the firm aims, and at the length, which the foot sets whatever the
    others are; the other ones are free. None if nothing is read.
    """
    some = [
        aim for row, aim in enumerate(aims) if row in rows or not aim.firm or aim.measure == LENGTH
    ]
    best = None
    for manner in (UNZONED, FLATTER, SLIMMER):
        if best is not None and manner is not UNZONED:
            slim = best.shape.scales[0] > CUSTOM.wider
            if not best.worth[0] or (manner is SLIMMER) != slim:
                continue
        try:
            tried = attempt_in(given, some, replace(manner, zones=False))
        except FootfitError:
            continue
        best = tried if best is None else min(best, tried, key=lambda each: each.worth)
    return best


def _most_missed_first(
    aims: Sequence[CustomAim], firm: Sequence[Row], attempt: Attempt | None
) -> list[Row]:
    """The firm aims, in the order of how much a try at all of them misses each."""
    if attempt is None:
        return list(firm)
    off_mm = {aim.measure: abs(off) for aim, off in zip(attempt.aims, attempt.off_mm, strict=True)}
    return sorted(firm, key=lambda row: -off_mm[aims[row].measure])


def _alone_words(aim: CustomAim, attempt: Attempt | None) -> str:
    """That a target is out of reach without any other one, and how near a try came."""
    words = f"the {aim.words} is out of reach of this base, which has {plain(aim.base)} mm"
    if attempt is None:
        return f"{words}: {plain(aim.target)} mm are needed"
    limit = limit_words(attempt.shape)
    if limit is not None:
        return f"{words}: for {plain(aim.target)} mm {limit}"
    row = next(row for row, other in enumerate(attempt.aims) if other.measure == aim.measure)
    off_mm = float(attempt.off_mm[row])
    if not np.isfinite(off_mm):
        return f"{words}: {plain(aim.target)} mm are needed, and then it cannot be measured"
    return f"{words}: the nearest is {plain(aim.target + off_mm)} mm, not {plain(aim.target)} mm"


def _together_words(aims: Sequence[CustomAim]) -> str:
    """That targets are out of reach together: what the base has, and what is needed."""
    names = _listed([aim.words for aim in aims])
    has = _listed([plain(aim.base) for aim in aims])
    needed = _listed([plain(aim.target) for aim in aims])
    alone = "each alone can be met" if len(aims) == 2 else "without one of them the others can be"
    words = f"the {names} are out of reach of this base together ({alone})"
    return f"{words}: it has {has} mm, not {needed} mm"


def _listed(words: Sequence[str]) -> str:
    """Words in a list.

    Examples
    --------
    >>> _listed(["240.5", "243.9"]), _listed(["1", "2", "3"])
    ('240.5 and 243.9', '1, 2 and 3')
    """
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1])))
