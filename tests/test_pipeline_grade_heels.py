"""Widths and sizes of lasts with a high heel: their search arrives, and says why if it does not."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks import stance
from footfit.errors import OutOfReach
from footfit.geometry.measures.landmarks import Shape
from footfit.pipeline.graded_runs import grade_shape
from footfit.pipeline.graded_runs.grade_plan import standing, targets
from footfit.pipeline.graded_runs.grade_shape import GRADE, GradeStep, refuse_missed
from tests.test_pipeline_grade import measured, plan, standing_base, stepped

MOST_ROUNDS = 4
"""Of one search; measured: 2 to 4, and 5 to 8 while probes answered for a change of length."""
SEARCHED_MM = 0.02


@pytest.mark.parametrize(
    ("heel_mm", "end"),
    [(60.0, (0.0, 1.0)), (80.0, (-1.0, -1.0)), (100.0, (0.0, -1.0))],
)
def test_a_width_of_a_high_heel_is_found_in_few_rounds(
    heel_mm: float, end: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    arrives(*standing_base(heel_mm), end, monkeypatch)


@pytest.mark.parametrize("heel_mm", [80.0, 100.0])
def test_a_width_of_a_high_heel_of_the_second_family_is_found_in_few_rounds(
    heel_mm: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not stance.second_family():
        pytest.skip("../shared/tools/lasts2.py is not here; the project's own lasts are tested")
    case = stance.other(np.random.default_rng(2), (heel_mm, heel_mm), 0)
    shape = Shape(case.vertices_mm, case.faces, "last")
    labels = standing(targets(plan(), measured(shape), 0.0, 0.0), None)
    shape = Shape(shape.vertices_mm, shape.faces, "last", labels)
    arrives(shape, measured(shape), (0.0, -1.0), monkeypatch)


def arrives(
    shape: Shape,
    base_mm: dict[str, float],
    end: tuple[float, float],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The search of a step ends in few rounds, and the last has what the rule plans."""
    searches = []
    search = grade_shape.solution

    def counted(*given: object, **options: object) -> object:
        searches.append(search(*given, **options))  # type: ignore[arg-type]
        return searches[-1]

    monkeypatch.setattr(grade_shape, "solution", counted)
    reached = measured(stepped(shape, base_mm, (0.0, 0.0), end))
    assert searches
    assert all(each.met for each in searches)
    assert max(each.rounds for each in searches) <= MOST_ROUNDS
    for name, goal in targets(plan(), base_mm, *end).items():
        if goal.by == "rule":
            assert reached[name] == pytest.approx(goal.target, abs=SEARCHED_MM), name


@pytest.mark.parametrize(
    ("ratio", "held", "value", "words"),
    [
        (1.0, (), 267.299, "267.35 mm and stays 0.05 mm too small: take fewer widths, or another"),
        (1.02, (), 267.402, "267.35 mm and stays 0.05 mm too large: take fewer sizes, or another"),
        (1.02, ("top",), 200.0, "stays 67.35 mm too small: do not hold the top"),
        (1.0, (), np.nan, "267.35 mm and can no longer be measured: take fewer widths"),
    ],
)
def test_a_target_that_is_missed_is_said_with_a_difference_that_shows(
    ratio: float, held: tuple[str, ...], value: float, words: str
) -> None:
    step = GradeStep(ratio, {"bottom_length": 267.35}, frozenset(held), standing({}, None))
    with pytest.raises(OutOfReach, match=words):
        refuse_missed(step, np.array([value]))
    refuse_missed(step, np.array([267.35 + 0.9 * GRADE.met_mm]))
