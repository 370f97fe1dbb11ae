"""``footfit match``: the profile, the check, the size system, pairs; from the command line."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from footfit.pipeline.fit.fit_profile import FOLDER, fit_profile
from tests.conftest import SAMPLES, Footfit

PAIR = (SAMPLES / "feet" / "mh007_L.stl", SAMPLES / "feet" / "mh007_R.stl")


@pytest.fixture
def strict(tmp_path: Path) -> Path:
    """A profile of the user's own in which no last is better than poor."""
    text = (FOLDER / "walking.toml").read_text(encoding="utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(
        text.replace('name = "walking"', 'name = "mine"')
        .replace("good_deg = [-9, 5]", "good_deg = [-0.01, 0.01]")
        .replace("acceptable_deg = [-18, 12]", "acceptable_deg = [-0.02, 0.02]"),
        encoding="utf-8",
    )
    return path


def test_the_profile_is_recorded_with_its_rules_and_hash(
    footfit: Footfit, foot: Path, stocked: Path
) -> None:
    for name in ("walking", "dress"):
        run = footfit("match", foot, "--profile", name, "--catalogue", stocked, "--json")
        document = run.document
        assert document["profile"] == name
        assert document["fit_profile"]["sha256"] == fit_profile(name).sha256
        assert document["fit_profile"]["zones"]["length"]["required"] is True


def test_the_check_fails_with_seven_and_one_line(
    footfit: Footfit, foot: Path, stocked: Path, strict: Path
) -> None:
    command = ("match", foot, "--catalogue", stocked)
    assert footfit(*command, "--fail-under", "acceptable").code in (0, 7)
    run = footfit(*command, "--profile", strict, "--fail-under", "acceptable")
    assert run.code == 7
    assert "no last that is acceptable or better" in run.last_error
    assert "toe room" not in run.err
    run = footfit(*command, "--profile", strict, "--fail-under", "good", "--json")
    assert json.loads(run.last_error)["code"] == "check_failed"
    assert {c["verdict"] for c in run.document["candidates"]} <= {"poor"}
    assert footfit(*command, "--profile", strict).code == 0, "no check was asked for"


def test_a_check_beside_a_bad_mesh_has_the_code_of_different_failures(
    footfit: Footfit, foot: Path, stocked: Path, strict: Path, tmp_path: Path
) -> None:
    bad = tmp_path / "bad.stl"
    bad.write_bytes(foot.read_bytes()[:5000])
    run = footfit(
        "match", bad, foot, "--profile", strict, "--fail-under", "good", "--catalogue", stocked
    )
    assert run.code == 3
    assert "no last that is good" in run.last_error


def test_the_first_last_of_a_real_pair_has_the_best_verdict(
    footfit: Footfit, scans: Path, stocked: Path
) -> None:
    """A pair whose nearest last was poor stood before an acceptable one, and met the check."""
    order, seen = ["good", "acceptable", "poor"], set()
    for pair in ("MHR_template_{}.stl", "makehuman/mh007_{}.stl"):
        feet = (scans / pair.format("L"), scans / pair.format("R"))
        command = ("match", *feet, "--pair", "--catalogue", stocked, "--top", "9", "--json")
        run = footfit(*command, "--fail-under", "acceptable")
        verdicts = [candidate["verdict"] for candidate in run.document["candidates"]]
        assert verdicts == sorted(verdicts, key=order.index)
        assert run.document["best_verdict"] == verdicts[0]
        assert run.code == (0 if verdicts[0] in order[:2] else 7)
        seen.add(tuple(verdicts))
    assert any(len(set(verdicts)) > 1 for verdicts in seen), "one pair has several verdicts"


@pytest.mark.parametrize(
    ("options", "code", "words"),
    [
        (
            ("--profile", "disco"),
            2,
            "boot, child, depth, dress, pump, safety, sandal, sport, walking",
        ),
        (("--profile", "none.toml"), 3, "give a fit profile"),
        (("--by", "shape", "--fail-under", "good"), 2, "judges no fit"),
        (("--by", "shape", "--sock", "2"), 2, "--sock goes with --by fit or flare"),
        (("--by", "shape", "--growth"), 2, "--growth goes with --by fit or flare"),
        (("--by", "shape", "--scanned-at-drop", "9"), 2, "--scanned-at-drop goes with --by fit"),
        (("--fail-under", "superb"), 2, "superb"),
        (("--as-scanned", "--scanned-at-drop", "20"), 2, "leave out one"),
    ],
)
def test_what_cannot_be_asked_is_refused_in_one_line(
    footfit: Footfit, foot: Path, stocked: Path, options: tuple[str, ...], code: int, words: str
) -> None:
    run = footfit("match", foot, "--catalogue", stocked, *options)
    assert run.code == code
    assert words in run.err
    assert len(run.err.strip().splitlines()) == 1
    assert run.out == ""


