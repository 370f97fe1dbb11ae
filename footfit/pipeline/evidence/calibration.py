"""What a fit profile learns from ratings: a new target and new ranges for each zone, or why not.

A zone changes only if enough wearers rated it, some found it tight and some loose, the model
foresees ratings that it has not seen better than the profile does, and ratings rise with the
clearance as the model says they do.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.evidence.ratings_model import (
    RATINGS,
    Posterior,
    Prior,
    Ratings,
    good_band,
    log_losses,
    rating_probabilities,
    zone_posteriors,
)
from footfit.results import RatedClearances, ZoneEvidence, ZoneRule


@dataclass(frozen=True, slots=True)
class Caution:
    """When ratings may change a profile (docs/decisions/0280-what-ratings-teach.md).

    ``shown_from`` and ``applied_from`` count wearers. ``most_prior_sds`` is how far a target may
    move. ``bend`` is by how many categories ``bend_ratings`` ratings may leave the model, over
    ``bend_sds`` standard errors. ``folds`` are the parts that are held out in turn.
    """

    shown_from: int = 10
    applied_from: int = 20
    most_prior_sds: float = 2.0
    bend: float = 0.5
    bend_sds: float = 2.0
    bend_ratings: int = 10
    folds: int = 5


CAUTION = Caution()

SPREAD_MM = {"length": 4.0, "girth": 5.0, "other": 3.0}
"""The spread of ratings beforehand: of the toe room, of girths, of widths and heights."""
CURVE_PLACES = 81


def prior_of(rule: ZoneRule) -> Prior:
    """What a profile's rule holds of its zone: its sd is a quarter of the acceptable range, and at
    most half of the good one, because acceptable is wider where feet differ more.
    """
    (low, high), (least, most) = rule.acceptable, rule.good
    kind = "girth" if rule.zone.endswith("girth") else "other"
    kind = "length" if rule.zone == "length" else kind
    sd = min(0.25 * (high - low), 0.5 * (most - least))
    return Prior(rule.target, sd, SPREAD_MM[kind])


def zone_evidence(
    rules: Mapping[str, ZoneRule], zones: Mapping[str, Ratings], caution: Caution = CAUTION
) -> tuple[ZoneEvidence, ...]:
    """What ratings say of each zone that was rated, in the order of ``rules``."""
    known = {name: zones[name] for name in rules if name in zones and len(zones[name].rating)}
    priors = {name: prior_of(rules[name]) for name in known}
    shown = {name: r for name, r in known.items() if r.wearers >= caution.shown_from}
    held = zone_posteriors(shown, priors)
    losses = _held_out_losses(shown, priors, caution)
    return tuple(
        _zone(rules[name], ratings, held.get(name), losses.get(name), caution)
        for name, ratings in known.items()
    )


def _zone(
    rule: ZoneRule,
    ratings: Ratings,
    held: Posterior | None,
    losses: tuple[float, float] | None,
    caution: Caution,
) -> ZoneEvidence:
    """The evidence of one zone; ``held`` is None where too few wearers rated."""
    count, wearers = len(ratings.rating), ratings.wearers
    if held is None:
        noun = "wearer" if wearers == 1 else "wearers"
        reason = f"{wearers} {noun} rated it; footfit learns from {caution.shown_from} on"
        return ZoneEvidence(rule, rule, "too_few", reason, count, wearers)
    objection = _objection(ratings, held, losses, caution)
    return ZoneEvidence(
        before=rule,
        after=rule if objection else _learned(rule, ratings, held, caution),
        status="shown" if objection else "applied",
        reason=objection,
        ratings=count,
        wearers=wearers,
        target_mm=held.target()[0],
        target_interval_mm=held.target_interval(),
        spread_mm=held.spread(),
        spread_interval_mm=held.spread_interval(),
        losses=losses,
        shown=_shown(rule, ratings, held),
    )


def _shown(rule: ZoneRule, ratings: Ratings, held: Posterior) -> RatedClearances:
    """The ratings of a zone, with the curves before and after."""
    low, high = ratings.clearance_mm.min(), ratings.clearance_mm.max()
    places = np.linspace(min(low, rule.acceptable[0]), max(high, rule.acceptable[1]), CURVE_PLACES)
    prior, said = prior_of(rule), np.array(RATINGS, dtype=float)
    curves = [
        rating_probabilities(places, target, spread) @ said
        for target, spread in (
            (prior.target_mm, prior.spread_mm),
            (held.target()[0], held.spread()),
        )
    ]
    return RatedClearances(ratings.clearance_mm, ratings.rating, np.column_stack([places, *curves]))


def _objection(
    ratings: Ratings,
    held: Posterior,
    losses: tuple[float, float] | None,
    caution: Caution,
) -> str | None:
    """Why a zone must keep its rule, or None."""
    if ratings.wearers < caution.applied_from:
        return f"{ratings.wearers} wearers rated it; {caution.applied_from} are needed"
    if not (ratings.rating < 0).any():
        return "nobody rated it too tight, so the data cannot tell where tight begins"
    if not (ratings.rating > 0).any():
        return "nobody rated it too loose, so the data cannot tell where loose begins"
    if losses is None or losses[1] >= losses[0]:
        return "the profile foresees ratings that were held out at least as well"
    bend = largest_bend(ratings, held, caution)
    if bend > caution.bend:
        return f"ratings leave the model's curve by {bend:.1f} categories"
    return None


def _learned(rule: ZoneRule, ratings: Ratings, held: Posterior, caution: Caution) -> ZoneRule:
    """The rule with the target that was learned, its good range, and ranges moved along.

    The target moves by at most ``most_prior_sds``. The good range is never narrower than the
    scans' own spread. The other ranges keep their distance from the target, and hold the good one.
    """
    prior = prior_of(rule)
    most = caution.most_prior_sds * prior.target_sd_mm
    move = float(np.clip(held.target()[0] - rule.target, -most, most))
    target = _written(rule.target + move)
    scan_sd = float(np.sqrt(np.mean(ratings.variance_mm2)))
    good = _pair(good_band(target, held.spread(), scan_sd))
    acceptable = _around(rule.acceptable, move, good)
    poor = None if rule.poor is None else _around(rule.poor, move, acceptable)
    return replace(rule, target=target, good=good, acceptable=acceptable, poor=poor)


def _around(
    limits: tuple[float, float], move: float, inner: tuple[float, float]
) -> tuple[float, float]:
    """A range moved along, and widened where it does not hold the inner one."""
    low, high = limits
    return _pair((min(low + move, inner[0]), max(high + move, inner[1])))


def _pair(ends: tuple[float, float]) -> tuple[float, float]:
    return _written(ends[0]), _written(ends[1])


def _written(value: float) -> float:
    """A length as a profile writes it: to a tenth of a mm."""
    return round(value, 1) + 0.0


def largest_bend(ratings: Ratings, held: Posterior, caution: Caution = CAUTION) -> float:
    """By how many categories the ratings leave the model's curve.

    Ratings are taken in parts of equal number, in the order of their clearances; each part's mean
    is compared with the model's. What chance explains is taken off: ``bend_sds`` standard errors of
    the part's mean.
    """
    order = np.argsort(ratings.clearance_mm, kind="stable")
    chosen = ratings.of(order)
    said = np.array(RATINGS, dtype=float)
    p = rating_probabilities(
        chosen.clearance_mm, held.target()[0], held.spread(), chosen.variance_mm2
    )
    expected = p @ said
    variance = p @ np.square(said) - np.square(expected)
    parts = np.array_split(np.arange(len(order)), max(2, len(order) // caution.bend_ratings))
    off = [abs(chosen.rating[part].mean() - expected[part].mean()) for part in parts]
    error = [np.sqrt(variance[part].sum()) / len(part) for part in parts]
    return float(np.max(np.array(off) - caution.bend_sds * np.array(error)))


def _held_out_losses(
    zones: Mapping[str, Ratings], priors: Mapping[str, Prior], caution: Caution
) -> dict[str, tuple[float, float]]:
    """The mean log loss of each zone's ratings: by the prior, and by the other wearers' ratings.

    Wearers are held out whole, in ``folds`` parts in the order of their numbers.
    """
    after: dict[str, list[Floats]] = {name: [] for name in zones}
    before: dict[str, list[Floats]] = {name: [] for name in zones}
    for fold in range(caution.folds):
        kept = {n: r.of(r.wearer % caution.folds != fold) for n, r in zones.items()}
        held = zone_posteriors(kept, priors)
        for name, ratings in zones.items():
            test = ratings.of(ratings.wearer % caution.folds == fold)
            known, prior = held[name], priors[name]
            after[name].append(log_losses(test, known.target()[0], known.spread()))
            before[name].append(log_losses(test, prior.target_mm, prior.spread_mm))
    return {
        name: (
            float(np.concatenate(before[name]).mean()),
            float(np.concatenate(after[name]).mean()),
        )
        for name in zones
    }
