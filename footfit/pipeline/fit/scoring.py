"""The arithmetic of a fit, on arrays: scores, verdicts, the fit distance, its spread, ties.

Rows are lasts; columns are zones, of one foot or of both feet of a pair side by side. What a
clearance should be stands in the fit profile (``docs/fit.md``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.number_words import KEPT, rounded
from footfit.results import ZoneRule

GOOD, ACCEPTABLE, POOR, REJECT = range(4)
NOT_JUDGED = -1
SURE_SDS = 2.0
JUDGED = 2
"""The decimals of a clearance that is judged, in mm, degrees and percent."""
TIER_LOOK = 16
"""So many lasts are compared with the best of a tier at first."""
UNKNOWN_SCORE = 1.0
"""The score of a zone that one last lacks and others have: the edge of good."""


@dataclass(frozen=True, slots=True)
class Column:
    """One zone of one foot; ``counts`` is False if the other foot governs it or its weight is 0."""

    foot: int
    rule: ZoneRule
    counts: bool


@dataclass(frozen=True, slots=True)
class Scores:
    """The scores of n lasts in z columns.

    ``score`` (n, z) is 0 at the target and 1 at the edge of good, - tight, + loose; NaN where it
    is not measured. ``level`` (n, z) indexes VERDICTS, NOT_JUDGED where it is not measured.
    ``foot_sd`` and ``last_sd`` (n, z) are the score's, from the foot's and the last's measures,
    ``heel_sd`` (n, z) from the heel model. ``weight`` (z,) is 0 for a zone that does not count, or
    that no last is judged in.
    """

    score: Floats
    level: Ints
    foot_sd: Floats
    last_sd: Floats
    heel_sd: Floats
    weight: Floats

    def taken(self, rows: Ints) -> Scores:
        """Those of some lasts."""
        names = ("score", "level", "foot_sd", "last_sd", "heel_sd")
        return replace(self, **{name: getattr(self, name)[rows] for name in names})


@dataclass(frozen=True, slots=True)
class Asked:
    """What rules ask, as arrays that go with clearances (..., z).

    They are (z,) for the lasts of one customer, and (f, 1, z) if f feet are asked different things.
    ``below`` and ``above`` are the scales of a score. A range has a low and a high end; it is
    endless where a rule has none. A reject must be past its limit by ``doubt`` standard deviations.
    """

    target: Floats
    below: Floats
    above: Floats
    good: tuple[Floats, Floats]
    acceptable: tuple[Floats, Floats]
    poor: tuple[Floats, Floats]
    doubt: Floats
    weight: Floats
    counts: Bools
    required: Bools


def asked(columns: Sequence[Column]) -> Asked:
    """What the rules of columns ask, (z,) each."""
    rules = [column.rule for column in columns]
    below, above = np.array([scales(rule) for rule in rules]).reshape(-1, 2).T
    counts = np.array([column.counts for column in columns], dtype=bool)
    return Asked(
        target=np.array([rule.target for rule in rules]),
        below=below,
        above=above,
        good=_ends(rules, "good"),
        acceptable=_ends(rules, "acceptable"),
        poor=_ends(rules, "poor"),
        doubt=np.array([0.0 if rule.zone == "length" else SURE_SDS for rule in rules]),
        weight=np.array([column.rule.weight if column.counts else 0.0 for column in columns]),
        counts=counts,
        required=counts & np.array([rule.required for rule in rules], dtype=bool),
    )


def scores(
    clearance: Floats,
    foot_sd: Floats,
    last_sd: Floats,
    columns: Sequence[Column],
    heel_sd: Floats | None = None,
    known: Bools | None = None,
) -> Scores:
    """The scores of clearances (n, z) with their spreads (n, z), by the columns' rules.

    ``known`` (z,) says in which zones any last is judged, if there are others than these.
    """
    rules = asked(columns)
    width = score_scale(clearance, rules)
    model_sd = np.zeros_like(clearance) if heel_sd is None else heel_sd
    spreads = np.stack([foot_sd, last_sd, model_sd])
    foot, last, heel = np.where(np.isnan(clearance), 0.0, spreads / width)
    score = (clearance - rules.target) / width
    carried = _carried(score, rules.weight)
    return Scores(
        score=score,
        level=clearance_levels(clearance, rules, np.sqrt(np.square(spreads).sum(axis=0))),
        foot_sd=foot,
        last_sd=last,
        heel_sd=heel,
        weight=carried if known is None else np.where(known, rules.weight, 0.0),
    )


def score_scale(clearance: Floats, rules: Asked) -> Floats:
    """From the target to the edge of good, on the side of each clearance (..., z)."""
    width: Floats = np.where(clearance >= rules.target, rules.above, rules.below)
    return width


def room_levels(
    clearance: Floats, foot_sd: Floats, last_sd: Floats, heel_sd: Floats, columns: Sequence[Column]
) -> Ints:
    """The verdicts of clearances (n, z) with their spreads (n, z)."""
    variance = np.square(foot_sd) + np.square(last_sd) + np.square(heel_sd)
    return clearance_levels(clearance, asked(columns), np.sqrt(variance))


def scales(rule: ZoneRule) -> tuple[float, float]:
    """From the target to the edge of good, downwards and upwards; if one is 0, the other serves."""
    below, above = rule.target - rule.good[0], rule.good[1] - rule.target
    return below or above, above or below


def levels(clearance: Floats, rules: Sequence[ZoneRule], sd: Floats) -> Ints:
    """The verdict of each clearance as an index of VERDICTS; the ranges' ends are inside.

    A reject takes a last out of the answer, so it must be sure: past the limit by SURE_SDS
    standard deviations, else it is poor. The length is the gate, and its limits are strict. What is
    judged is `judged_numbers`, so numbers that are shown as equal have equal verdicts.

    Examples
    --------
    >>> rule = ZoneRule("length", 13, (10, 17), (8, 20), (8, 20), 1.0, True, 0.0)
    >>> room = np.array([[7.9], [8.0], [13.0], [17.1], [np.nan]])
    >>> levels(room, [rule], np.ones((5, 1))).ravel().tolist()
    [3, 1, 0, 1, -1]
    """
    return clearance_levels(clearance, asked([Column(0, rule, True) for rule in rules]), sd)


def judged_numbers(clearance: Floats) -> Floats:
    """Clearances to two decimals, half up, of the numbers that documents give: 0.01 mm is far less
    than a second scan moves a measure, and a longer number tells a reader nothing.

    Examples
    --------
    >>> judged_numbers(np.array([20.003, 20.005, -0.125, np.nan])).tolist()
    [20.0, 20.01, -0.13, nan]
    """
    whole = np.round(np.abs(clearance) * 10.0**KEPT)
    steps = np.floor(whole * 10.0**JUDGED / 10.0**KEPT + 0.5)
    return np.asarray(np.copysign(steps / 10.0**JUDGED, clearance))


def clearance_levels(clearance: Floats, rules: Asked, sd: Floats) -> Ints:
    """The verdict of each clearance (..., z); see `levels`."""
    clearance = judged_numbers(clearance)
    doubt = rules.doubt * sd
    level = np.zeros(clearance.shape, dtype=np.int64)
    for low, high in (rules.good, rules.acceptable):
        level += (clearance < low) | (clearance > high)
    low, high = rules.poor
    level[(clearance < low) | (clearance > high)] = POOR
    level[(clearance < low - doubt) | (clearance > high + doubt)] = REJECT
    level[np.isnan(clearance)] = NOT_JUDGED
    return level


def _ends(rules: Sequence[ZoneRule], name: str) -> tuple[Floats, Floats]:
    """The ends of a range of every rule, (z,) each; endless where a rule has none."""
    ends = np.array([getattr(rule, name) or (-np.inf, np.inf) for rule in rules]).reshape(-1, 2)
    return ends[:, 0], ends[:, 1]


def shown_digits(value: float, rule: ZoneRule, unit: str) -> int:
    """How many decimals a clearance is shown with: a number must not look better than it is.

    It has more decimals if the shorter number lies on the other side of the end of a range.

    Examples
    --------
    >>> rule = ZoneRule("length", 13, (10, 17), (8, 20), (8, 20), 1.0, True, 0.0)
    >>> [shown_digits(room, rule, "mm") for room in (9.94, 9.96, 10.04, 17.0004)]
    [1, 2, 1, 1]
    """
    ranges = [ends for ends in (rule.good, rule.acceptable, rule.poor) if ends is not None]
    exact = float(judged_numbers(np.array(value)))
    for digits in range(2 if unit == "ratio" else 1, JUDGED):
        shown = float(rounded(value, digits))
        if all((exact < low) == (shown < low) for low, _ in ranges) and all(
            (exact > high) == (shown > high) for _, high in ranges
        ):
            return digits
    return JUDGED


def worst_levels(level: Ints, columns: Sequence[Column]) -> Ints:
    """The verdict of each last (n,) from its levels (n, z): the worst of the zones that count.

    It is at best acceptable if a required zone is not judged: what is not known is not good.
    """
    return worst_level(level, asked(columns))


def worst_level(level: Ints, rules: Asked) -> Ints:
    """The verdict of each last (...,) from its levels (..., z); see `worst_levels`."""
    worst = np.where(rules.counts, level, GOOD).max(axis=-1, initial=GOOD)
    unknown = (rules.required & (level == NOT_JUDGED)).any(axis=-1)
    verdict: Ints = np.where(unknown, np.maximum(worst, ACCEPTABLE), worst)
    return verdict


def fit_distance(scores: Scores) -> Floats:
    """The distance (n,): the weighted root mean square of the scores; 1 is the edge of good.

    A zone that one last lacks counts as UNKNOWN_SCORE; one that every last lacks counts nothing.
    """
    return _weighted(scores.score, scores.weight)


def score_distance(score: Floats, weight: Floats) -> Floats:
    """The distance (..., n) of scores (..., n, z) of n lasts with weights (z,); see `fit_distance`.

    Examples
    --------
    >>> score_distance(np.array([[1.0, np.nan], [0.0, np.nan]]), np.array([2.0, 1.0])).tolist()
    [1.0, 0.0]
    """
    return _weighted(score, _carried(score, weight))


def _weighted(score: Floats, weight: Floats) -> Floats:
    """The weighted root mean square (..., n) of scores (..., n, z). Each last's sum is taken by
    itself, so that it has the same bits among few lasts and among many.
    """
    square = np.square(np.nan_to_num(score, nan=UNKNOWN_SCORE)) * _shares(weight)[..., None, :]
    distance: Floats = np.sqrt(square.sum(axis=-1))
    return distance


def _shares(weight: Floats) -> Floats:
    """Weights (..., z) that add up to 1; none where no last is judged in any zone."""
    total = weight.sum(axis=-1, keepdims=True)
    shares: Floats = weight / np.where(total > 0.0, total, 1.0)
    return shares


def _carried(score: Floats, weight: Floats) -> Floats:
    """The weights (..., z) of the zones that any of n lasts (..., n, z) is judged in."""
    carried: Floats = np.where(np.isfinite(score).any(axis=-2), weight, 0.0)
    return carried


def _known_scores(scores: Scores) -> Floats:
    return np.nan_to_num(scores.score, nan=UNKNOWN_SCORE)


@dataclass(frozen=True, slots=True)
class Spread:
    """How sure n distances are.

    ``slope`` (n, z) is the distance's derivative by each score. ``foot_sd`` (n, z) is the scores'
    spread from the foot's measures, which is common to all lasts. ``heel_sd`` (n, z) is that from
    the heel model, common too, but larger for a last with a higher heel. ``own`` (n,) is the
    distance's variance from the last's own measures. ``common`` (n,) is what the foot's measures
    and the heel model leave at the target, where the slopes vanish.
    """

    slope: Floats
    foot_sd: Floats
    heel_sd: Floats
    own: Floats
    common: Floats

    def alone(self) -> Floats:
        """The standard deviation (n,) of each distance."""
        foot = np.square(self.slope * self.foot_sd).sum(axis=1)
        heel = np.square(self.slope * self.heel_sd).sum(axis=1)
        sd: Floats = np.sqrt(foot + heel + self.common + self.own)
        return sd

    def difference(self, i: int, others: Ints | int) -> Floats:
        """The standard deviation of the difference of one distance from others.

        An error of the foot's measures, or of the heel model, moves both, and counts only by how
        differently.
        """
        sd = 0.5 * (self.foot_sd[i] + self.foot_sd[others])
        foot = np.square((self.slope[i] - self.slope[others]) * sd).sum(axis=-1)
        moved = self.slope[i] * self.heel_sd[i] - self.slope[others] * self.heel_sd[others]
        own = self.own[i] + self.own[others]
        return np.asarray(np.sqrt(foot + np.square(moved).sum(axis=-1) + own))

    def taken(self, rows: Ints) -> Spread:
        """Those of some lasts."""
        return Spread(*(getattr(self, known.name)[rows] for known in fields(self)))


def rescan_spread(count: int) -> Spread:
    """The spread of distances in units of what two scans of one shape are apart."""
    nothing = np.zeros((count, 1))
    return Spread(nothing, nothing, nothing, np.ones(count), np.zeros(count))


def distance_spread(scores: Scores) -> Spread:
    """The spread of the fit distance, propagated from the measures' standard deviations.

    With Q = D^2 = sum w u^2 / W and u of variance s^2: var Q = sum (w/W)^2 (4 u^2 s^2 + 2 s^4),
    and var D = var Q / 4 Q with the noise's own share, sum w s^2 / W, added to Q.
    """
    share = _shares(scores.weight)
    foot = np.square(scores.foot_sd) + np.square(scores.heel_sd)
    last = np.square(scores.last_sd)
    score = _known_scores(scores)
    base = (np.square(score) * share).sum(axis=1) + ((foot + last) * share).sum(axis=1)
    base = np.maximum(base, 1e-18)[:, None]
    slope = share * score / np.sqrt(base)
    quarter = np.square(share) / (2.0 * base)
    own = np.square(slope) * last + quarter * last * (last + 2.0 * foot)
    common = (quarter * foot**2).sum(axis=1)
    return Spread(slope, scores.foot_sd, scores.heel_sd, own.sum(axis=1), common)


def tiers(
    order: Sequence[int] | Ints,
    distance: Floats,
    group: Ints,
    spread: Spread,
    tie_sds: float,
    top: int = 0,
) -> list[int]:
    """The tier of each row of ``order``, which is best first within each group.

    A tier begins with its best and holds the lasts of its group whose distance the measures do not
    tell from that one's. With ``top`` the list ends with the tier of that place.
    """
    rows, tier = np.asarray(order, dtype=np.int64), list[int]()
    while len(tier) < len(rows) and not (top and len(tier) >= top):
        start, end = len(tier), len(tier) + 1
        first, looked = rows[start], TIER_LOOK
        while end < len(rows):
            some = rows[end : end + looked]
            apart = distance[some] - distance[first]
            same = (group[some] == group[first]) & (
                apart <= tie_sds * spread.difference(first, some)
            )
            if not same.all():
                end += int(np.argmin(same))
                break
            end, looked = end + len(some), 2 * looked
        tier += [tier[-1] + 1 if tier else 0] * (end - start)
    return tier
