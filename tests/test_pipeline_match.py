"""Ranking: the length gate, tiers, ties, sides, pairs; on records made by code."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from footfit.errors import NoCandidate
from footfit.pipeline.fit import TIE_DISTANCE, WALKING
from footfit.pipeline.match import Library, Question, matched
from footfit.results import LastRecord, Profiled
from tests import answers


def last(name: str, turn_deg: float = 8.0, length_mm: float = 273.0, **more: Any) -> LastRecord:
    return answers.record(name, turn_deg, length_mm, **more)


def library(*lasts: LastRecord) -> Library:
    return Library(tuple(lasts), len(lasts), lasts[0].labels.name if lasts else None)


def names(*lasts: LastRecord, foot: Profiled | None = None, **question: Any) -> list[str]:
    feet = [foot or answers.foot(length_mm=260.0, turn_deg=8.0)]
    found = matched(feet, library(*lasts), Question(**question))
    return [candidate.last for candidate in found.candidates]


def test_the_length_gate_holds_whatever_the_flare() -> None:
    short, long, good = last("a", 8, 267.9), last("b", 8, 280.1), last("c", 30, 273)
    assert names(short, long, good) == ["c"]
    found = matched([answers.foot(length_mm=260.0)], library(short, long, good))
    assert dict(found.rejected) == {"too_long": 1, "too_short": 1}


def test_by_flare_knows_no_size_and_says_so() -> None:
    found = matched(
        [answers.foot(length_mm=260.0, turn_deg=8.0)],
        library(last("far", 8, 330), last("near", 20, 273)),
        Question(by="flare"),
    )
    assert [c.last for c in found.candidates] == ["far", "near"]
    assert [notice.code for notice in found.warnings] == ["scale_free"]


def test_the_nearer_flare_ranks_first_and_a_tie_is_settled_by_length_then_name() -> None:
    lasts = [last("z", 8, 273), last("y", 8, 275), last("x", 8, 273), last("w", 25, 273)]
    assert names(*lasts) == ["x", "z", "y", "w"]
    found = matched([answers.foot(length_mm=260.0, turn_deg=8.0)], library(*lasts))
    assert set(found.candidates[0].tied_with) == {"y", "z"}
    assert found.candidates[-1].tied_with == ()
    distances = [candidate.distance for candidate in found.candidates]
    assert distances[-1] - distances[0] > TIE_DISTANCE


def test_the_order_of_the_library_does_not_matter() -> None:
    lasts = [last(f"l{i}", 4 + 3 * i, 268.5 + i) for i in range(8)]
    assert names(*lasts, top=0) == names(*reversed(lasts), top=0)


def test_top_cuts_the_answer_and_not_the_ranks() -> None:
    lasts = [last(f"l{i}", 8 + 4 * i) for i in range(6)]
    assert names(*lasts, top=2) == names(*lasts, top=0)[:2]


def test_by_shape_finds_the_length_too() -> None:
    lasts = [last(f"{mm}", 8, mm) for mm in (253, 260, 267)]
    assert names(*lasts, by="shape") == ["260", "253", "267"]


def test_a_pair_of_lasts_is_shown_once_on_the_foots_own_side() -> None:
    labels = {"style": "derby", "size": "42", "size_system": "eu"}
    right, left = last("r", **labels), last("l", left=True, **labels)
    other = last("only-right", **{**labels, "size": "43"})
    foot = answers.foot(left=True, length_mm=260.0)
    assert names(right, left, other, foot=foot) == ["l", "only-right"]
    found = matched([foot], library(right, left, other))
    assert [candidate.mirrored for candidate in found.candidates] == [False, True]


def test_the_larger_foot_of_a_pair_governs_the_length() -> None:
    small, large = answers.foot(length_mm=255.0, left=True), answers.foot(length_mm=262.0)
    for feet in ((small, large), (large, small)):
        found = matched(feet, library(last("a", 8, 268), last("b", 8, 275)))
        assert [candidate.last for candidate in found.candidates] == ["b"]
    both_right = (answers.foot(), answers.foot())
    assert "same_side" in [n.code for n in matched(both_right, library(last("a"))).warnings]


def test_where_nothing_fits_the_nearest_are_named_and_not_ranked() -> None:
    found = matched([answers.foot(length_mm=260.0)], library(last("a", 8, 250), last("b", 8, 262)))
    assert found.candidates == ()
    (notice,) = found.warnings
    assert notice.code == "nothing_fits"
    assert "b: 2.0 mm toe room (asked 13); a: 10.0 mm shorter than the foot" in notice.message


def test_no_last_at_all_is_an_error() -> None:
    with pytest.raises(NoCandidate):
        matched([answers.foot()], library())


def test_a_clearance_is_the_last_minus_the_foot_with_its_uncertainty() -> None:
    found = matched([answers.foot(length_mm=260.0)], library(last("a", 8, 273)))
    clearance = dict(found.candidates[0].clearance_mm)["length"]
    assert clearance.value == pytest.approx(13.0)
    assert clearance.sd is not None
    assert clearance.sd > 0
    assert WALKING.good_mm[0] <= 13.0 <= WALKING.good_mm[1]


def test_the_flare_difference_is_the_last_minus_the_foot() -> None:
    foot, one = answers.foot(turn_deg=10.0), last("a", 4.0)
    found = matched([foot], library(one), Question(by="flare"))
    delta = found.candidates[0].flare.delta_deg
    assert delta == pytest.approx(one.flare.angle_deg - foot.flare.angle_deg)
    assert delta < 0
    assert "less inward" in found.candidates[0].why
    same = replace(one, flare=foot.flare)
    found = matched([foot], library(same), Question(by="flare"))
    assert found.candidates[0].distance == pytest.approx(0.0, abs=1e-9)
