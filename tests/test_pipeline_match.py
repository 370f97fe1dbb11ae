"""Ranking: the gate, zones, ties, sides, pairs, reasons; on records made by code."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption, NoCandidate, OtherKind
from footfit.geometry.measures.measure_table import measure_named
from footfit.number_words import signed
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.fit.compare import best_comparison
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.judging.clearances import BALL_SHARE, ball_line_mm
from footfit.pipeline.fit.match import Question, matched, meets
from footfit.pipeline.fit.scoring import rescan_spread
from footfit.pipeline.scan.one_shape import SURE_KIND
from footfit.pipeline.scan.reading import profiled_source
from footfit.pipeline.shelf.candidates import choice
from footfit.report.page.match_page import match_page
from footfit.report.terminal.match_tables import match_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import Candidate, LastRecord, Library, Match, Measure, Measured, Profiled
from tests import answers, records
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES

WALKING = fit_profile("walking")
FOOT = {"ball_girth": 240.0, "ball_width": 98.0, "heel_width": 62.0, "ball_length": 188.0}
LAST = {"ball_girth": 240.0, "ball_width": 99.0, "heel_width": 60.0, "ball_length": 188.0}
SD_MM = 0.5


def measures(**values_mm: float | None) -> tuple[Measure, ...]:
    return tuple(
        Measure(name, Measured(mm, SD_MM if mm else None, None if mm else "a gap"), f"{name}/1")
        for name, mm in values_mm.items()
    )


def foot(
    length_mm: float = 260.0, turn_deg: float = 8.0, left: bool = False, **mm: Any
) -> Profiled:
    shape = answers.foot(left=left, length_mm=length_mm, turn_deg=turn_deg)
    return replace(shape, measures=measures(length=length_mm, **(FOOT | mm)))


def last(
    name: str, length_mm: float = 274.0, turn_deg: float = 8.0, left: bool = False, **more: Any
) -> LastRecord:
    mm = {key: more.pop(key) for key in tuple(more) if key in LAST}
    record = answers.record(name, turn_deg, length_mm, left, **more)
    return replace(record, measures=measures(length=length_mm, **(LAST | mm)))


def library(*lasts: LastRecord) -> Library:
    return Library(tuple(lasts), len(lasts), lasts[0].labels.name if lasts else None)


def answer(*lasts: LastRecord, feet: tuple[Profiled, ...] | None = None, **question: Any) -> Match:
    return matched(feet or (foot(),), library(*lasts), Question(**question))


def names(*lasts: LastRecord, **more: Any) -> list[str]:
    return [candidate.last for candidate in answer(*lasts, **more).candidates]


def zone(candidate: Candidate, name: str, of: int = 0) -> Any:
    return next(z for z in candidate.fits[of].zones if z.zone == name)


# ---------------------------------------------------------------- the gate


def test_the_length_gate_holds_whatever_else_fits() -> None:
    short, long, good = last("a", 267.9), last("b", 286.1), last("c", 274, 30, ball_girth=250)
    found = answer(short, long, good)
    assert [c.last for c in found.candidates] == ["c"]
    assert dict(found.rejected) == {"too_long": 1, "too_short": 1}


@given(st.floats(-80, 80), st.sampled_from(["sure", "low", "undecided"]))
@settings(deadline=None, max_examples=40)
def test_no_confidence_switches_the_gate_off(room_mm: float, word: str) -> None:
    shape = foot()
    side = replace(shape.aligned.alignment.side, confidence=word)
    alignment = replace(shape.aligned.alignment, side=side)
    unsure = replace(shape, aligned=replace(shape.aligned, alignment=alignment))
    found = answer(last("a", 260.0 + room_mm), feet=(unsure,))
    assert bool(found.candidates) == (8.0 <= 260.0 + room_mm - 260.0 <= 26.0)


def test_a_ball_that_was_not_found_is_taken_where_balls_lie() -> None:
    least, most = measure_named("ball_length").usual_share or (0.0, 0.0)
    assert least < BALL_SHARE < most


def test_a_ball_line_over_four_percent_off_is_a_reject() -> None:
    limit_mm = 0.04 * 260.0 + 2.0 * SD_MM * 2**0.5  # a reject is sure
    near = last("near", ball_length=188.0 + limit_mm - 0.1)
    over, under = (
        last("over", ball_length=188.0 + limit_mm + 0.1),
        last("under", ball_length=188.0 - limit_mm - 0.1),
    )
    found = answer(near, over, under)
    assert [c.last for c in found.candidates] == ["near"]
    assert dict(found.rejected) == {"ball_line_too_far_back": 1, "ball_line_too_far_forward": 1}


def test_a_last_whose_length_is_not_known_is_left_out_and_said() -> None:
    whole = last("whole")
    rows = {row.name: row for row in whole.measures}
    rows["length"] = Measure("length", Measured(None, reason="open at the toes"), "length/1")
    cut = replace(last("cut"), measures=tuple(rows.values()))
    assert (cut.length_mm, cut.length.reason) == (None, "open at the toes")
    found = answer(whole, cut)
    assert [c.last for c in found.candidates] == ["whole"]
    assert dict(found.rejected) == {"length_unknown": 1}
    nothing = answer(cut, last("short", 250.0))
    assert [c.last for c in nothing.nearest] == ["short"]
    assert dict(nothing.rejected) == {"length_unknown": 1, "too_short": 1}
    (alone,) = answer(cut, by="flare").candidates
    assert zone(alone, "length").clearance == Measured(None, reason="the last: open at the toes")
    assert "not known" in answer(cut, by="shape").candidates[0].why


# ---------------------------------------------------------------- verdicts


@pytest.mark.parametrize(
    ("girth_mm", "verdict"),
    [(240, "good"), (244, "good"), (235, "acceptable"), (231, "poor"), (222, "reject")],
)
def test_the_verdict_is_the_worst_zone(girth_mm: float, verdict: str) -> None:
    found = answer(last("a", ball_girth=girth_mm))
    (one,) = found.candidates or found.nearest
    assert one.verdict == verdict
    assert zone(one, "ball_girth").verdict == verdict
    assert zone(one, "length").verdict == "good"


def test_the_verdict_comes_first_whatever_the_toe_room_says() -> None:
    found = answer(last("long", 281.0), last("tight", 275.0, ball_girth=231.0))
    assert [c.last for c in found.candidates] == ["long", "tight"]
    assert [c.verdict for c in found.candidates] == ["acceptable", "poor"]
    why = found.candidates[1].why
    assert why.endswith(
        "ball girth: 9.0 mm smaller than the foot (wanted: the same), behind long by that"
    )


def test_among_equal_verdicts_a_good_toe_room_comes_first() -> None:
    wide = last("wide", 276.5, ball_girth=247.5, ball_width=104.0, heel_width=69.0)
    found = answer(last("long", 280.5), wide)
    assert [c.verdict for c in found.candidates] == ["acceptable", "acceptable"]
    assert [c.last for c in found.candidates] == ["wide", "long"]
    assert found.candidates[0].distance > found.candidates[1].distance
    assert found.candidates[1].why == "20.5 mm toe room (wanted: 14 mm): further off than wide"


def test_a_last_that_was_not_judged_in_full_stands_behind_its_verdict() -> None:
    found = answer(last("lacking", ball_girth=None), last("long", 281.0, ball_girth=246.0))
    assert [c.last for c in found.candidates] == ["long", "lacking"]
    assert [c.verdict for c in found.candidates] == ["acceptable", "acceptable"]
    assert found.candidates[1].why == "14.0 mm toe room (wanted: 14 mm); not judged: ball girth"
    assert meets(found, "acceptable")


@given(st.floats(-10, 10), st.floats(-15, 15))
@settings(deadline=None, max_examples=50)
def test_the_ball_line_is_what_the_length_does_not_explain(excess: float, ball: float) -> None:
    found = ball_line_mm(np.array([ball]), np.array([14.0 + excess]), 14.0)
    carried = BALL_SHARE * excess
    inside = min(carried, 0.0) <= ball <= max(carried, 0.0)
    off = 0.0 if inside else min(abs(ball), abs(ball - carried))
    assert np.abs(found) == pytest.approx([off], abs=ROUNDING)
    shape = last("a", 274.0 + excess, ball_length=188.0 + ball)
    (near,) = answer(shape, by="flare").candidates
    percent = 100.0 * found[0] / (260.0 + answers.NOISE_MM)
    assert zone(near, "ball_line").clearance.value == pytest.approx(percent, abs=ROUNDING)


def test_a_better_verdict_ranks_before_a_nearer_distance() -> None:
    one_bad = last("one-bad", ball_girth=231)
    all_fair = last("fair", 270.5, ball_girth=234, ball_width=103, heel_width=69)
    found = answer(one_bad, all_fair)
    assert [c.verdict for c in found.candidates] == ["acceptable", "poor"]
    assert found.candidates[0].distance > found.candidates[1].distance


def test_a_missing_measure_is_said_and_never_good() -> None:
    found = answer(last("whole"), last("lacking", ball_girth=None))
    by_name = {c.last: c for c in found.candidates}
    assert by_name["whole"].verdict == "good"
    assert by_name["lacking"].verdict == "acceptable"
    assert "ball_girth" in by_name["lacking"].not_judged
    assert zone(by_name["lacking"], "ball_girth").clearance.reason == "the last: a gap"
    assert by_name["lacking"].distance > by_name["whole"].distance
    assert "not_judged" in [n.code for n in found.warnings], "instep and heel girth have no measure"


def test_lasts_that_cannot_be_judged_at_all_are_said_without_a_number() -> None:
    """The heel is higher than the model knows, and the bottom is not measured."""
    found = answer(last("pump", heel_height_mm=110.0))
    assert (found.candidates, found.nearest) == ((), ())
    assert dict(found.rejected) == {"length_unknown": 1}
    assert np.isfinite([c.distance for c in answer(last("pump"), by="flare").candidates]).all()


def test_measures_of_two_definitions_are_not_compared() -> None:
    old = last("old")
    changed = tuple(replace(m, definition="older") for m in old.measures)
    (found,) = answer(replace(old, measures=changed)).candidates
    assert "another definition" in zone(found, "ball_girth").clearance.reason


def test_the_cavity_is_taken_off_the_last() -> None:
    rules = tuple(
        replace(rule, cavity=3.0) if rule.zone == "ball_girth" else rule for rule in WALKING.zones
    )
    lined = replace(WALKING, zones=rules)
    (found,) = answer(last("a"), profile=lined).candidates
    assert zone(found, "ball_girth").clearance.value == pytest.approx(-3.0)


def test_a_clearance_is_the_last_minus_the_foot_with_both_spreads() -> None:
    (found,) = answer(last("a", ball_girth=243.5)).candidates
    clearance = dict(found.clearance_mm)
    assert clearance["ball_girth"].value == pytest.approx(3.5)
    assert clearance["ball_girth"].sd == pytest.approx(SD_MM * 2**0.5)
    assert clearance["length"].value == pytest.approx(14.0)


def test_a_measure_without_a_spread_adds_none_to_its_clearance() -> None:
    def sure(shape: Any) -> Any:
        rows = (replace(row, measured=Measured(row.measured.value)) for row in shape.measures)
        return replace(shape, measures=tuple(rows))

    for ours, theirs in ((sure(foot()), last("a")), (foot(), sure(last("a")))):
        (found,) = answer(theirs, feet=(ours,)).candidates
        assert zone(found, "ball_girth").clearance.sd == pytest.approx(SD_MM)


# ---------------------------------------------------------------- order and ties


def test_the_nearer_girth_and_the_nearer_flare_rank_first() -> None:
    assert names(*(last(f"g{g}", ball_girth=g) for g in (245, 240, 236.5, 242))) == [
        "g240",
        "g242",
        "g236.5",
        "g245",
    ]
    assert names(*(last(f"t{t}", turn_deg=t) for t in (2, 8, 5))) == ["t8", "t5", "t2"]


def test_a_difference_inside_the_uncertainty_is_a_tie_and_outside_none() -> None:
    found = answer(
        last("b", ball_girth=243.0), last("a", ball_girth=243.2), last("c", ball_girth=245)
    )
    first, second, third = found.candidates
    assert [first.last, second.last, third.last] == ["b", "a", "c"], "the best estimate first"
    assert first.tied_with == ("a",)
    assert second.tied_with == ("b",)
    assert third.tied_with == ()
    assert first.distance_sd is not None
    assert first.distance_sd > 0
    strict = replace(WALKING, tie_sds=0.0)
    apart = answer(last("b", ball_girth=243.0), last("a", ball_girth=243.2), profile=strict)
    assert all(c.tied_with == () for c in apart.candidates)


def test_equal_lasts_come_by_name() -> None:
    assert names(last("b"), last("c"), last("a")) == ["a", "b", "c"]


@given(st.permutations(range(7)))
@settings(deadline=None, max_examples=15)
def test_the_order_of_the_library_does_not_matter(order: list[int]) -> None:
    lasts = [last(f"l{i}", 268.5 + i, 4 + 3 * i, ball_girth=236 + i) for i in range(7)]
    assert names(*(lasts[i] for i in order), top=0) == names(*lasts, top=0)


def test_top_cuts_the_answer_and_not_the_ranks() -> None:
    lasts = [last(f"l{i}", ball_girth=240 + i) for i in range(6)]
    assert names(*lasts, top=2) == names(*lasts, top=0)[:2]


# ---------------------------------------------------------------- other searches


def test_by_flare_knows_no_size_and_says_so_and_still_judges() -> None:
    found = answer(last("far", 330, 8), last("near", 273, 20), by="flare")
    assert [c.last for c in found.candidates] == ["far", "near"]
    assert found.candidates[0].verdict == "reject"
    assert found.rejected == ()
    assert "scale_free" in [notice.code for notice in found.warnings]


def test_by_flare_a_tie_is_as_wide_as_two_rescans() -> None:
    found = answer(last("z"), last("y"), last("w", turn_deg=25), by="flare")
    assert set(found.candidates[0].tied_with) == {"z"}
    apart = found.candidates[-1].distance - found.candidates[0].distance
    assert apart > rescan_spread(2).difference(0, 1)


def test_by_shape_finds_length_and_width_and_judges_no_fit() -> None:
    lasts = [last(str(mm), mm) for mm in (253, 260, 267)]
    assert names(*lasts, by="shape") == ["260", "253", "267"]
    widths = [last(f"w{w}", 260, ball_width=w) for w in (94, 98, 102)]
    found = answer(*widths, by="shape")
    assert found.candidates[0].last == "w98"
    assert {c.verdict for c in found.candidates} == {None}
    for candidate in answer(*lasts, by="shape").candidates:
        shown = signed(dict(candidate.clearance_mm)["length"].value)
        assert candidate.why.startswith(f"length differs by {shown} mm")


def test_the_flare_difference_is_the_last_minus_the_foot() -> None:
    shape, one = foot(turn_deg=10.0), last("a", turn_deg=4.0)
    (found,) = answer(one, feet=(shape,), by="flare").candidates
    assert found.flare.delta_deg == pytest.approx(one.flare.angle_deg - shape.flare.angle_deg)
    assert "less inward" in found.why
    (found,) = answer(replace(one, flare=shape.flare), feet=(shape,), by="flare").candidates
    assert found.distance == pytest.approx(0.0, abs=ROUNDING)


# ---------------------------------------------------------------- sides and pairs


def test_a_pair_of_lasts_is_shown_once_on_the_foots_own_side() -> None:
    labels = {"style": "derby", "size": "42", "size_system": "eu"}
    right, left = last("r", **labels), last("l", left=True, **labels)
    other = last("only-right", **{**labels, "size": "43"})
    found = answer(right, left, other, feet=(foot(left=True),))
    assert [(c.last, c.mirrored) for c in found.candidates] == [("l", False), ("only-right", True)]


def test_the_larger_foot_of_a_pair_governs_the_length() -> None:
    small, large = foot(255.0, left=True), foot(262.0)
    for feet in ((small, large), (large, small)):
        found = answer(last("a", 268), last("b", 275), feet=feet)
        assert [c.last for c in found.candidates] == ["b"]
        governs = [zone(found.candidates[0], "length", i).counts for i in (0, 1)]
        assert governs == [foot is large for foot in feet]


def test_the_wider_foot_of_a_pair_counts_too() -> None:
    pair = (foot(left=True, ball_girth=252.0), foot())
    (found,) = answer(last("a"), feet=pair).candidates
    assert found.verdict == "poor"
    assert [fit.verdict for fit in found.fits] == ["poor", "good"]
    assert found.fits[0].side == "left"


def test_a_pair_that_differs_by_a_size_is_advised() -> None:
    feet = (foot(254.0, left=True), foot(262.0))
    (notice,) = [n for n in answer(last("a", 275), feet=feet).warnings if "differ" in n.code]
    assert notice.code == "feet_differ_by_a_size"
    assert "right foot is 8.0 mm longer" in notice.message
    assert "EU 41 and EU 40" in notice.message
    near = answer(last("a", 275), feet=(foot(261.0, left=True), foot(262.0))).warnings
    assert "pair_difference" in [n.code for n in near]


def test_feet_that_differ_by_less_than_a_millimetre_are_equally_long() -> None:
    for apart_mm, words in ((0.6, "equally long"), (0.94, "equally long"), (1.0, "1.0 mm longer")):
        feet = (foot(262.0 - apart_mm, left=True), foot(262.0))
        (notice,) = [n for n in answer(last("a", 275), feet=feet).warnings if "differ" in n.code]
        assert words in notice.message


def test_what_does_not_count_says_why() -> None:
    pair = (foot(255.0, left=True), foot(262.0))
    best = answer(last("a", 275), feet=pair).candidates[0]
    assert zone(best, "length", 0).not_counted == "the right foot decides this"
    assert zone(best, "length", 1).not_counted is None
    shown = replace(
        WALKING,
        zones=tuple(replace(r, weight=r.weight * (r.zone != "flare")) for r in WALKING.zones),
    )
    (best,) = answer(last("a"), profile=shown).candidates
    assert zone(best, "flare").not_counted == "the fit profile only shows this zone"
    text = terminal_text(match_table(answer(last("a", 275), feet=pair)), 200)
    assert "left not judged: the right foot decides this" in text


def test_a_pair_has_one_size_and_lasts_have_the_system_asked_for() -> None:
    pair = (foot(251.5, left=True), foot(252.1))
    found = answer(last("a", 265, size="40"), feet=pair, size_system="uk")
    text = terminal_text(match_table(found), 200)
    assert text.count("size UK") == 1
    assert "EU 40 G (UK 7)" in text
    assert found.candidates[0].size_asked == "UK 7"
    assert found.to_dict()["sizes"]["uk"]["words"] == "UK 7"


# ---------------------------------------------------------------- reasons


def test_a_number_has_a_digit_more_where_it_decides() -> None:
    """9.96 mm of toe room is not good: 10.0 beside "acceptable" would contradict the profile."""
    found = answer(last("short", 269.96), last("good", 270.04))
    assert [c.verdict for c in found.candidates] == ["good", "acceptable"]
    good, short = found.candidates
    assert good.why.startswith("10.0 mm toe room")
    assert short.why.startswith("9.96 mm toe room")
    text = terminal_text(match_table(found), 200)
    assert "+9.96" in text
    miss = answer(last("out", 267.97)).nearest[0]
    assert miss.why == "7.97 mm toe room (wanted: 14 mm), 0.03 mm past the limit"


def test_the_first_is_said_by_its_worst_zone() -> None:
    (found,) = answer(last("a", ball_girth=237.0)).candidates
    room, worst = found.why.split("; ")
    assert room == "14.0 mm toe room (wanted: 14 mm)"
    assert worst == "ball girth: 3.0 mm smaller than the foot (wanted: the same)"
    (found,) = answer(last("a")).candidates
    assert found.why.endswith("near the target in every zone judged")


def test_the_next_is_said_by_what_puts_it_behind_the_first() -> None:
    found = answer(last("best"), last("wide", ball_width=101.0), last("long", 279.0))
    why = {c.last: c.why for c in found.candidates}
    assert why["wide"].endswith(
        "ball width: 3.0 mm wider than the foot (wanted: 1 mm wider), behind best by that"
    )
    assert why["long"] == "19.0 mm toe room (wanted: 14 mm): further off than best"


def test_where_nothing_fits_the_nearest_three_say_what_they_miss_by() -> None:
    lasts = (last("a", 250), last("b", 262), last("c", 300), last("d", 294))
    found = answer(*lasts)
    assert found.candidates == ()
    assert [c.last for c in found.nearest] == ["b", "d", "c"]
    assert {c.verdict for c in found.nearest} == {"reject"}
    assert found.nearest[0].why == "2.0 mm toe room (wanted: 14 mm), 6.0 mm past the limit"
    assert "nothing_fits" in [n.code for n in found.warnings]


def test_a_check_asks_for_the_first_last() -> None:
    good, fair, none = answer(last("a")), answer(last("a", 282)), answer(last("a", 300))
    assert [meets(m, "good") for m in (good, fair, none)] == [True, False, False]
    assert [meets(m, "acceptable") for m in (good, fair, none)] == [True, True, False]
    by_flare = answer(last("far", 330, 8), last("near", 273, 9), by="flare", top=0)
    assert [c.verdict for c in by_flare.candidates] == ["reject", "good"]
    assert not meets(by_flare, "acceptable"), "the first row is what a reader takes"


def test_the_profile_is_in_the_answer_with_its_hash() -> None:
    found = answer(last("a"), profile=fit_profile("dress"))
    assert found.profile == "dress"
    assert found.fit_profile == fit_profile("dress")


# ---------------------------------------------------------------- the library


def test_no_last_at_all_is_an_error() -> None:
    with pytest.raises(NoCandidate):
        answer()


def test_a_size_system_that_no_last_has_ranks_all_and_says_so(stocked: Any) -> None:
    found = choice(stocked, None, "us-women")
    assert found.names
    assert [notice.code for notice in found.warnings] == ["other_systems"]
    assert choice(stocked, None, "EU").warnings == ()
    with pytest.raises(BadOption, match=r"'shop size'.*there are eu, uk, us-men"):
        choice(stocked, None, "shop size")


def test_a_size_system_of_the_shops_own_is_one_where_a_last_is_labelled_in_it(
    stocked: Any, tmp_path: Path
) -> None:
    path = tmp_path / "own.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("a", size="7", size_system="house"), records.mesh_copy(1))
    assert choice(path, None, "house").names == ("a",)
    assert not choice(path, "no such style", "house").names


def test_lasts_that_were_measured_otherwise_are_said(stocked: Any, tmp_path: Path) -> None:
    path = tmp_path / "older.footfit"
    shutil.copy(stocked, path)
    assert choice(path, None, None).warnings == ()
    with open_catalogue(path, write=True) as catalogue:
        (old,) = (one for one in catalogue.lasts().records if one.labels.name == "derby-40")
        rows = [replace(row, definition=f"{row.name}/0") for row in old.measures]
        older = replace(old, measures=tuple(rows))
        catalogue.add(older, catalogue.mesh_copy("derby-40"), replace=True)
    (notice,) = choice(path, None, None).warnings
    assert notice.code == "other_measures"
    assert notice.message.startswith("derby-40 was measured by other definitions")


def test_a_last_that_is_searched_for_is_as_long_as_itself(stocked: Any) -> None:
    """Along its bottom, as every last of the library: the heel is no clearance.

    The stored last stands by its label, at 25 mm of heel, and the mesh by its shape, at 22.3 mm.
    That is 0.309 mm of length.
    """
    found = choice(stocked, None, None)
    path = SAMPLES / "lasts" / "derby-40.stl"
    mesh = profiled_source(Source(str(path)), ReadingOptions())
    best = matched([mesh], found, Question(by="shape")).candidates[0]
    assert best.last == "derby-40"
    assert dict(best.clearance_mm)["length"].value == pytest.approx(0.0, abs=0.35)


def test_what_was_not_judged_passes_no_check_and_is_said() -> None:
    found = answer(last("a"), feet=(foot(ball_girth=None),))
    (candidate,) = found.candidates
    assert candidate.verdict == "acceptable"
    assert candidate.why.endswith("; not judged: ball girth")
    assert found.best_verdict is None
    assert not meets(found, "acceptable")
    assert meets(answer(last("a")), "acceptable")
    assert "not judged" not in answer(last("a")).candidates[0].why


def test_feet_that_are_hardly_of_one_customer_are_said() -> None:
    pair = (foot(left=True), foot(length_mm=239.0))
    found = answer(last("a"), feet=pair)
    (said,) = [one.message for one in found.warnings if one.code == "pair_differs_widely"]
    assert said.startswith("the left foot is 21.0 mm longer")
    same = answer(last("a"), feet=(foot(), foot(length_mm=239.0))).warnings
    assert any(one.message.startswith("the longer foot is 21.0") for one in same)


def test_a_last_that_is_taken_for_a_foot_is_said() -> None:
    shape = foot()
    pose = replace(shape.aligned.alignment.pose, kind="last")
    alignment = replace(shape.aligned.alignment, pose=pose)
    scanned = replace(shape, aligned=replace(shape.aligned, alignment=alignment))
    for by, expected in (("fit", True), ("flare", True), ("shape", False)):
        codes = {one.code for one in answer(last("a"), feet=(scanned,), by=by).warnings}
        assert ("looks_like_a_last" in codes) is expected


def test_what_is_surely_a_last_is_matched_as_a_foot_only_if_that_is_forced() -> None:
    shape = foot()
    pose = replace(shape.aligned.alignment.pose, kind="last")
    alignment = replace(shape.aligned.alignment, pose=pose)
    prepared = replace(shape.aligned.prepared, kind_margin=1.1 * SURE_KIND)
    scanned = replace(shape, aligned=replace(shape.aligned, alignment=alignment, prepared=prepared))
    for by in ("fit", "flare"):
        with pytest.raises(OtherKind, match="surely a last"):
            answer(last("a"), feet=(scanned,), by=by)
        codes = {
            n.code for n in answer(last("a"), feet=(scanned,), by=by, force_foot=True).warnings
        }
        assert "looks_like_a_last" in codes
    assert answer(last("a"), feet=(scanned,), by="shape").candidates


def test_where_no_length_is_known_no_last_is_shown_and_that_is_said() -> None:
    cut = replace(last("cut"), measures=measures(length=None, **LAST))
    found = answer(cut)
    assert (found.candidates, found.nearest) == ((), ())
    assert dict(found.rejected) == {"length_unknown": 1}
    (notice,) = [n for n in found.warnings if n.code == "nothing_fits"]
    assert "the length of no last is known" in notice.message
    assert "1 of unknown length" in match_page(found)
    assert "1 of unknown length" in terminal_text(match_table(found))
    assert best_comparison(Path("none.footfit"), found) is None
