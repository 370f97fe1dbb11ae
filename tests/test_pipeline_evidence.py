"""What ratings teach a profile: the posterior, its caution, and who answers at random."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.learning import PRIORS, TWO_PAIRS, Setting, coverage, moves, shop
from footfit.errors import BadOption
from footfit.pipeline.evidence.calibration import largest_bend, prior_of, zone_evidence
from footfit.pipeline.evidence.ratings_model import (
    MODEL,
    Prior,
    Ratings,
    good_band,
    posterior,
    rating_probabilities,
)
from footfit.pipeline.evidence.zone_ratings import log_ratings, place_ratings
from footfit.results import ZoneRule
from tests import fits

BALL = ZoneRule("ball_girth", 0.0, (-4.0, 5.0), (-8.0, 10.0), (-16.0, 16.0), 1.5, True, 0.0)
PRIOR = prior_of(BALL)


def ratings(seed: int, wearers: int, target_mm: float, times: int = 1) -> Ratings:
    """Ratings of the ball girth by wearers whose target is known."""
    rng = np.random.default_rng(seed)
    known = replace(PRIOR, target_mm=target_mm, target_sd_mm=1e-9)
    return shop(rng, known, wearers, Setting(times)).ratings


def spread_out(seed: int, wearers: int, target_mm: float) -> Ratings:
    """Ratings of clearances over the whole acceptable range, with the target known."""
    rng = np.random.default_rng(seed)
    clearance = rng.uniform(-9.0, 11.0, wearers)
    felt = (clearance - target_mm - rng.normal(0.0, 3.0, wearers)) / 5.0 + rng.normal(size=wearers)
    said = np.digitize(felt, MODEL.cuts) - 2
    ones = np.ones(wearers)
    return Ratings(clearance, ones, said, np.arange(wearers), 0.0 * ones)


def brute_force(said: Ratings, prior: Prior) -> tuple[float, float]:
    """The target's mean and sd by summing over a fine grid; each wearer rated once."""
    targets = np.linspace(prior.target_mm - 20.0, prior.target_mm + 20.0, 401)
    spreads = prior.spread_mm * np.exp(0.3 * np.linspace(-4.0, 4.0, 81))
    log_p = np.zeros((len(targets), len(spreads)))
    for i, target in enumerate(targets):
        for j, spread in enumerate(spreads):
            p = rating_probabilities(said.clearance_mm, target, spread, said.variance_mm2)
            log_p[i, j] = np.log(p[np.arange(len(p)), said.rating + 2]).sum()
            log_p[i, j] -= 0.5 * ((target - prior.target_mm) / prior.target_sd_mm) ** 2
            log_p[i, j] -= 0.5 * (np.log(spread / prior.spread_mm) / 0.3) ** 2
    weight = np.exp(log_p - log_p.max()).sum(axis=1)
    weight /= weight.sum()
    mean = float(targets @ weight)
    return mean, float(np.sqrt(np.square(targets - mean) @ weight))


def test_posterior_equals_a_sum_over_a_fine_grid() -> None:
    said = ratings(1, 25, 3.0)
    mean, sd = brute_force(said, PRIOR)
    held = posterior(said, PRIOR)
    assert held.target() == pytest.approx((mean, sd), abs=0.03)


def test_posterior_without_ratings_is_the_prior() -> None:
    held = posterior(ratings(1, 5, 0.0).of(np.zeros(0, dtype=int)), PRIOR)
    assert held.target() == pytest.approx((PRIOR.target_mm, PRIOR.target_sd_mm), abs=0.05)
    low, high = held.target_interval()
    assert (low, high) == pytest.approx(
        (-1.96 * PRIOR.target_sd_mm, 1.96 * PRIOR.target_sd_mm), rel=0.02
    )
    assert held.spread() == pytest.approx(5.0, rel=0.01)


@given(seed=st.integers(0, 10_000), shift_mm=st.floats(-30.0, 30.0))
def test_posterior_moves_with_the_clearances(seed: int, shift_mm: float) -> None:
    said = ratings(seed, 12, 2.0)
    moved = replace(said, clearance_mm=said.clearance_mm + shift_mm)
    here = posterior(said, PRIOR)
    there = posterior(moved, replace(PRIOR, target_mm=PRIOR.target_mm + shift_mm))
    assert there.target()[0] - here.target()[0] == pytest.approx(shift_mm, abs=1e-6)
    assert there.target()[1] == pytest.approx(here.target()[1], abs=1e-6)


