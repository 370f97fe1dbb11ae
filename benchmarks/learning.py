"""How well ratings teach a profile's target, in simulated shops.

    python -m benchmarks.learning [--shops 2000] [--seed 1] [--write]

Each shop has a target drawn from the prior of a zone of the profile ``walking``, a spread, wearers
whose wishes differ by 3 mm, clearances around what the profile asks, scan errors and slips. The
first table says how often the interval of 95 % holds the target, in ``--shops`` shops; the
second how far the target is off by the number of wearers, against the design's figures; the third
how far it moves if one wearer in ten answers at random.
``--write`` puts them into docs/evidence.md.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.tables import markdown, put
from footfit.pipeline.evidence.calibration import prior_of
from footfit.pipeline.evidence.ratings_model import (
    MODEL,
    Prior,
    Ratings,
    RatingsModel,
    posterior,
    zone_posteriors,
)
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.results.fit import ZONE_LABELS

ZONES = ("length", "ball_girth", "ball_width", "instep_girth", "heel_width", "short_heel_girth")
PRIORS = {r.zone: prior_of(r) for r in fit_profile("walking").zones if r.zone in ZONES}
DESIGN = {5.0: {20: 1.4, 50: 0.9, 100: 0.6}, 8.0: {20: 2.1, 50: 1.4, 100: 1.0}}
"""The standard deviation of a target in mm, by the spread and the number of wearers.

