"""How wearers rate a clearance, and which target their ratings speak for.

A wearer rates a place of a worn shoe from -2 (much too tight) over 0 (right) to +2 (much too
loose). The model is a cumulative probit: with the clearance d, the target a, the wearer's own wish
b and the spread s, all in mm, the wearer feels z = (d - a - b) / s with a standard error of one,
and the rating changes where z passes -2, -1, 1 and 2. An error of the scan adds to that of the
wearer. Some answers are slips: they say nothing.

The posterior of target and spread is computed on a grid, twice: over the whole prior, then where
the mass lies. So it needs no start value, and knows no local optimum. Sources: McCullagh 1980,
doi 10.1111/j.2517-6161.1980.tb01109.x; Burkner and Vuorre 2019, doi 10.1177/2515245918823199.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints

RATINGS = (-2, -1, 0, 1, 2)
"""Much too tight, too tight, right, too loose, much too loose."""


@dataclass(frozen=True, slots=True)
class RatingsModel:
    """What is assumed of every wearer and every place (docs/decisions/0280-what-ratings-teach.md).

    ``cuts`` are where z changes the rating. ``wearer_sd_mm`` is how far wearers' wishes differ.
    ``log_spread_sd`` is how well the spread is known beforehand. ``slips`` is the share of answers
    that say nothing, ``random_wearers`` that of wearers who always answer at random; ``rounds`` is
    how often it is weighed who they are. ``good_z`` is the z at which half of the answers are
    "right". ``nodes`` and ``grid`` are where integrals are summed.
    """

    cuts: tuple[float, float, float, float] = (-2.0, -1.0, 1.0, 2.0)
    wearer_sd_mm: float = 3.0
    log_spread_sd: float = 0.3
    slips: float = 0.03
    random_wearers: float = 0.1
    rounds: int = 2
    good_z: float = 0.9
    nodes: int = 9
    grid: tuple[int, int] = (41, 15)


MODEL = RatingsModel()


@dataclass(frozen=True, slots=True)
class Prior:
    """What is held of a zone before anybody rated it: target and spread, in mm."""

    target_mm: float
    target_sd_mm: float
    spread_mm: float


@dataclass(frozen=True, slots=True)
class Ratings:
    """Ratings (n,) of one zone: the clearance and its variance, what was said, and by whom.

    ``wearer`` holds a number for each wearer; it counts for nothing but equality. ``random`` is the
    probability that the wearer answers at random, as far as other zones say.
    """

    clearance_mm: Floats
    variance_mm2: Floats
    rating: Ints
    wearer: Ints
    random: Floats

    def of(self, chosen: Bools | Ints) -> Ratings:
        """Some of the ratings, by place or by a mask."""
        return Ratings(**{f.name: getattr(self, f.name)[chosen] for f in fields(self)})

    @property
    def wearers(self) -> int:
        """How many wearers rated."""
        return len(np.unique(self.wearer))


@dataclass(frozen=True, slots=True)
class Posterior:
    """What is held of target and spread after the ratings: weights over a grid that sum to one.

    ``target_mm`` (t,), ``spread_mm`` (s,) are the grid's lines; ``weight`` is (t, s).
    """

    target_mm: Floats
    spread_mm: Floats
    weight: Floats

    def target(self) -> tuple[float, float]:
        """The target's mean and standard deviation, in mm."""
        return _moments(self.target_mm, self.weight.sum(axis=1))

    def target_interval(self, share: float = 0.95) -> tuple[float, float]:
        """The interval, in mm, that holds the target with the probability ``share``."""
        return _interval(self.target_mm, self.weight.sum(axis=1), share)

    def spread(self) -> float:
        """The spread's geometric mean, in mm."""
        mean, _ = _moments(np.log(self.spread_mm), self.weight.sum(axis=0))
        return float(np.exp(mean))

    def spread_interval(self, share: float = 0.95) -> tuple[float, float]:
        """The interval, in mm, that holds the spread with the probability ``share``."""
        low, high = _interval(np.log(self.spread_mm), self.weight.sum(axis=0), share)
        return float(np.exp(low)), float(np.exp(high))


