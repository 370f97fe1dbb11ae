"""The summary of a survey of feet that footfit ships: the ball girth of women and men by length.

python -m tools.make_survey

The people are those of ANSUR II, where ../shared/population is present. A straight line gives the
mean ball girth of feet of a length. The spread around it does not change with the length: that of
tenths of the people by length differs by at most 12 %. A normal distribution around the line gives
each person's share to within 2.3 percentage points, which the tool prints.
"""

from __future__ import annotations

import csv
from math import erf, sqrt
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PEOPLE = ROOT.parent / "shared" / "population"
FILES = {"women": "ansur2_female.csv", "men": "ansur2_male.csv"}
SUMMARY = ROOT / "footfit" / "pipeline" / "width" / "survey.toml"
COVERED_PERCENT = (0.5, 99.5)
"""The lengths that the summary speaks of: 99 % of the people have one of these."""

HEAD = """\
# The ball girth of feet by their length, in a survey of people. Made by tools/make_survey.py.
#
# Of each group: how many people; from which length to which the summary holds (99 % of them); the
# mean ball girth at mean_length_mm, its rise with each mm of length, and the standard deviation of
# people around it. docs/fit.md says how footfit uses it.
source = "ANSUR II, US Army 2012, soldiers of 17 to 58 years"
licence = "US public domain"
"""


def summary(path: Path) -> dict[str, float]:
    """The summary of one file of the survey, in mm."""
    rows = list(csv.DictReader(path.open()))
    length, girth = (
        np.array([float(row[name]) for row in rows])
        for name in ("footlength", "balloffootcircumference")
    )
    rise, start = np.polyfit(length, girth, 1)
    rest = girth - start - rise * length
    spread = float(rest.std(ddof=2))
    below = np.array([np.mean(rest < value) + 0.5 * np.mean(rest == value) for value in rest])
    normal = np.array([0.5 * (1.0 + erf(value / spread / sqrt(2.0))) for value in rest])
    print(f"{path.name}: the shares are right to {100 * np.abs(below - normal).max():.1f} points")
    shortest, longest = np.percentile(length, COVERED_PERCENT)
    return {
        "people": len(rows),
        "shortest_mm": round(float(shortest)),
        "longest_mm": round(float(longest)),
        "mean_length_mm": round(float(length.mean()), 1),
        "mean_girth_mm": round(float(start + rise * length.mean()), 1),
        "girth_per_length": round(float(rise), 3),
        "girth_sd_mm": round(spread, 2),
    }


def text() -> str:
    """The summary as TOML."""
    tables = [HEAD]
    for group, name in FILES.items():
        lines = (f"{key} = {value:g}" for key, value in summary(PEOPLE / name).items())
        tables.append("\n".join((f"[groups.{group}]", *lines, "")))
    return "\n".join(tables)


if __name__ == "__main__":
    SUMMARY.write_text(text(), encoding="utf-8")
    print(SUMMARY)