def test_a_broken_profile_is_said_before_any_work(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    path = tmp_path / "broken.toml"
    path.write_text("name = ", encoding="utf-8")
    run = footfit("match", foot, "--profile", path, "--catalogue", stocked, "--json")
    assert run.code == 3
    assert json.loads(run.last_error)["code"] == "bad_profile"


def test_the_customers_system_is_shown_though_no_last_is_labelled_in_it(
    footfit: Footfit, foot: Path, stocked: Path
) -> None:
    run = footfit("match", foot, "--size-system", "us-women", "--catalogue", stocked)
    assert run.code == 0
    assert "size US women 9; beside it US women 8.5 and US women 9.5" in run.out
    classes = ("straight", "inflare", "outflare")
    assert not any(word in run.out for word in classes), "a foot has no class; a difference is said"
    assert "no last is labelled in US women sizes" in run.err
    document = footfit("match", foot, "--catalogue", stocked, "--json").document
    assert document["feet"][0]["sizes"]["eu"]["words"] == "EU 40"


def test_a_pair_has_a_fit_for_each_foot(footfit: Footfit, stocked: Path) -> None:
    document = footfit("match", *PAIR, "--pair", "--catalogue", stocked, "--json").document
    for candidate in document["candidates"] or document["nearest"]:
        assert [fit["side"] for fit in candidate["fits"]] == ["left", "right"]
        governs = [fit["zones"]["length"]["counts"] for fit in candidate["fits"]]
        assert sorted(governs) == [False, True]
    assert [w["code"] for w in document["warnings"]].count("pair_difference") == 1


def test_no_last_fits_a_foot_twice_its_size(footfit: Footfit, foot: Path, stocked: Path) -> None:
    run = footfit(
        "match", foot, "--known-length", "360", "--catalogue", stocked, "--json", "--quiet"
    )
    document = run.document
    assert run.code == 0
    assert document["candidates"] == []
    assert len(document["nearest"]) == 3
    assert all("past the limit" in one["why"] for one in document["nearest"])
    assert document["rejected"]["by_reason"] == {"too_short": 14}


def test_the_room_in_every_shown_last_is_what_compare_says(
    footfit: Footfit, foot: Path, stocked: Path
) -> None:
    asked = ("match", foot, "--top", "2", "--catalogue", stocked, "--json")
    assert [one["surface_clearance"] for one in footfit(*asked).document["candidates"]] == [
        None
    ] * 2
    candidates = footfit(*asked, "--clearance").document["candidates"]
    assert len(candidates) == 2
    for candidate in candidates:
        (room,) = candidate["surface_clearance"]
        whole = footfit("compare", foot, candidate["last"], "--catalogue", stocked, "--json")
        assert room["zones"] == whole.document["zones"]
        assert room["swing_mm"] == whole.document["docking"]["swing_mm"]
        assert room["reason"] is None


def test_the_room_is_said_for_both_feet_in_eighty_columns(footfit: Footfit, stocked: Path) -> None:
    run = footfit("match", *PAIR, "--pair", "--clearance", "--top", "1", "--catalogue", stocked)
    assert run.code == 0
    for side in ("left", "right"):
        assert f"{side} foot: presses " in run.out or f"{side} foot: loosest " in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_a_last_without_a_sound_copy_has_no_room_but_a_reason(
    footfit: Footfit, foot: Path, stocked: Path, tmp_path: Path
) -> None:
    catalogue = tmp_path / "hurt.footfit"
    shutil.copy(stocked, catalogue)
    with closing(sqlite3.connect(catalogue)) as connection, connection:
        connection.execute("UPDATE mesh_copy SET data = zeroblob(length(data))")
    run = footfit("match", foot, "--clearance", "--catalogue", catalogue, "--json")
    assert run.code == 0
    for candidate in run.document["candidates"]:
        assert candidate["surface_clearance"][0]["zones"] == {}
        assert "--replace" in candidate["surface_clearance"][0]["reason"]