@given(seed=st.integers(0, 10_000))
def test_posterior_turns_around_with_tight_and_loose(seed: int) -> None:
    said = ratings(seed, 12, 2.0, times=2)
    turned = replace(said, clearance_mm=-said.clearance_mm, rating=-said.rating)
    here, there = posterior(said, PRIOR), posterior(turned, PRIOR)
    assert there.target()[0] == pytest.approx(-here.target()[0], abs=1e-6)


def test_posterior_takes_wearers_in_any_order_and_by_any_number() -> None:
    said = ratings(3, 20, 2.0, times=2)
    order = np.random.default_rng(0).permutation(len(said.rating))
    other = replace(said.of(order), wearer=1000 - 7 * said.wearer[order])
    assert posterior(other, PRIOR).target() == pytest.approx(
        posterior(said, PRIOR).target(), abs=1e-9
    )


def test_one_wearer_who_rates_often_counts_less_than_many() -> None:
    said = ratings(4, 40, 4.0)
    one = replace(said, wearer=np.zeros_like(said.wearer))
    assert posterior(one, PRIOR).target()[1] > 1.5 * posterior(said, PRIOR).target()[1]


def test_intervals_hold_the_target_as_often_as_they_say() -> None:
    """The benchmark has 2,000 shops; of 120 at least 89 % should hold (three sd)."""
    hits = [hit for zone in PRIORS for hit in coverage(zone, 20, 7)]
    assert np.mean(hits) >= 0.89


def test_wearers_who_answer_at_random_do_not_move_a_target_by_a_millimetre() -> None:
    moved = moves(1, 11, TWO_PAIRS)
    assert moved.shape == (1, len(PRIORS))
    assert np.abs(moved).max() < 1.0


def test_half_of_the_answers_at_the_edge_of_good_are_right() -> None:
    low, high = good_band(2.0, 5.0, 0.5)
    known = replace(MODEL, wearer_sd_mm=0.0, slips=0.0)
    p = rating_probabilities(np.array([low, high]), 2.0, 5.0, model=known)
    assert p[:, 2] == pytest.approx([0.5, 0.5], abs=0.02)
    assert good_band(2.0, 1.0, 3.0) == (-1.0, 5.0)


def evidence(said: Ratings, rule: ZoneRule = BALL):
    (zone,) = zone_evidence({rule.zone: rule}, {rule.zone: said})
    return zone


def test_enough_ratings_move_target_and_ranges() -> None:
    zone = evidence(spread_out(5, 80, 5.0))
    assert zone.status == "applied"
    assert zone.reason is None
    assert zone.target_interval_mm[0] < 5.0 < zone.target_interval_mm[1]
    assert zone.after.target == pytest.approx(zone.target_mm, abs=0.06)
    move = zone.after.target - BALL.target
    assert zone.after.acceptable[1] == pytest.approx(BALL.acceptable[1] + move, abs=0.11)
    assert zone.after.good[0] < zone.after.target < zone.after.good[1]
    assert zone.losses[1] < zone.losses[0]


@pytest.mark.parametrize(
    ("wearers", "status", "words"), [(9, "too_few", "from 10 on"), (19, "shown", "20 are needed")]
)
def test_few_wearers_change_nothing(wearers: int, status: str, words: str) -> None:
    zone = evidence(spread_out(5, wearers, 5.0))
    assert (zone.status, zone.after) == (status, BALL)
    assert words in zone.reason


def test_many_ratings_of_few_wearers_are_few() -> None:
    said = spread_out(5, 90, 5.0)
    zone = evidence(replace(said, wearer=said.wearer % 9))
    assert (zone.status, zone.wearers, zone.ratings) == ("too_few", 9, 90)


@pytest.mark.parametrize(("least", "most", "words"), [(0, 2, "too tight"), (-2, 0, "too loose")])
def test_one_sided_ratings_change_nothing(least: int, most: int, words: str) -> None:
    said = spread_out(6, 60, 0.0)
    zone = evidence(replace(said, rating=np.clip(said.rating, least, most)))
    assert (zone.status, zone.after) == ("shown", BALL)
    assert words in zone.reason


