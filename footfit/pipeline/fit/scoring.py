"""The arithmetic of a fit, on arrays: scores, verdicts, the fit distance, its spread, ties.

Rows are lasts, columns are zones (of one foot, or of both feet of a pair side by side). What a
clearance should be stands in the fit profile (``docs/fit.md``); nothing of it is here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.results import Verdict, ZoneRule

VERDICTS: tuple[Verdict, ...] = ("good", "acceptable", "poor", "reject")
GOOD, ACCEPTABLE, POOR, REJECT = range(4)
NOT_JUDGED = -1
SURE_SDS = 2.0
UNKNOWN_SCORE = 1.0
"""What a zone counts that one last lacks and others have: the edge of good."""


@dataclass(frozen=True, slots=True)
class Column:
    """One zone of one foot; ``counts`` False where another foot governs it or its weight is 0."""

    foot: int
    rule: ZoneRule
    counts: bool


@dataclass(frozen=True, slots=True)
class Judged:
    """n lasts judged in z columns.

    ``score`` (n, z) is 0 at the target and 1 at the edge of good, - tight, + loose; NaN where it
    is not measured. ``level`` (n, z) indexes VERDICTS, NOT_JUDGED where it is not measured.
    ``foot_sd`` and ``last_sd`` (n, z) are the score's, from the foot's and the last's measures.
    """

    score: Floats
    level: Ints
    foot_sd: Floats
    last_sd: Floats
    weight: Floats


def judged(
    clearance: Floats, foot_sd: Floats, last_sd: Floats, columns: Sequence[Column]
) -> Judged:
    """Score and judge clearances (n, z) with their spreads (n, z) by the columns' rules."""
    scale = np.array([scales(column.rule) for column in columns]).reshape(-1, 2)
    target = np.array([column.rule.target for column in columns])
    over = clearance >= target
    width = np.where(over, scale[:, 1], scale[:, 0])
    return Judged(
        score=(clearance - target) / width,
        level=levels(clearance, [c.rule for c in columns], np.hypot(foot_sd, last_sd)),
        foot_sd=np.where(np.isnan(clearance), 0.0, foot_sd / width),
        last_sd=np.where(np.isnan(clearance), 0.0, last_sd / width),
        weight=np.array([column.rule.weight if column.counts else 0.0 for column in columns]),
    )


def scales(rule: ZoneRule) -> tuple[float, float]:
    """From the target to the edge of good, downwards and upwards; one serves both if alone."""
    below, above = rule.target - rule.good[0], rule.good[1] - rule.target
    return below or above, above or below


def levels(clearance: Floats, rules: Sequence[ZoneRule], sd: Floats) -> Ints:
    """The verdict of each clearance as an index of VERDICTS; the ranges' ends are inside.

    A reject takes a last out of the answer, so it must be sure: past the limit by SURE_SDS
    standard deviations, else it is poor. The length is the gate and knows no doubt.

    Examples
    --------
    >>> rule = ZoneRule("length", 13, (10, 17), (8, 20), (8, 20), 1.0, True, 0.0)
    >>> room = np.array([[7.9], [8.0], [13.0], [17.1], [np.nan]])
    >>> levels(room, [rule], np.ones((5, 1))).ravel().tolist()
    [3, 1, 0, 1, -1]
    """
    doubt = np.array([0.0 if rule.zone == "length" else SURE_SDS for rule in rules]) * sd
    found = np.zeros(clearance.shape, dtype=np.int64)
    for name in ("good", "acceptable"):
        low, high = _ends(rules, name)
        found += (clearance < low) | (clearance > high)
    low, high = _ends(rules, "poor")
    found[(clearance < low) | (clearance > high)] = POOR
    found[(clearance < low - doubt) | (clearance > high + doubt)] = REJECT
    found[np.isnan(clearance)] = NOT_JUDGED
    return found


def _ends(rules: Sequence[ZoneRule], name: str) -> tuple[Floats, Floats]:
    """The ends of a range of every rule, (z,) each; endless where a rule has none."""
    ends = np.array([getattr(rule, name) or (-np.inf, np.inf) for rule in rules]).reshape(-1, 2)
    return ends[:, 0], ends[:, 1]