def rating_probabilities(
    clearance_mm: Floats,
    target_mm: float,
    spread_mm: float,
    variance_mm2: float | Floats = 0.0,
    model: RatingsModel = MODEL,
) -> Floats:
    """The probability (n, 5) of each rating, for a wearer who is not known.

    Examples
    --------
    >>> p = rating_probabilities(np.array([0.0, 12.0]), 0.0, 5.0)
    >>> p.argmax(axis=1).tolist()
    [2, 4]
    """
    from scipy.special import ndtr

    variance = np.broadcast_to(np.square(model.wearer_sd_mm) + variance_mm2, clearance_mm.shape)
    sd = np.sqrt(spread_mm**2 + variance)[:, None]
    off = (clearance_mm - target_mm)[:, None]
    below = ndtr((spread_mm * np.array(model.cuts) - off) / sd)
    ends = np.zeros((len(off), 1)), np.ones((len(off), 1))
    return _with_slips(np.diff(np.hstack([ends[0], below, ends[1]])), model.slips)


def posterior(ratings: Ratings, prior: Prior, model: RatingsModel = MODEL) -> Posterior:
    """What the ratings say of target and spread, with the prior."""
    lines = [
        prior.target_mm + prior.target_sd_mm * np.linspace(-4.5, 4.5, model.grid[0]),
        np.log(prior.spread_mm) + model.log_spread_sd * np.linspace(-4.0, 4.0, model.grid[1]),
    ]
    for last_pass in (False, True):
        target, log_spread = lines
        a = (target - prior.target_mm) / prior.target_sd_mm
        s = (log_spread - np.log(prior.spread_mm)) / model.log_spread_sd
        log_prior = -0.5 * (np.square(a)[:, None] + np.square(s))
        density = log_prior + _log_likelihood(ratings, target, np.exp(log_spread), model)
        weight = np.exp(density - density.max())
        weight /= weight.sum()
        if not last_pass:
            lines = [
                _narrowed(target, weight.sum(axis=1)),
                _narrowed(log_spread, weight.sum(axis=0)),
            ]
    return Posterior(target, np.exp(log_spread), weight)


def log_losses(
    ratings: Ratings, target_mm: float, spread_mm: float, model: RatingsModel = MODEL
) -> Floats:
    """How badly each rating (n,) was foreseen: minus the logarithm of its probability."""
    probability = rating_probabilities(
        ratings.clearance_mm, target_mm, spread_mm, ratings.variance_mm2, model
    )
    said: Floats = -np.log(probability[np.arange(len(probability)), ratings.rating + 2])
    return said


def good_band(target_mm: float, spread_mm: float, least_mm: float) -> tuple[float, float]:
    """The clearances, in mm, that at least half of the answers call right."""
    half = max(MODEL.good_z * spread_mm, least_mm)
    return target_mm - half, target_mm + half


def _log_likelihood(
    ratings: Ratings, target_mm: Floats, spread_mm: Floats, model: RatingsModel
) -> Floats:
    """The logarithm of the ratings' probability for each target and spread: (t, s).

    Either all answers of a wearer say something, or none does.
    """
    _, first, count = np.unique(ratings.wearer, return_index=True, return_counts=True)
    random = ratings.random[first]
    blind = random * float(len(RATINGS)) ** -count
    said = _sincere(ratings, target_mm, spread_mm, model)
    total: Floats = np.log((1.0 - random)[:, None, None] * said + blind[:, None, None]).sum(axis=0)
    return total


def _sincere(ratings: Ratings, target_mm: Floats, spread_mm: Floats, model: RatingsModel) -> Floats:
    """The probability of all answers of each wearer, in the order of their numbers: (w, t, s).

    A wearer who rated once needs no wish of his own: it only widens the answer. The wishes of the
    others are integrated out by Gauss-Hermite nodes.
    """
    _, number, count = np.unique(ratings.wearer, return_inverse=True, return_counts=True)
    single = count[number] == 1
    once, often = ratings.of(single), ratings.of(~single)
    result = np.empty((len(count), len(target_mm), len(spread_mm)))
    said = _answers(once, target_mm, spread_mm, np.zeros(1), model.wearer_sd_mm**2, model)
    result[number[single]] = said[..., 0]
    if len(often.rating):
        nodes, shares = np.polynomial.hermite_e.hermegauss(model.nodes)
        said = np.log(_answers(often, target_mm, spread_mm, model.wearer_sd_mm * nodes, 0.0, model))
        _, first, group = np.unique(often.wearer, return_index=True, return_inverse=True)
        joint = np.zeros((len(first), *said.shape[1:]))
        np.add.at(joint, group, said)
        result[number[~single][first]] = np.exp(joint) @ (shares / shares.sum())
    return result


