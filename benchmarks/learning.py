"""How well ratings teach a profile's target, in simulated shops.

    python -m benchmarks.learning [--shops 2000] [--seed 1] [--write]

Each shop has a target drawn from the prior, a spread, wearers whose wishes differ by 3 mm,
clearances around what the profile asks, scan errors and slips. The first table says how often the
interval of 95 % holds the target; the second how far the target is off by the number of wearers,
against the design's figures; the third how far it moves if one wearer in ten answers at random.
``--write`` puts them into docs/evidence.md.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.tables import markdown, put
from footfit.pipeline.evidence.ratings_model import (
    MODEL,
    Prior,
    Ratings,
    posterior,
    zone_posteriors,
)

PRIORS = {
    "toe room": Prior(14.0, 4.5, 4.0),
    "ball girth": Prior(0.0, 4.5, 5.0),
    "ball width": Prior(1.0, 3.0, 3.0),
    "instep girth": Prior(2.0, 3.75, 5.0),
    "heel width": Prior(-2.0, 2.0, 3.0),
    "short heel girth": Prior(-2.0, 4.25, 5.0),
}
DESIGN = {5.0: {20: 1.4, 50: 0.9, 100: 0.6}, 8.0: {20: 2.1, 50: 1.4, 100: 1.0}}
"""The standard deviation of a target in mm, by the spread and the number of wearers."""


@dataclass(frozen=True, slots=True)
class Shop:
    """The truth of one zone, and what its wearers said."""

    target_mm: float
    ratings: Ratings


def shop(
    rng: np.random.Generator,
    prior: Prior,
    wearers: int,
    times: int = 1,
    spread_mm: float | None = None,
    scan_sd_mm: float = 1.0,
) -> Shop:
    """A shop whose wearers rated ``times`` pairs each."""
    target = rng.normal(prior.target_mm, prior.target_sd_mm)
    drawn = prior.spread_mm * np.exp(rng.normal(0.0, MODEL.log_spread_sd))
    spread = drawn if spread_mm is None else spread_mm
    wearer = np.repeat(np.arange(wearers), times)
    wish = rng.normal(0.0, MODEL.wearer_sd_mm, wearers)[wearer]
    true = rng.normal(prior.target_mm, prior.target_sd_mm, len(wearer))
    felt = (true - target - wish) / spread + rng.normal(size=len(wearer))
    rating = np.digitize(felt, MODEL.cuts) - 2
    slip = rng.random(len(wearer)) < MODEL.slips
    rating = np.where(slip, rng.integers(-2, 3, len(wearer)), rating)
    clearance = true + rng.normal(0.0, scan_sd_mm, len(wearer))
    same = np.ones(len(wearer))
    return Shop(
        target, Ratings(clearance, scan_sd_mm**2 * same, rating, wearer, MODEL.slips * same)
    )


def coverage(count: int, seed: int) -> dict[str, list[bool]]:
    """For each zone, whether the interval of 95 % held the target."""
    rng = np.random.default_rng(seed)
    held: dict[str, list[bool]] = {name: [] for name in PRIORS}
    for number in range(count):
        name = list(PRIORS)[number % len(PRIORS)]
        wearers = int(rng.integers(20, 201))
        trial = shop(rng, PRIORS[name], wearers, times=1 + number // len(PRIORS) % 2)
        low, high = posterior(trial.ratings, PRIORS[name]).target_interval()
        held[name].append(low <= trial.target_mm <= high)
    return held


def errors(count: int, seed: int, times: int) -> dict[tuple[float, int], float]:
    """The root mean square error of a target in mm, by spread and number of wearers."""
    rng = np.random.default_rng(seed)
    result = {}
    for spread, by_count in DESIGN.items():
        prior = Prior(0.0, 5.0, spread)
        for wearers in by_count:
            shops = [shop(rng, prior, wearers, times, spread) for _ in range(count)]
            off = [posterior(s.ratings, prior).target()[0] - s.target_mm for s in shops]
            result[spread, wearers] = float(np.sqrt(np.mean(np.square(off))))
    return result


def moves(count: int, seed: int, times: int) -> np.ndarray:
    """How far targets (count, zones) move if ten wearers of 100 answer at random."""
    rng = np.random.default_rng(seed)
    rows = []
    for _ in range(count):
        zones = {
            n: shop(rng, prior, 100, times, prior.spread_mm).ratings for n, prior in PRIORS.items()
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


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--shops", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true", help="put the tables into docs/evidence.md")
    options = parser.parse_args()
    held = coverage(options.shops, options.seed)
    everything = [hit for hits in held.values() for hit in hits]
    rows = [[n, str(len(h)), f"{100.0 * np.mean(h):.1f}"] for n, h in held.items()]
    rows.append(["all", str(len(everything)), f"{100.0 * np.mean(everything):.1f}"])
    text = markdown(["zone", "shops", "target within 95 % interval, %"], rows) + "\n"
    rows = [
        [
            f"{s:g}",
            str(n),
            str(times),
            f"{rms:.2f}",
            f"{DESIGN[s][n]:g}",
            f"{rms / DESIGN[s][n]:.2f}",
        ]
        for times in (1, 2)
        for (s, n), rms in errors(max(options.shops // 5, 20), options.seed, times).items()
    ]
    text += (
        markdown(
            ["spread, mm", "wearers", "pairs a wearer", "error, mm", "design, mm", "ratio"], rows
        )
        + "\n"
    )
    rows = []
    for times in (1, 2):
        moved = moves(max(options.shops // 40, 5), options.seed, times)
        rows += [
            [name, str(times), f"{moved[:, i].std():.2f}", f"{np.abs(moved[:, i]).max():.2f}"]
            for i, name in enumerate(PRIORS)
        ]
    text += markdown(["zone", "pairs a wearer", "move RMS, mm", "worst, mm"], rows)
    print(text)
    if options.write:
        put("evidence.md", "learning", text)


if __name__ == "__main__":
    main()
