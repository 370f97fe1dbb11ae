"""For how many months a child's shoe will do: room over rate, as a range with its grounds."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.errors import BadOption
from footfit.pipeline.customers.growth_forecast import (
    RULE,
    age_range,
    growth_question,
    growth_rate,
    month_range,
)
from footfit.results import Growth, GrowthQuestion
from tests.conftest import Footfit


@pytest.mark.parametrize(
    ("age", "rate"),
    [(1.0, 2.2), (1.5, 1.7), (2.5, 1.3), (5.0, 1.05), (9.0, 0.8), (12.5, 0.4), (16.0, 0.0)],
)
def test_the_rate_is_that_of_the_age(age: float, rate: float) -> None:
    assert growth_rate(age, None) == rate


def test_girls_stop_a_year_before_boys() -> None:
    assert (growth_rate(13.5, "female"), growth_rate(13.5, "male")) == (0.0, 0.4)


@given(room=st.floats(0.0, 30.0), rate=st.floats(0.4, 2.2))
def test_months_are_the_room_beyond_nine_millimetres(room: float, rate: float) -> None:
    low, high = month_range(room - RULE.kept_mm, rate, rate)
    assert high is not None
    assert 0.0 <= low <= high
    middle = (room - RULE.kept_mm) / rate
    if middle > 0.0:
        assert low <= middle <= high
    else:
        assert high == 0.0


@given(room=st.floats(9.5, 25.0), length=st.floats(120.0, 230.0))
def test_a_known_age_gives_a_narrower_range(room: float, length: float) -> None:
    low, high = age_range(length, GrowthQuestion())
    middle = 0.5 * (low + high)
    room -= RULE.kept_mm
    wide = month_range(room, growth_rate(high, None), growth_rate(low, None))
    narrow = month_range(room, growth_rate(middle, None), growth_rate(middle, None))
    assert wide[0] <= narrow[0] + 1e-9
    assert narrow[1] is not None
    assert wide[1] is not None
    assert wide[1] >= narrow[1] - 1e-9


@pytest.mark.parametrize(
    ("months", "words"),
    [
        ((2.2, 7.3), "2 to 7 months"),
        ((6.9, None), "for 7 months or more"),
        (None, "hardly grow"),
        ((0.0, 0.0), "leaves none to grow"),
    ],
)
def test_the_sentence_says_the_range_and_when_to_measure(
    months: tuple[float, float | None] | None, words: str
) -> None:
    check = None if months is None else months[0] / 2.0
    growth = Growth("a", 14.0, 9.0, months, check, (1.0, 1.0), (5.0, 5.0), None, "an age of 5")
    assert words in growth.words


def test_a_foot_that_may_have_stopped_to_grow_has_no_last_month() -> None:
    low, high = month_range(5.6, 0.0, 0.4)
    assert low == month_range(5.6, 0.4, 0.4)[0]
    assert high is None
    assert month_range(-1.0, 0.0, 0.4) == (0.0, 0.0)


def test_age_and_sex_go_with_growth() -> None:
    assert growth_question(False) is None
    with pytest.raises(BadOption, match="--growth"):
        growth_question(False, age_years=5.0)
    with pytest.raises(BadOption, match="years"):
        growth_question(True, age_years=40.0)


def test_the_answer_says_for_how_long(footfit: Footfit, foot: Path, catalogue: Path) -> None:
    asked = ("--growth", "--age", 5, "--catalogue", catalogue)
    answer = json.loads(footfit("match", foot, "--json", *asked).out)
    growth, first = answer["growth"], answer["candidates"][0]
    assert growth["last"] == first["last"]
    assert growth["room_mm"] == first["clearance_mm"]["length"]["value"]
    low, high = growth["months"]
    assert low < (growth["room_mm"] - 9.0) / 1.05 < high
    assert growth["kept_mm"] == 9.0
    run = footfit("match", foot, *asked)
    assert "months" in run.out + run.err
    run = footfit("match", foot, "--age", 5, "--catalogue", catalogue)
    assert run.code == 2


def test_a_sock_takes_room_to_grow(footfit: Footfit, foot: Path, catalogue: Path) -> None:
    asked = ("--growth", "--age", 5, "--sock", 2, "--load", "half", "--catalogue", catalogue)
    growth = json.loads(footfit("match", foot, "--json", *asked).out)["growth"]
    assert growth["kept_mm"] == pytest.approx(9.0 + 2 * 2.0)
    low, high = growth["months"]
    assert low <= max((growth["room_mm"] - 13.0) / 1.05, 0.0) <= high