def _answers(
    ratings: Ratings,
    target_mm: Floats,
    spread_mm: Floats,
    wish_mm: Floats,
    more_mm2: float,
    model: RatingsModel,
) -> Floats:
    """The probability of each answer for each target, spread and wish: (n, t, s, w)."""
    from scipy.special import ndtr

    cuts = np.array([-np.inf, *model.cuts, np.inf])
    spread = spread_mm[None, None, :, None]
    place = ratings.clearance_mm[:, None] - target_mm
    off = place[:, :, None, None] - wish_mm
    sd = np.sqrt(spread**2 + (ratings.variance_mm2 + more_mm2)[:, None, None, None])
    upper, lower = (
        ndtr((spread * cuts[ratings.rating + step][:, None, None, None] - off) / sd)
        for step in (3, 2)
    )
    return _with_slips(upper - lower, model.slips)


def _with_slips(probability: Floats, slips: float) -> Floats:
    mixed: Floats = (1.0 - slips) * probability + slips / len(RATINGS)
    return mixed


def _narrowed(line: Floats, weight: Floats) -> Floats:
    """A line of as many places where the weight lies."""
    mean, sd = _moments(line, weight)
    step = float(line[1] - line[0])
    reach = 5.5 * max(sd, 0.3 * step)
    narrowed: Floats = np.linspace(mean - reach, mean + reach, len(line))
    return narrowed


def _moments(line: Floats, weight: Floats) -> tuple[float, float]:
    mean = float(line @ weight)
    return mean, float(np.sqrt(np.square(line - mean) @ weight))


def _interval(line: Floats, weight: Floats, share: float) -> tuple[float, float]:
    """The central interval of a density that is given on a regular line."""
    step = line[1] - line[0]
    edges = np.append(line - 0.5 * step, line[-1] + 0.5 * step)
    below = np.append(0.0, np.cumsum(weight))
    low, high = np.interp([0.5 - 0.5 * share, 0.5 + 0.5 * share], below, edges)
    return float(low), float(high)


def zone_posteriors(
    zones: Mapping[str, Ratings], priors: Mapping[str, Prior], model: RatingsModel = MODEL
) -> dict[str, Posterior]:
    """What is held of each zone, with less weight for wearers who seem to answer at random.

    Whoever answers at random does so in every zone. So a wearer's answers in one zone are judged by
    those in all *other* zones: the worse these were foreseen, the less the answers here say.
    """
    from scipy.special import expit, logit

    result = {name: posterior(ratings, priors[name], model) for name, ratings in zones.items()}
    for _ in range(model.rounds):
        gains = {name: _gains(zones[name], result[name], model) for name in zones}
        whole: dict[int, float] = {}
        for gain in gains.values():
            for wearer, more in gain.items():
                whole[wearer] = whole.get(wearer, 0.0) + more
        for name, ratings in zones.items():
            others = np.array([whole[w] - gains[name][w] for w in ratings.wearer.tolist()])
            random: Floats = expit(logit(model.random_wearers) - others)
            result[name] = posterior(replace(ratings, random=random), priors[name], model)
    return result


def _gains(ratings: Ratings, held: Posterior, model: RatingsModel) -> dict[int, float]:
    """By how much each wearer's answers were foreseen better than by chance, as a log ratio."""
    wearers, count = np.unique(ratings.wearer, return_counts=True)
    place = np.array([held.target()[0]]), np.array([held.spread()])
    said = _sincere(ratings, *place, model)[:, 0, 0]
    gain = np.log(said) + count * np.log(len(RATINGS))
    return dict(zip(wearers.tolist(), gain.tolist(), strict=True))
