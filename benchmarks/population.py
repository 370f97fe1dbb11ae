"""What share of people does a complete size run fit, by each shipped profile?

    python -m benchmarks.population [--write]

The people are the 6,068 of the ANSUR II survey, where ../shared/population is present. The run is
drawn, not scanned: for women and for men one last for every EU size and every width, 5 mm of ball
girth apart, made for the mean foot of its length and girth with the clearances that the profile
asks for. So this measures the profiles' ranges against how feet of one length and girth differ.
Only zones that the survey measured are judged. ``--write`` puts the table into docs/fit.md.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.tables import markdown, put
from footfit.geometry.fit.sizes import SYSTEMS
from footfit.geometry.measures.measure_table import MEASURES
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.fit.fit_profile import fit_profile, shipped
from footfit.pipeline.fit.judging.clearances import BALL_SHARE
from footfit.pipeline.fit.scoring import (
    ACCEPTABLE,
    GOOD,
    REJECT,
    Column,
    fit_distance,
    scores,
    worst_levels,
)
from footfit.results import FitProfile

PEOPLE = Path(__file__).resolve().parents[2] / "shared" / "population"
FILES = {"women": "ansur2_female.csv", "men": "ansur2_male.csv"}
COLUMNS = {  # ours to the survey's
    "length": "footlength",
    "ball_line": "balloffootlength",
    "ball_girth": "balloffootcircumference",
    "ball_width": "footbreadthhorizontal",
    "heel_width": "heelbreadth",
    "short_heel_girth": "heelanklecircumference",
}
OURS = {"heel_width": 0.92}  # the survey's heel breadth is the greatest, ours is at L/6
SIZE_MM, WIDTH_MM = 20.0 / 3.0, 5.0
TRIED_SIZES = (-1, 0, 1)
RUNS = {"one width": (0,), "three widths": (-1, 0, 1), "every width": tuple(range(-6, 7))}


@dataclass(frozen=True)
class Feet:
    """n people's feet: ``values`` by zone, (n,) each, in mm, and the mean foot's by regression."""

    values: dict[str, Floats]

    def mean_foot(self, zone: str, length: Floats, girth: Floats) -> Floats:
        """A zone's mean over feet of a length and a girth, linear in both."""
        rows = [
            np.ones_like(self.values["length"]),
            self.values["length"],
            self.values["ball_girth"],
        ]
        fitted = np.linalg.lstsq(np.column_stack(rows), self.values[zone], rcond=None)[0]
        return fitted[0] + fitted[1] * length + fitted[2] * girth

    def mean_girth(self, length: Floats) -> Floats:
        """The mean ball girth of feet of a length."""
        slope, start = np.polyfit(self.values["length"], self.values["ball_girth"], 1)
        return start + slope * length


def feet(path: Path) -> Feet:
    """The feet of one file of the survey."""
    rows = list(csv.DictReader(path.open()))
    return Feet(
        {
            zone: np.array([float(row[column]) for row in rows]) * OURS.get(zone, 1.0)
            for zone, column in COLUMNS.items()
        }
    )


def clearances(people: Feet, profile: FitProfile, size: Ints, width: Floats) -> Floats:
    """Last minus foot (n, z) of each person in the last of a size and a width, by the profile's
    zones; NaN where the survey did not measure.
    """
    last_mm = SIZE_MM * size
    made_for = last_mm - SYSTEMS["eu"].allowance_mm[0]
    girth = people.mean_girth(made_for) + width * WIDTH_MM
    found = np.full((len(size), len(profile.zones)), np.nan)
    for place, rule in enumerate(profile.zones):
        if rule.zone == "length":
            found[:, place] = last_mm - people.values["length"]
        elif rule.zone == "ball_girth":
            found[:, place] = girth + rule.target - people.values["ball_girth"]
        elif rule.zone in COLUMNS:
            found[:, place] = (
                people.mean_foot(rule.zone, made_for, girth) - people.values[rule.zone]
            )
            found[:, place] += rule.target
    return in_shares(found, people, profile)


def in_shares(found: Floats, people: Feet, profile: FitProfile) -> Floats:
    """The same with the ball line in % of the foot's length, less what the last's excess carries:
    as ``pipeline.zones.ball_line`` has it.
    """
    names = [rule.zone for rule in profile.zones]
    length, ball = names.index("length"), names.index("ball_line")
    carried = BALL_SHARE * (found[:, length] - profile.zones[length].target)
    explained = np.clip(found[:, ball], np.minimum(carried, 0.0), np.maximum(carried, 0.0))
    found[:, ball] = 100.0 * (found[:, ball] - explained) / people.values["length"]
    return found


def best_lasts(people: Feet, profile: FitProfile, widths: tuple[int, ...]) -> tuple[Ints, Ints]:
    """The best last's verdict (n,) and its zones' (n, z), ranked as by a match: by verdict."""
    columns = [Column(0, rule, rule.weight > 0) for rule in profile.zones]
    sds = np.array([_sd(rule.zone) for rule in profile.zones])
    size = np.round((people.values["length"] + profile.zones[0].target) / SIZE_MM).astype(int)
    tried = []
    for step in TRIED_SIZES:
        for width in widths:
            room = clearances(people, profile, size + step, np.full(len(size), float(width)))
            spread = np.broadcast_to(sds, room.shape)
            scored = scores(room, spread, spread, columns)
            whole = worst_levels(scored.level, columns)
            out = whole == REJECT
            key = (whole * 10.0 + scored.level[:, 0]) * 100.0 + fit_distance(scored)
            tried.append((np.where(out, 1e6, key), whole, scored.level))
    first = np.argmin([key for key, _, _ in tried], axis=0)
    rows = np.arange(len(size))
    return (
        np.stack([whole for _, whole, _ in tried])[first, rows],
        np.stack([level for _, _, level in tried])[first, rows],
    )


def _sd(zone: str) -> float:
    name = {"ball_line": "ball_length"}.get(zone, zone)
    return next((entry.sd for entry in MEASURES if entry.name == name), 0.0)


def rows(run: str) -> Iterator[list[str]]:
    """A line a profile: who finds what in the run, and the zones that keep a last from good."""
    for name in shipped():
        profile = fit_profile(name)
        parts = [best_lasts(feet(PEOPLE / file), profile, RUNS[run]) for file in FILES.values()]
        whole, level = (np.concatenate(part) for part in zip(*parts, strict=True))
        shares = [100.0 * np.mean(whole == GOOD), 100.0 * np.mean(whole <= ACCEPTABLE)]
        kept = {
            rule.zone.replace("_", " "): 100.0 * np.mean(level[:, place] > GOOD)
            for place, rule in enumerate(profile.zones)
            if rule.zone in COLUMNS
        }
        worst = sorted(kept.items(), key=lambda item: -item[1])[:4]
        none = 100.0 * np.mean(whole == REJECT)
        yield [
            name, run, *(f"{share:.0f} %" for share in shares), f"{none:.1f} %",
            ", ".join(f"{zone} {share:.0f} %" for zone, share in worst),
        ]  # fmt: skip


def main() -> None:
    """Print the table, or write it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    if not PEOPLE.is_dir():
        print("skipped: there is no ../shared/population")
        return
    head = ["profile", "run", "good", "good or acceptable", "nothing fits", "not good, by zone"]
    text = markdown(head, [row for run in RUNS for row in rows(run)])
    print(text)
    if options.write:
        put("fit.md", "population", text)


if __name__ == "__main__":
    main()
