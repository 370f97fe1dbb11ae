"""What is worn shifts what is asked; it never rewrites a measure, and nothing counts twice."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.errors import BadOption, BadProfile
from footfit.pipeline.fit.fit_profile import fit_profile, profile_of
from footfit.pipeline.fit.worn_shifts import (
    TO_HALF_LOAD,
    check_worn,
    shifted_rule,
    worn_with,
    zone_shift,
)
from footfit.results import Worn
from tests.conftest import Footfit
from tests.test_pipeline_profile import PLAIN

STANDING = Worn(load="half", time="evening")


@given(t=st.floats(0.1, 5.0))
def test_a_sock_takes_its_offset_of_a_convex_section(t: float) -> None:
    """By Steiner's formula the girth of an offset convex section grows by 2 pi t."""
    angle = np.linspace(0.0, 2.0 * np.pi, 20_001)
    foot = np.column_stack([45.0 * np.cos(angle), 30.0 * np.sin(angle)])
    along = np.gradient(foot, axis=0)
    normal = np.column_stack([along[:, 1], -along[:, 0]])
    sock = foot + t * normal / np.linalg.norm(normal, axis=1, keepdims=True)
    girths = [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in (foot, sock)]
    shift = zone_shift("ball_girth", float(girths[0]), replace(STANDING, sock_mm=t))
    assert shift.more == pytest.approx(girths[1] - girths[0], rel=1e-3)
    for zone in ("length", "ball_width", "heel_width", "toe_height"):
        assert zone_shift(zone, 90.0, replace(STANDING, sock_mm=t)).more == pytest.approx(2.0 * t)
    assert zone_shift("toes", None, replace(STANDING, sock_mm=t)).more == pytest.approx(t)


def test_an_insole_takes_girth_and_height_and_no_length() -> None:
    worn = replace(STANDING, insole_mm=4.0)
    asked = {
        "length": 0.0,
        "ball_width": 0.0,
        "heel_width": 0.0,
        "toe_height": 4.0,
        "ball_girth": 7.0,
    }
    for zone, more in asked.items():
        assert zone_shift(zone, 100.0, worn).more == pytest.approx(more), zone


@pytest.mark.parametrize(
    ("zone", "load", "share", "sd"),
    [
        ("length", "air", 0.015, 0.007),
        ("length", "sitting", 0.0075, 0.014),
        ("length", "full", -0.003, 0.003),
        ("ball_width", "air", 0.03, 0.02),
        ("heel_width", "air", 0.06, 0.04),
        ("ball_girth", "full", -0.005, 0.01),
        ("ball_girth", "half", 0.0, 0.0),
        ("toe_height", "air", 0.0, 0.0),
    ],
)
def test_load_brings_a_measure_to_half_load(zone: str, load: str, share: float, sd: float) -> None:
    shift = zone_shift(zone, 200.0, Worn(load=load, time="evening"))
    assert shift.more == pytest.approx(200.0 * share)
    assert shift.sd == pytest.approx(200.0 * sd)


def test_unknown_load_and_time_are_only_unsure() -> None:
    shift = zone_shift("ball_girth", 240.0, Worn())
    assert shift.more == 0.0
    assert shift.sd == pytest.approx(240.0 * math.hypot(TO_HALF_LOAD["sitting"].girth[1], 0.01))
    morning = zone_shift("ball_girth", 240.0, Worn(load="half", time="morning"))
    assert (morning.more, morning.sd) == pytest.approx((2.4, 2.4))


@given(scanned=st.floats(0.0, 5.0), sock=st.one_of(st.none(), st.floats(0.0, 5.0)))
def test_a_sock_in_the_scan_counts_once(scanned: float, sock: float | None) -> None:
    worn = replace(STANDING, sock_mm=sock, scanned_in_sock_mm=scanned)
    expected = 0.0 if sock is None else 2.0 * (sock - scanned)
    assert zone_shift("length", 250.0, worn).more == pytest.approx(expected, abs=1e-12)


def test_every_limit_of_a_rule_moves_alike() -> None:
    rule = next(r for r in fit_profile("walking").zones if r.zone == "ball_girth")
    moved = shifted_rule(rule, zone_shift("ball_girth", 240.0, replace(STANDING, sock_mm=1.0)))
    for name in ("good", "acceptable", "poor"):
        ends = np.array(getattr(moved, name)) - np.array(getattr(rule, name))
        assert ends == pytest.approx([6.3, 6.3])
    assert moved.target - rule.target == pytest.approx(6.3)
    assert shifted_rule(rule, zone_shift("ball_girth", 240.0, STANDING)) == rule


