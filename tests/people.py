"""Populations and libraries of lasts made by code, without a mesh."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from footfit.geometry.measures.measure_table import measure_named
from footfit.geometry.numeric.arrays import Floats
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.heel_model import heel_question
from footfit.pipeline.population.coverage_run import Population, coverage
from footfit.pipeline.population.feet_csv import feet_of_csv
from footfit.pipeline.population.judging import Asking
from footfit.pipeline.population.tables import last_table
from footfit.results import LastRecord, Measure, Measured
from footfit.results.population.coverage_answer import Coverage
from footfit.results.worn import BAREFOOT
from tests import answers

NAMES = ("length", "ball_girth", "ball_width", "heel_width", "instep_girth")
MEANS = (246.3, 228.1, 92.7, 61.8, 228.0)
SDS = (12.4, 11.8, 4.8, 4.0, 12.0)
ASKED = {"length": 13.0, "ball_width": -2.0, "instep_girth": 1.5}
"""The targets of the profile walking that are not 0."""
WALKING = Asking(fit_profile("walking"), heel_question(), BAREFOOT)


def sizes(count: int, seed: int = 0) -> Floats:
    """The measures of so many feet, (n, 5) by `NAMES`, as a spreadsheet has them: to 0.1 mm."""
    rng = np.random.default_rng(seed)
    common = rng.normal(size=(count, 1))
    z = 0.6 * common + 0.8 * rng.normal(size=(count, len(NAMES)))
    return np.round(np.array(MEANS) + z * np.array(SDS), 1)


def write_csv(path: Path, rows: Floats, ids: Sequence[str] = ()) -> Path:
    """A CSV of feet with their measures."""
    names = ids or [f"p{number}" for number in range(len(rows))]
    lines = [",".join(map(str, (name, *row))) for name, row in zip(names, rows, strict=True)]
    path.write_text("\n".join((",".join(("id", *NAMES)), *lines)) + "\n", encoding="utf-8")
    return path


def last_for(name: str, foot: Floats, **labels: object) -> LastRecord:
    """A last on the targets of the profile walking for a foot with these measures."""
    record = answers.record(name, length_mm=float(foot[0]) + ASKED["length"], **labels)
    rows = [
        _measure(each, value + ASKED.get(each, 0.0))
        for each, value in zip(NAMES, foot, strict=True)
    ]
    return replace(record, measures=tuple(rows))


def _measure(name: str, value: float) -> Measure:
    entry = measure_named(name)
    return Measure(name, Measured(float(value), entry.sd), entry.definition_id)


def answer(path: Path, lasts: Sequence[LastRecord], **given: object) -> Coverage:
    """The coverage of the feet of a CSV by lasts."""
    feet, notices = feet_of_csv(path)
    people = Population(feet, warnings=notices, **given)
    return coverage(people, last_table(lasts, WALKING.profile), WALKING)


def small_answer() -> Coverage:
    """The coverage of twelve feet by two lasts, one of which the other replaces."""
    with tempfile.TemporaryDirectory() as folder:
        path = write_csv(Path(folder) / "feet.csv", sizes(12))
        lasts = [last_for(name, sizes(12)[0]) for name in ("derby-38", "derby-38-copy")]
        return answer(path, lasts)
