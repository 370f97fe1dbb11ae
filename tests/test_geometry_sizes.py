"""Sizes: the formulas of the systems, children, limits, and labels against lengths."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.fit.sizes import (
    SYSTEMS,
    exact_size,
    foot_size,
    foot_sizes,
    label_check,
    label_words,
    size_words,
    system_named,
)
from tests.bounds import ROUNDING

FORMULAS = {  # of the foot's length in mm
    "eu": lambda mm: 1.5 * mm / 10.0 + 2.0,
    "uk": lambda mm: 3.0 * mm / 25.4 - 23.0,
    "us-men": lambda mm: 3.0 * mm / 25.4 - 22.0,
    "us-women": lambda mm: 3.0 * mm / 25.4 - 20.5,
    "us-women-fia": lambda mm: 3.0 * mm / 25.4 - 21.0,
    "mondopoint": lambda mm: mm,
}


@given(st.floats(100.0, 345.0))
@settings(deadline=None, max_examples=100)
def test_a_size_is_its_formula_and_the_nearest_as_sold(length_mm: float) -> None:
    for size in foot_sizes(length_mm):
        system = SYSTEMS[size.system]
        assert size.exact == pytest.approx(FORMULAS[size.system](length_mm), abs=ROUNDING)
        assert abs(size.nearest - size.exact) <= 0.5 * system.grid + 1e-6
        assert size.nearest / system.grid == pytest.approx(round(size.nearest / system.grid))
        low, high = size.beside
        assert low == size_words(size.nearest - system.grid, system)
        assert high == size_words(size.nearest + system.grid, system)


def test_every_system_has_its_formula_here() -> None:
    assert set(FORMULAS) == set(SYSTEMS)


@pytest.mark.parametrize(("name", "longer"), [("eu", 13.3), ("uk", 16.9), ("us-men", 16.9)])
def test_a_last_of_a_size_is_as_much_longer_as_published(name: str, longer: float) -> None:
    system = SYSTEMS[name]
    assert system.allowance_mm == pytest.approx((longer, longer), abs=0.05)


def test_eu_sizes_are_the_lasts_paris_points() -> None:
    """A Paris point is two thirds of a centimetre of the last: 42 is 280 mm."""
    check = label_check("42", "eu", 42 * 20.0 / 3.0)
    assert check is not None
    assert check.off == pytest.approx(0.0, abs=ROUNDING)


def test_children_are_said_in_their_own_numbers() -> None:
    assert foot_size(180.0, SYSTEMS["uk"]).child
    assert (
        foot_size(202.0, SYSTEMS["uk"]).words == "UK child's 14"
        or foot_size(202.0, SYSTEMS["uk"]).words == "UK 1"
    )
    assert size_words(0.5, SYSTEMS["uk"]) == "UK child's 13.5"
    assert size_words(1.0, SYSTEMS["uk"]) == "UK 1"


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_the_least_and_the_largest_size_are_made(system):
    least, largest = size_words(system.least, system), size_words(system.largest, system)
    assert not least.startswith("under ")
    assert not largest.startswith("over ")
    assert size_words(system.least - system.grid, system).startswith("under ")
    assert size_words(system.largest + system.grid, system).startswith("over ")
    assert not foot_size(260.0, SYSTEMS["eu"]).child


def test_children_of_both_us_systems_share_one_scale() -> None:
    for mm in (150.0, 165.0, 180.0, 190.0):
        men, women = (foot_size(mm, SYSTEMS[name]).words for name in ("us-men", "us-women"))
        assert men.replace("US men", "") == women.replace("US women", "")


@pytest.mark.parametrize(("mm", "word"), [(80.0, "under EU child's 16"), (365.0, "over EU 52")])
def test_outside_of_the_range_is_said(mm: float, word: str) -> None:
    size = foot_size(mm, SYSTEMS["eu"])
    assert not size.within
    assert size.words.startswith(word)


@given(st.floats(35.0, 48.0), st.floats(-6.0, 6.0))
@settings(deadline=None, max_examples=100)
def test_a_label_is_off_by_what_was_planted(size: float, off: float) -> None:
    label, length_mm = f"{size + off:.3f}", size * 20.0 / 3.0
    check = label_check(label, "EU", length_mm)
    assert check is not None
    assert check.off == pytest.approx(off, abs=1e-3)
    assert check.by_length == pytest.approx(size, abs=ROUNDING)
    if abs(abs(off) - 1.0) > 0.01:
        assert check.flagged == (abs(off) > 1.0)


@pytest.mark.parametrize(
    ("label", "value"), [("9½", 9.5), ("9 1/2", 9.5), ("9,5", 9.5), ("9.5", 9.5)]
)
def test_halves_are_read_as_people_write_them(label: str, value: float) -> None:
    last_mm = (value + 25.0) * 25.4 / 3.0  # UK: size = 3 last_in - 25
    check = label_check(label, "uk", last_mm)
    assert check is not None
    assert check.off == pytest.approx(0.0, abs=ROUNDING)


def test_a_childs_last_is_not_taken_for_a_mislabelled_adults() -> None:
    child_12_mm = (12.0 - 13.0 + 25.0) * 25.4 / 3.0
    for label in ("12", "12C", "12k"):
        check = label_check(label, "uk", child_12_mm)
        assert check is not None
        assert not check.flagged
    adult_12_mm = (12.0 + 25.0) * 25.4 / 3.0
    wrong = label_check("12C", "uk", adult_12_mm)
    assert wrong is not None
    assert wrong.flagged


def test_mondopoint_leaves_the_last_its_makers_allowance() -> None:
    for longer in (10.0, 13.3, 17.0):
        check = label_check("260", "mondopoint", 260.0 + longer)
        assert check is not None
        assert check.off == pytest.approx(0.0, abs=ROUNDING)
    near = label_check("260", "mondopoint", 281.0)  # 4 mm over the largest allowance
    assert near is not None
    assert not near.flagged
    assert label_check("260", "mondopoint", 290.0).flagged


@pytest.mark.parametrize(("label", "system"), [(None, "eu"), ("42", None), ("L", "eu"), ("4", "x")])
def test_what_says_no_number_is_not_judged(label: str | None, system: str | None) -> None:
    assert label_check(label, system, 280.0) is None


def test_words_name_the_size_that_the_length_has() -> None:
    check = label_check("38", "eu", 280.0)
    assert check is not None
    assert label_words(check).endswith("it is EU 42 by its length")


def test_systems_are_found_by_any_spelling() -> None:
    assert system_named("US_women") is SYSTEMS["us-women"]
    assert system_named(" Mondo ") is SYSTEMS["mondopoint"]
    assert exact_size(0.0, SYSTEMS["mondopoint"]) == 0.0