def test_ratings_that_fall_with_the_clearance_change_nothing() -> None:
    said = spread_out(7, 80, 1.0)
    zone = evidence(replace(said, rating=-said.rating))
    assert zone.after == BALL
    assert zone.status == "shown"


def test_ratings_that_bend_away_from_the_model_change_nothing() -> None:
    """A shoe that is far too loose lets the foot slide forward, and presses too."""
    clearance = np.linspace(-9.0, 11.0, 80)
    said = np.where(np.abs(clearance - 1.0) < 4.0, np.arange(80) % 2, -2)
    ones = np.ones(80)
    steep = Ratings(clearance, ones, said, np.arange(80), 0.0 * ones)
    assert largest_bend(steep, posterior(steep, PRIOR)) > 0.5
    assert evidence(steep).after == BALL


def test_ratings_of_the_model_do_not_bend() -> None:
    bends = [
        largest_bend(s, posterior(s, PRIOR)) for s in (spread_out(k, 80, 1.0) for k in range(20))
    ]
    assert max(bends) < 0.5


def test_ratings_that_agree_with_the_profile_leave_it_or_move_it_little() -> None:
    moved = [evidence(spread_out(seed, 100, 0.0)).after.target for seed in range(5)]
    assert np.abs(moved).max() < 2.5


def test_a_target_moves_by_two_prior_sds_at_most() -> None:
    said = spread_out(8, 200, 1.0)
    far = replace(said, clearance_mm=said.clearance_mm + 25.0)
    zone = evidence(far)
    assert abs(zone.after.target) <= 2.0 * PRIOR.target_sd_mm + 0.05


DEFINITIONS = {name: f"{name}/1" for name in fits.ZONES}


def test_a_rating_of_a_place_speaks_for_its_zones() -> None:
    entries = [fits.entry(k, ratings={"ball": 1, "heel": -1, "toe": 0}) for k in range(5)]
    log = log_ratings(entries, "walking", DEFINITIONS)
    assert set(log.zones) == {"ball_girth", "ball_width", "heel_width", "length"}
    assert log.zones["ball_width"].rating.tolist() == [1] * 5
    assert log.zones["heel_width"].rating.tolist() == [-1] * 5
    assert log.left_out == {}


def test_entries_that_cannot_be_compared_are_counted() -> None:
    entries = [
        fits.entry(1, profile="dress"),
        fits.entry(2, ratings={}),
        fits.entry(3, ratings={"ball": 0}, zones=()),
        fits.entry(4, ratings={"ball": 0}),
        fits.entry(
            5,
            ratings={"ball": 0},
            zones=(replace(fits.entry(5).zones[1], definition="ball_girth/0"),),
        ),
    ]
    log = log_ratings(entries, "walking", DEFINITIONS)
    assert len(log.zones["ball_girth"].rating) == 1
    assert sorted(log.left_out.values()) == [1, 1, 2]


def test_a_wearer_is_a_code_or_else_a_foot() -> None:
    entries = [
        fits.entry(1, ratings={"ball": 0}, wearer="A"),
        fits.entry(2, ratings={"ball": 0}, wearer="A"),
        fits.entry(3, ratings={"ball": 0}, wearer=None),
        fits.entry(3, ratings={"ball": 0}, wearer=None, id="x"),
        fits.entry(4, ratings={"ball": 0}, wearer=None),
    ]
    assert log_ratings(entries, "walking", DEFINITIONS).zones["ball_girth"].wearers == 3


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["knee=1"], "names no place"),
        (["ball"], "has no rating"),
        (["ball=3"], "has no rating"),
        (["ball=1.5"], "has no rating"),
        (["ball=1", "ball=0"], "rated twice"),
    ],
)
def test_a_bad_rating_is_refused(given: list[str], words: str) -> None:
    with pytest.raises(BadOption, match=words):
        place_ratings(given)


def test_ratings_are_read_with_or_without_a_sign() -> None:
    given = ["ball=+1", "toe=0", " heel = -2", "instep=2"]
    assert place_ratings(given) == {"ball": 1, "toe": 0, "heel": -2, "instep": 2}