def test_a_profile_may_say_what_is_worn_and_the_question_has_the_last_word() -> None:
    text = PLAIN.replace("[zones.length]", '[worn]\nsock_mm = 2\nload = "half"\n[zones.length]', 1)
    profile = profile_of(text)
    assert profile.worn == Worn(sock_mm=2.0, load="half")
    assert worn_with(profile) == profile.worn
    assert worn_with(profile, Worn(sock_mm=0.0)) == Worn(sock_mm=0.0, load="half")


@pytest.mark.parametrize(
    ("line", "words"),
    [("sock_mm = -1", "between 0 and 10"), ('load = "heavy"', "air, sitting, half, full"),
     ("socks = 1", "did you mean sock_mm"), ('time = "noon"', "morning, evening")],
)  # fmt: skip
def test_a_wrong_table_of_what_is_worn_is_said(line: str, words: str) -> None:
    with pytest.raises(BadProfile) as caught:
        profile_of(PLAIN.replace("[zones.length]", f"[worn]\n{line}\n[zones.length]", 1))
    assert words in caught.value.message


def test_a_thickness_that_nobody_wears_is_refused() -> None:
    with pytest.raises(BadOption, match="--insole takes 0 to 15 mm, not 40"):
        check_worn(Worn(insole_mm=40.0))


def match(footfit: Footfit, foot: Path, catalogue: Path, *options: object) -> dict:
    """The answer of a match, as JSON."""
    run = footfit("match", foot, "--json", "--catalogue", catalogue, *options)
    assert run.code == 0, run.err
    answer: dict = json.loads(run.out)
    return answer


def zones(answer: dict) -> dict:
    """The zones by last and name, of shown lasts and the nearest."""
    lasts = answer["candidates"] + answer["nearest"]
    return {
        (last["last"], name): zone
        for last in lasts
        for name, zone in last["fits"][0]["zones"].items()
    }


def test_the_measures_stay_and_what_is_asked_moves(
    footfit: Footfit, foot: Path, catalogue: Path
) -> None:
    bare = match(footfit, foot, catalogue)
    worn = match(footfit, foot, catalogue, "--sock", 0.5, "--insole", 1)
    assert worn["feet"][0]["measures"] == bare["feet"][0]["measures"]
    before, after = zones(bare), zones(worn)
    both = before.keys() & after.keys()
    assert both
    for key in both:
        if key[1] == "ball_line":  # it is judged beyond what the toe room explains
            continue
        assert before[key]["clearance"]["value"] == after[key]["clearance"]["value"], key
        more = after[key]["target"] - before[key]["target"]
        asked = {
            "length": 1.0,
            "ball_girth": 4.9,
            "toe_height": 2.0,
            "flare": 0.0,
            "ball_width": 1.0,
        }
        if key[1] in asked:
            assert more == pytest.approx(asked[key[1]], abs=1e-6), key
    codes = [warning["code"] for warning in worn["warnings"]]
    assert codes.count("worn_with") == 1
    assert "worn_with" not in [warning["code"] for warning in bare["warnings"]]


def test_the_line_says_load_and_time_in_one_phrase() -> None:
    assert Worn(time="morning").words == "a foot scanned in the morning"
    assert Worn(sock_mm=2.0, load="air", time="evening").words == (
        "a sock of 2.0 mm, a foot scanned without load in the evening"
    )


def test_unknown_load_widens_the_total_and_not_the_spread(
    footfit: Footfit, foot: Path, catalogue: Path
) -> None:
    known = zones(match(footfit, foot, catalogue, "--load", "half", "--time", "evening"))
    unknown = zones(match(footfit, foot, catalogue))
    for key in known.keys() & unknown.keys():
        if key[1] == "ball_girth":
            assert known[key]["clearance"]["sd"] == unknown[key]["clearance"]["sd"]
            assert unknown[key]["clearance"]["total_sd"] > known[key]["clearance"]["total_sd"] + 3.0


def test_a_heel_lift_adds_to_the_drop(footfit: Footfit, foot: Path, catalogue: Path) -> None:
    flat = match(footfit, foot, catalogue)
    lifted = match(footfit, foot, catalogue, "--heel-lift", 10)
    drops = {c["last"]: c["fits"][0]["heel"]["drop_mm"] for c in flat["candidates"]}
    for last in lifted["candidates"]:
        if last["last"] in drops:
            assert last["fits"][0]["heel"]["drop_mm"] == pytest.approx(drops[last["last"]] + 10.0)


def test_an_insole_leaves_open_how_the_walls_lean() -> None:
    """It takes 1.5 to 2 times its thickness of girth, and no width."""
    plain, insole = (Worn(insole_mm=each, load="half", time="evening") for each in (None, 3.0))
    assert zone_shift("ball_girth", 240.0, plain).sd == 0.0
    assert zone_shift("ball_girth", 240.0, insole).sd == pytest.approx(3.0 * 0.25 / 3.0**0.5)
    assert zone_shift("ball_width", 95.0, insole).sd == 0.0