def worst_levels(found: Judged, columns: Sequence[Column]) -> Ints:
    """Each last's verdict (n,): the worst of the zones that count, and at best acceptable where a
    required zone is not judged: what is not known is not good.
    """
    counts = np.array([column.counts for column in columns], dtype=bool)
    required = np.array([c.counts and c.rule.required for c in columns], dtype=bool)
    worst = np.where(counts, found.level, GOOD).max(axis=1, initial=GOOD)
    unknown = (required & (found.level == NOT_JUDGED)).any(axis=1)
    verdict: Ints = np.where(unknown, np.maximum(worst, ACCEPTABLE), worst)
    return verdict


def fit_distance(found: Judged) -> Floats:
    """The distance (n,): the weighted root mean square of the scores; 1 is the edge of good.

    A zone that one last lacks counts as UNKNOWN_SCORE; one that every last lacks counts nothing.
    """
    weight = _carried(found)
    distance: Floats = np.sqrt(np.square(_known_scores(found)) @ weight / weight.sum())
    return distance


def _carried(found: Judged) -> Floats:
    """The weights (z,) of the zones that any last is judged in."""
    carried: Floats = np.where(np.isfinite(found.score).any(axis=0), found.weight, 0.0)
    return carried


def _known_scores(found: Judged) -> Floats:
    return np.nan_to_num(found.score, nan=UNKNOWN_SCORE)


@dataclass(frozen=True, slots=True)
class Spread:
    """How sure n distances are.

    ``slope`` (n, z) is the distance's derivative by each score, ``foot_sd`` (n, z) the scores'
    spread from the foot's measures, which is common to all lasts; ``own`` (n,) is the distance's
    variance from the last's own measures, ``common`` (n,) what the foot's leave at the target,
    where the slopes vanish.
    """

    slope: Floats
    foot_sd: Floats
    own: Floats
    common: Floats

    def alone(self) -> Floats:
        """The standard deviation (n,) of each distance."""
        foot = np.square(self.slope * self.foot_sd).sum(axis=1)
        sd: Floats = np.sqrt(foot + self.common + self.own)
        return sd

    def difference(self, i: int, j: int) -> float:
        """The standard deviation of the difference of two distances: what the foot's measures
        are off by moves both, and counts only by how differently.
        """
        sd = 0.5 * (self.foot_sd[i] + self.foot_sd[j])
        foot = np.square((self.slope[i] - self.slope[j]) * sd).sum()
        return float(np.sqrt(foot + self.own[i] + self.own[j]))


def distance_spread(found: Judged) -> Spread:
    """The spread of the fit distance, propagated from the measures' standard deviations.

    With Q = D^2 = sum w u^2 / W and u of variance s^2: var Q = sum (w/W)^2 (4 u^2 s^2 + 2 s^4),
    and var D = var Q / 4 Q with the noise's own share, sum w s^2 / W, added to Q.
    """
    weight = _carried(found)
    share = weight / weight.sum()
    foot, last = np.square(found.foot_sd), np.square(found.last_sd)
    scores = _known_scores(found)
    base = np.maximum(np.square(scores) @ share + (foot + last) @ share, 1e-18)[:, None]
    slope = share * scores / np.sqrt(base)
    quarter = np.square(share) / (2.0 * base)
    own = np.square(slope) * last + quarter * last * (last + 2.0 * foot)
    return Spread(slope, found.foot_sd, own.sum(axis=1), (quarter * foot**2).sum(axis=1))


def tiers(
    order: Sequence[int], distance: Floats, group: Ints, spread: Spread, tie_sds: float
) -> list[int]:
    """The tier of each of ``order`` (best first within each group): a tier begins with its best
    and holds the lasts of its group that the measures do not tell from that one.
    """
    found: list[int] = []
    first = -1
    for i in order:
        if first >= 0 and group[i] == group[first]:
            apart = distance[i] - distance[first]
            if apart <= tie_sds * spread.difference(first, i):
                found.append(found[-1])
                continue
        first = i
        found.append(found[-1] + 1 if found else 0)
    return found


def fixed_tiers(distances: Sequence[float], tie: float) -> list[int]:
    """The tier of each of the distances, which rise: a tier is ``tie`` wide from its smallest.

    Examples
    --------
    >>> fixed_tiers([1.0, 2.0, 3.0, 9.0], tie=1.5)
    [0, 0, 1, 2]
    """
    found: list[int] = []
    start = float("-inf")
    for distance in distances:
        if distance > start + tie:
            start = distance
            found.append(found[-1] + 1 if found else 0)
        else:
            found.append(found[-1])
    return found