It is 1 / sqrt(1 / 5^2 + .6 n / spread^2): a prior of 5 mm, and one rating from each of n wearers.
Of clearances that lie around the target with a standard deviation of one spread, a rating in three
categories teaches .6 / spread^2, one in five .7, slips included.
"""
DESIGN_SD_MM = 5.0


@dataclass(frozen=True, slots=True)
class Setting:
    """How a shop's wearers rate: ``pairs`` each, with an error of the scan of ``scan_sd_mm``.

    ``model`` says how far their wishes differ. The clearances lie around what the profile asks, by
    the prior's standard deviation; ``centred`` around the shop's own target, by the spread.
    """

    pairs: int = 1
    model: RatingsModel = MODEL
    scan_sd_mm: float = 1.0
    centred: bool = False

    @property
    def words(self) -> str:
        """The setting in a cell of a table."""
        if self.centred:
            return "the design's"
        return f"a shop's, {self.pairs} {'pair' if self.pairs == 1 else 'pairs'} a wearer"


ONE_PAIR, TWO_PAIRS = Setting(), Setting(pairs=2)
DESIGNS = Setting(1, replace(MODEL, wearer_sd_mm=0.0), 0.0, centred=True)
"""The design's setting: no wish of a wearer's own, no error of the scan."""


@dataclass(frozen=True, slots=True)
class Shop:
    """The truth of one zone, and what its wearers said."""

    target_mm: float
    ratings: Ratings


def shop(
    rng: np.random.Generator,
    prior: Prior,
    wearers: int,
    setting: Setting = ONE_PAIR,
    spread_mm: float | None = None,
) -> Shop:
    """A shop whose wearers rated their pairs."""
    model = setting.model
    target = rng.normal(prior.target_mm, prior.target_sd_mm)
    drawn = prior.spread_mm * np.exp(rng.normal(0.0, model.log_spread_sd))
    spread = drawn if spread_mm is None else spread_mm
    wearer = np.repeat(np.arange(wearers), setting.pairs)
    wish = rng.normal(0.0, model.wearer_sd_mm, wearers)[wearer]
    around = (target, spread) if setting.centred else (prior.target_mm, prior.target_sd_mm)
    true = rng.normal(*around, len(wearer))
    felt = (true - target - wish) / spread + rng.normal(size=len(wearer))
    rating = np.digitize(felt, model.cuts) - 2
    slip = rng.random(len(wearer)) < model.slips
    rating = np.where(slip, rng.integers(-2, 3, len(wearer)), rating)
    clearance = true + rng.normal(0.0, setting.scan_sd_mm, len(wearer))
    same = np.ones(len(wearer))
    ratings = Ratings(clearance, setting.scan_sd_mm**2 * same, rating, wearer, 0.0 * same)
    return Shop(target, ratings)


def coverage(zone: str, count: int, seed: int) -> list[bool]:
    """Whether the interval of 95 % held the target, in so many shops."""
    rng = np.random.default_rng([seed, ZONES.index(zone)])
    held = []
    for number in range(count):
        setting = (ONE_PAIR, TWO_PAIRS)[number % 2]
        trial = shop(rng, PRIORS[zone], int(rng.integers(20, 201)), setting)
        low, high = posterior(trial.ratings, PRIORS[zone]).target_interval()
        held.append(low <= trial.target_mm <= high)
    return held


def errors(count: int, seed: int, setting: Setting) -> dict[tuple[float, int], float]:
    """The root mean square error of a target in mm, by spread and number of wearers."""
    rng = np.random.default_rng(seed)
    result = {}
    for spread, by_count in DESIGN.items():
        prior = Prior(0.0, DESIGN_SD_MM, spread)
        for wearers in by_count:
            shops = [shop(rng, prior, wearers, setting, spread) for _ in range(count)]
            held = [posterior(each.ratings, prior, setting.model) for each in shops]
            off = [h.target()[0] - s.target_mm for h, s in zip(held, shops, strict=True)]
            result[spread, wearers] = float(np.sqrt(np.mean(np.square(off))))
    return result


def moves(count: int, seed: int, setting: Setting) -> np.ndarray:
    """How far targets (count, zones) move if ten wearers of 100 answer at random."""
    rng = np.random.default_rng(seed)
    rows = []
    for _ in range(count):
        zones = {
            n: shop(rng, prior, 100, setting, prior.spread_mm).ratings
            for n, prior in PRIORS.items()
        }
        random = rng.choice(100, 10, replace=False)
        shuffled = {}
        for name, ratings in zones.items():
            chosen = np.isin(ratings.wearer, random)
            rating = np.where(chosen, rng.integers(-2, 3, len(chosen)), ratings.rating)
            shuffled[name] = replace(ratings, rating=rating)
        calm, stirred = zone_posteriors(zones, PRIORS), zone_posteriors(shuffled, PRIORS)
        rows.append([stirred[n].target()[0] - calm[n].target()[0] for n in PRIORS])
    return np.array(rows)


def coverage_table(count: int, seed: int) -> str:
    """How often the interval held the target, by zone."""
    held = {zone: coverage(zone, count, seed) for zone in ZONES}
    rows = [[ZONE_LABELS[n], str(len(h)), f"{100.0 * np.mean(h):.1f}"] for n, h in held.items()]
    everything = [hit for hits in held.values() for hit in hits]
    rows.append(["all", str(len(everything)), f"{100.0 * np.mean(everything):.1f}"])
    return markdown(["zone", "shops", "target within 95 % interval, %"], rows)


def errors_table(count: int, seed: int) -> str:
    """How far targets are off, against the design's figures."""
    rows = []
    for setting in (DESIGNS, ONE_PAIR, TWO_PAIRS):
        for (spread, wearers), rms in errors(count, seed, setting).items():
            design = DESIGN[spread][wearers]
            figures = [f"{rms:.2f}", f"{design:g}", f"{rms / design:.2f}"]
            rows.append([setting.words, f"{spread:g}", str(wearers), *figures])
    head = ["setting", "spread, mm", "wearers", "error, mm", "design, mm", "ratio"]
    return markdown(head, rows)


def moves_table(count: int, seed: int) -> str:
    """How far targets move if one wearer in ten answers at random."""
    rows = []
    for setting in (ONE_PAIR, TWO_PAIRS):
        moved = moves(count, seed, setting)
        rows += [
            [
                ZONE_LABELS[name],
                str(setting.pairs),
                f"{np.sqrt(np.mean(np.square(moved[:, i]))):.2f}",
                f"{np.abs(moved[:, i]).max():.2f}",
            ]
            for i, name in enumerate(PRIORS)
        ]
    return markdown(["zone", "pairs a wearer", "move RMS, mm", "worst, mm"], rows)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--shops", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true", help="put the tables into docs/evidence.md")
    options = parser.parse_args()
    text = "\n".join(
        (
            coverage_table(options.shops // len(ZONES), options.seed),
            errors_table(max(options.shops // 5, 20), options.seed),
            moves_table(max(options.shops // 40, 5), options.seed),
        )
    )
    print(text)
    if options.write:
        put("evidence.md", "learning", text)


if __name__ == "__main__":
    main()
