"""The foot in the heel: the model's values, its uncertainty, its words, and where it ends."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from footfit.errors import BadOption, BadProfile
from footfit.geometry.fit.along_the_bottom import (
    ALONG_BOTTOM,
    LastLengths,
    length_along_bottom,
)
from footfit.pipeline.fit.heel_model import FILE, heel_model, heel_model_of, heel_question
from footfit.pipeline.fit.heels import heel_change, heels_of
from footfit.pipeline.fit.judging.bottom_gains import LENGTHS
from footfit.pipeline.fit.match import Question, matched, meets
from footfit.pipeline.fit.scoring import distance_spread, fit_distance, scores
from footfit.results import Candidate, HeelQuestion, LastRecord, Match, Measure, Measured
from footfit.results.heel import AS_SCANNED, FLARE
from tests import answers
from tests.bounds import EXACT, ROUNDING
from tests.test_pipeline_fit import COLUMNS
from tests.test_pipeline_match import FOOT, SD_MM, foot, last, library, measures, zone

HEEL = heel_question()
TABLE = {
    "length": (-1.5, 1.0),
    "ball_length": (-1.5, 1.0),
    "ball_width": (-1.5, 1.5),
    "ball_girth": (0.5, 1.5),
    "waist_girth": (1.0, 1.5),
    "instep_girth": (1.0, 1.5),
    "short_heel_girth": (0.0, 2.0),
    "long_heel_girth": (0.0, 2.0),
    "heel_width": (-1.0, 2.0),
    "arch_height": (8.0, 8.0),
}
"""The published table: percent of the measure at 80 mm, and its standard deviation."""
SHARES = ((0.0, 0.0), (40.0, 0.5), (80.0, 1.0), (100.0, 1.25), (118.0, 1.25))
"""Drops in mm, and how much of the table they take: over 100 mm it grows no more."""
WHOLE = FOOT | {"waist_girth": 235.0, "instep_girth": 245.0, "arch_height": 11.0}
WHOLE |= {"short_heel_girth": 320.0, "long_heel_girth": 340.0}


def heeled(name: str, drop_mm: float | None, **more: Any) -> LastRecord:
    """A last whose label says its heel, and that is as long along its bottom as its length says."""
    record = last(name, heel_height_mm=drop_mm, **more)
    if drop_mm is None:
        return record
    lengths = bottom_of(record.length_mm or 0.0, drop_mm)
    rows = tuple(
        Measure(key, Measured(value, SD_MM), LENGTHS[key]) for key, value in asdict(lengths).items()
    )
    return replace(record, measures=record.measures + rows)


def bottom_of(length_mm: float, heel_mm: float) -> LastLengths:
    """The measures of a last that is ``length_mm`` along its bottom."""
    stick_mm = length_mm - heel_mm**2 / (1.2 * length_mm)
    drawn = LastLengths(
        bottom_length=length_mm,
        stick_length=stick_mm,
        heel_height=heel_mm,
        seat_angle_deg=0.25 * heel_mm,
        tread_from=0.6 * stick_mm,
        tread_to=0.8 * stick_mm,
        toe_spring_tip=6.0,
    )

    def off_mm(bottom_mm: float) -> float:
        return (
            length_along_bottom(length_mm, replace(drawn, bottom_length=bottom_mm))[0] - length_mm
        )

    high = heel_mm > ALONG_BOTTOM.level_mm
    return (
        replace(drawn, bottom_length=brentq(off_mm, 0.5 * length_mm, 1.5 * length_mm))
        if high
        else drawn
    )


def bottom_sd_mm(length_mm: float, heel_mm: float) -> float:
    """How unsure its length along the bottom is."""
    return length_along_bottom(length_mm, bottom_of(length_mm, heel_mm))[1]


def answer(*lasts: LastRecord, heel: HeelQuestion = HEEL, **more: Any) -> Match:
    feet = more.pop("feet", (foot(),))
    return matched(feet, library(*lasts), Question(heel=heel, **more))


def the_last(record: LastRecord, **more: Any) -> Candidate:
    found = answer(record, **more)
    (only,) = found.candidates or found.nearest
    return only


# ---------------------------------------------------------------- the table


@pytest.mark.parametrize(("drop_mm", "share"), SHARES)
def test_a_measure_changes_by_the_table(drop_mm: float, share: float) -> None:
    shape = foot(**WHOLE)
    change = heel_change(heels_of(HEEL, [heeled("a", drop_mm)]), 0, shape)
    assert change is not None
    assert change.share == pytest.approx(share, abs=EXACT)
    size_mm = {"length": 260.0} | WHOLE
    assert {name for name, _ in change.changes} == {*TABLE, FLARE}
    for name, (percent, sd) in TABLE.items():
        known = change.change_of(name)
        assert known.value == pytest.approx(share * percent * 0.01 * size_mm[name], abs=EXACT)
        assert known.sd == pytest.approx(share * sd * 0.01 * size_mm[name], abs=EXACT)
    turn = change.change_of(FLARE)
    assert (turn.value, turn.sd) == pytest.approx((2.0 * share, 2.0 * share), abs=EXACT)


@pytest.mark.parametrize(("drop_mm", "share"), SHARES[:4])
def test_every_zone_compares_the_foot_as_it_is_in_the_heel(drop_mm: float, share: float) -> None:
    found = the_last(heeled("a", drop_mm))
    expected = {
        "length": 14.0 + 0.015 * share * 260.0,
        "ball_girth": 240.0 - 240.0 * (1.0 + 0.005 * share),
        "ball_width": 99.0 - 98.0 * (1.0 - 0.015 * share),
        "heel_width": 60.0 - 62.0 * (1.0 - 0.010 * share),
        "flare": -2.0 * share,
    }
    scan_sd = {"length": 0.5, "flare": 0.21}
    model_sd = {"length": 2.6, "ball_girth": 3.6, "ball_width": 1.47, "heel_width": 1.24}
    for name, value in expected.items():
        clearance = zone(found, name).clearance
        assert clearance.value == pytest.approx(value, abs=ROUNDING), name
        bottom_sd = bottom_sd_mm(274.0, drop_mm) if name == "length" else 0.0
        scan = np.hypot(2.0**0.5 * scan_sd.get(name, SD_MM), bottom_sd)
        sd = np.hypot(scan, share * model_sd.get(name, 2.0))
        assert clearance.sd == pytest.approx(sd, abs=ROUNDING), name
    assert found.flare.delta_deg == pytest.approx(-2.0 * share, abs=ROUNDING)


def test_the_ball_line_is_that_of_the_shorter_foot() -> None:
    """Foot and ball shorten together, and what the length explains is no fault of the ball."""
    found = the_last(heeled("a", 40.0))
    room_mm, ball_mm = 14.0 + 0.0075 * 260.0, 0.0075 * 188.0
    explained = min(ball_mm, 0.72 * (room_mm - 14.0))
    percent = 100.0 * (ball_mm - explained) / (260.0 + answers.NOISE_MM)
    assert zone(found, "ball_line").clearance.value == pytest.approx(percent, abs=ROUNDING)


def test_the_ball_line_of_a_high_heel_is_not_judged() -> None:
    """Along X the ball of one last moves by up to 23 mm as the last is bent."""
    found = the_last(heeled("a", 41.0))
    reason = "over 40 mm of heel the ball's place along the bottom is unknown"
    assert zone(found, "ball_line").clearance.reason == reason
    assert (found.verdict, zone(found, "ball_line").verdict) == ("good", None)


def test_a_low_last_hardly_changes_and_an_unknown_heel_not_at_all() -> None:
    low, unknown = the_last(heeled("a", 10.0)), the_last(heeled("a", None))
    assert zone(low, "length").clearance.value == pytest.approx(14.0, abs=0.5)
    assert zone(low, "ball_girth").clearance.value == pytest.approx(0.0, abs=0.2)
    assert zone(unknown, "length").clearance.value == pytest.approx(14.0, abs=ROUNDING)
    assert unknown.fits[0].heel.drop_mm is None
    assert "drop" not in low.why + unknown.why


def test_the_label_says_the_drop_else_the_measure() -> None:
    rows = (*measures(heel_height=52.0), Measure("length", Measured(274.0), "length/1"))
    record = replace(last("a"), measures=rows)
    assert record.drop_mm == 52.0
    labels = replace(record.labels, heel_height_mm=47.0)
    assert replace(record, labels=labels).drop_mm == 47.0
    assert replace(record, labels=replace(labels, platform_mm=12.0)).drop_mm == 35.0
    assert last("a").drop_mm is None


# ---------------------------------------------------------------- as scanned


@pytest.mark.parametrize("by", ["fit", "flare"])
def test_as_scanned_is_what_was_measured(by: str) -> None:
    found = the_last(heeled("a", 60.0), heel=AS_SCANNED, by=by)
    flat = the_last(heeled("a", None), heel=AS_SCANNED, by=by)
    for here, there in zip(found.fits[0].zones, flat.fits[0].zones, strict=True):
        if here.zone == "ball_line":  # it is not judged on a high heel
            assert here.clearance.value is None
            continue
        if there.clearance.value is None:
            assert here.clearance == there.clearance
            continue
        assert here.clearance.value == pytest.approx(there.clearance.value, abs=ROUNDING)
        bottom_sd = bottom_sd_mm(274.0, 60.0) if here.zone == "length" else 0.0
        sd = np.hypot(there.clearance.sd, bottom_sd)
        assert here.clearance.sd == pytest.approx(sd, abs=EXACT)
    assert found.why == flat.why
    assert found.fits[0].heel is None
    assert answer(heeled("a", 60.0), heel=AS_SCANNED).to_dict()["heel_model"] is None


def test_a_search_by_shape_changes_nothing() -> None:
    found = answer(heeled("a", 80.0), by="shape")
    assert found.heel == AS_SCANNED
    assert dict(found.candidates[0].clearance_mm)["length"].value == pytest.approx(14.0)


def test_a_foot_that_was_scanned_in_the_heel_is_not_changed_again() -> None:
    """Only what the drops differ by is applied, also backwards: a flat last widens the foot."""
    raised = heel_question(scanned_at_drop_mm=60.0)
    drops = {0.0: -0.75, 40.0: -0.25, 60.0: 0.0, 80.0: 0.25, 100.0: 0.5}
    for drop_mm, share in drops.items():
        found = the_last(heeled("a", drop_mm), heel=raised)
        assert found.fits[0].heel.share == pytest.approx(share, abs=EXACT)
        girth_mm = 240.0 * 0.005 * share
        assert zone(found, "ball_girth").clearance.value == pytest.approx(-girth_mm, abs=ROUNDING)
        sd = np.hypot(2.0**0.5 * SD_MM, share * 3.6)
        assert zone(found, "ball_girth").clearance.sd == pytest.approx(sd, abs=ROUNDING)
    assert "longer" in the_last(heeled("a", 0.0), heel=raised).why
    assert "drop" not in the_last(heeled("a", 60.0), heel=raised).why
    high = heel_question(scanned_at_drop_mm=112.0)
    assert zone(the_last(heeled("a", 114.0), heel=high), "ball_girth").verdict == "good"
    assert zone(the_last(heeled("a", 0.0), heel=high), "ball_girth").verdict is None


@pytest.mark.parametrize("options", [{"as_scanned": True, "scanned_at_drop_mm": 0.0}])
def test_two_answers_to_one_question_are_refused(options: dict[str, Any]) -> None:
    with pytest.raises(BadOption, match="leave out one"):
        heel_question(**options)
    for drop_mm in (-1.0, 121.0, float("nan")):
        with pytest.raises(BadOption, match="takes 0 to 120 mm"):
            heel_question(scanned_at_drop_mm=drop_mm)


# ---------------------------------------------------------------- how sure


@pytest.mark.parametrize(("drop_mm", "unproven"), [(25.0, False), (29.9, False), (30.0, True)])
def test_from_30_mm_of_drop_the_model_is_said_to_be_unproven(
    drop_mm: float, unproven: bool
) -> None:
    found = the_last(heeled("a", drop_mm))
    assert f"at a drop of {drop_mm:.0f} mm the foot counts as" in found.why
    assert ("unproven model" in found.why) is unproven
    assert found.fits[0].heel.unproven is unproven


def test_the_sentence_says_what_was_changed() -> None:
    words = "at a drop of 60 mm the foot counts as 2.9 mm shorter, ball girth 0.9 mm larger"
    assert f"; {words} (unproven model)" in the_last(heeled("a", 60.0)).why
    assert the_last(heeled("a", 25.0)).why.endswith("the foot counts as 1.2 mm shorter")
    small = answer(heeled("a", 30.0, length_mm=173.0), feet=(foot(160.0, ball_length=116.0),))
    (child,) = small.candidates or small.nearest
    assert "0.9 mm shorter (unproven model)" in child.why
    turned = the_last(heeled("a", 40.0), by="flare").why
    assert "counts as turned 1.0 deg more inward (unproven model)" in turned
    missed = answer(heeled("a", 60.0, length_mm=250.0)).nearest[0].why
    assert words in missed


def test_over_100_mm_only_the_length_is_judged() -> None:
    found = answer(heeled("a", 101.0))
    (high,) = found.candidates
    judged = [each.zone for each in high.fits[0].zones if each.verdict is not None]
    assert judged == ["length"]
    reason = zone(high, "ball_girth").clearance.reason
    assert reason == "over 100 mm of drop only the length is judged"
    assert "ball_girth" in high.not_judged
    assert high.verdict == "acceptable"
    assert high.why.endswith("(unproven model) and only the length is judged")
    assert not meets(found, "acceptable"), "what is not known is no pass"
    assert zone(the_last(heeled("a", 100.0)), "ball_girth").verdict == "good"
    both = answer(heeled("high", 101.0), heeled("low", 5.0)).candidates
    assert [candidate.last for candidate in both] == ["low", "high"]


def test_a_high_heel_is_judged_by_the_foot_that_stands_in_it() -> None:
    """Each last is made for the foot at its own drop; as scanned, the high one is too short."""
    share = 100.0 / 80.0
    made = {
        "length_mm": 260.0 * (1.0 - 0.015 * share) + 14.0,
        "ball_length": 188.0 * (1.0 - 0.015 * share),
        "ball_width": 98.0 * (1.0 - 0.015 * share) + 1.0,
        "ball_girth": 240.0 * (1.0 + 0.005 * share),
        "heel_width": 62.0 * (1.0 - 0.010 * share) - 2.0,
        "turn_deg": 8.0 + 2.0 * share,
    }
    high = heeled("high", 100.0, **made)
    lasts = [high, heeled("low", 5.0), heeled("low-wide", 5.0, ball_girth=250.0)]
    found = {candidate.last: candidate for candidate in answer(*lasts).candidates}
    assert found["high"].verdict == "good"
    assert found["high"].distance < 0.2  # its ball line is not judged and counts as 1
    assert found["low-wide"].rank == 3
    assert found["high"].distance_sd > 2.0 * found["low"].distance_sd, "the model is unsure"
    as_scanned = {c.last: c for c in answer(*lasts, heel=AS_SCANNED).candidates}
    assert zone(as_scanned["high"], "length").verdict == "acceptable"


def test_a_reject_must_be_sure_in_the_heel_too() -> None:
    """20 mm too wide: sure of a low last, not of one whose heel makes the girth unsure by 4 mm."""
    low, high = (heeled("a", drop_mm, ball_girth=240.0 + 20.5) for drop_mm in (0.0, 90.0))
    assert zone(the_last(low), "ball_girth").verdict == "reject"
    assert zone(the_last(high), "ball_girth").verdict == "poor"


def test_one_error_of_the_model_moves_all_lasts() -> None:
    """Against draws: it moves a last by the share of its own heel, and a flat one not at all."""
    rng, draws = np.random.default_rng(3), 4000
    rows = np.array([[15.1, 2.3, -1.1], [15.1, 2.3, -1.1], [14.0, -2.0, 0.5]])
    heel_sd = np.array([0.0, 0.5, 1.0])[:, None] * np.array([[0.9, 1.1, 0.7]])
    nothing = np.zeros_like(rows)
    spread = distance_spread(scores(rows, nothing, nothing, COLUMNS, heel_sd))
    noisy = rows + rng.normal(size=(draws, 1, 3)) * heel_sd
    drawn = fit_distance(scores(noisy.reshape(-1, 3), *np.zeros((2, 3 * draws, 3)), COLUMNS))
    distances = drawn.reshape(draws, 3)
    # to first order only, as in tests/test_pipeline_fit.py
    assert spread.alone() == pytest.approx(distances.std(axis=0), rel=0.2, abs=0.01)
    for i, j in ((0, 1), (1, 2), (0, 2)):
        apart = (distances[:, i] - distances[:, j]).std()
        assert spread.difference(i, j) == pytest.approx(apart, rel=0.2, abs=0.01)


# ---------------------------------------------------------------- documents


def test_the_document_has_the_model_and_what_it_changed() -> None:
    found = answer(heeled("a", 60.0), heel=heel_question(scanned_at_drop_mm=20.0)).to_dict()
    assert found["heel_model"]["name"] == "flat-to-heel"
    assert found["heel_model"]["sha256"] == heel_model().sha256
    assert found["heel_model"]["rules"]["ball_girth"]["change"] == pytest.approx(0.005)
    heel = found["candidates"][0]["fits"][0]["heel"]
    assert (heel["drop_mm"], heel["scanned_at_drop_mm"], heel["share"]) == (60.0, 20.0, 0.5)
    assert heel["model"] == f"flat-to-heel/{heel_model().version}"
    length = heel["changes_mm"]["length"]
    assert (length["value"], length["sd"], length["reason"]) == (-1.95, 1.3, None)
    assert heel["flare_change_deg"]["value"] == 1.0
    (row,) = answer(heeled("a", 60.0)).rows()
    assert (row["drop_mm"], row["heel_model"]) == (60.0, "flat-to-heel/1")
    assert row["heel_change_length_mm"] == pytest.approx(-2.925)
    assert row["heel_change_flare_deg"] == pytest.approx(1.5)
    assert row["heel_change_instep_girth_mm"] is None


def test_a_pair_has_what_was_changed_of_each_foot() -> None:
    feet = (foot(255.0, left=True), foot(262.0))
    (found,) = answer(heeled("a", 40.0, length_mm=275.0), feet=feet).candidates
    lengths = [fit.heel.change_of("length").value for fit in found.fits]
    assert lengths == pytest.approx([-0.0075 * 255.0, -0.0075 * 262.0])
    assert "2.0 mm shorter" in found.why, "of the foot that governs"


# ---------------------------------------------------------------- the file


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('schema = "footfit.heel-model/1"', 'schema = "footfit.heel-model/9"', "schema must be"),
        ("version = 1", "version = 1.5", "version must be a whole number"),
        ("full_drop_mm = 80", "full_drop_mm = 0", "full_drop_mm must be between"),
        ("unproven_from_mm = 30", "unproven_from_mm = 90", "must not fall"),
        ("[measures.length]", "[measures.lenght]", "has no [measures.length]"),
        ("[measures.heel_width]", "[measures.heel_wdth]", "is no measure of footfit"),
        ("change_deg = 2.0", "change_percent = 2.0", "did you mean change_deg"),
        ("change_percent = 8.0", "change_percent = 80.0", "must be between -20 and 20"),
        ("sd_percent = 8.0", "sd_percent = -1.0", "must be between 0 and 20"),
        ("sd_percent = 8.0", "", "sd_percent must be a number"),
        ('why = "Load takes 15-20 %."', "", "why must be a short text"),
        ('source = "', "source = '", "is not valid TOML"),
    ],
)
def test_what_is_wrong_with_a_model_is_said(old: str, new: str, words: str) -> None:
    text = FILE.read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(BadProfile) as caught:
        heel_model_of(text.replace(old, new, 1), "mine.toml")
    assert words in caught.value.message


def test_the_hash_is_of_the_values() -> None:
    text = FILE.read_text(encoding="utf-8")
    assert heel_model_of(f"# another comment\n{text}").sha256 == heel_model().sha256
    other = heel_model_of(text.replace("full_drop_mm = 80", "full_drop_mm = 75"))
    assert other.sha256 != heel_model().sha256
