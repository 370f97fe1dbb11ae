"""Sides that are given, read or missing: a sure contradiction is refused, a doubt gives way."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from footfit.errors import SameSide, SideUndecided
from footfit.pipeline.customers.pair_sides import pair_of_feet
from footfit.pipeline.scan.flare import profiled_scan
from footfit.results import AlignedScan, SideVerdict
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES, Footfit
from tests.reading import read_scan
from tests.scans import aligned

LEFT, RIGHT = (SAMPLES / "feet" / f"mh007_{side}.stl" for side in "LR")
OTHER_RIGHT = SAMPLES / "feet" / "mh008_R.stl"


@pytest.fixture(scope="module")
def feet() -> dict[str, AlignedScan]:
    return {path.stem: aligned(read_scan(path)) for path in (LEFT, RIGHT, OTHER_RIGHT)}


def taken_for(foot: AlignedScan, score: float, source: str = "detected") -> AlignedScan:
    """A right foot whose detection gave another score, as of a shape that shows its side badly."""
    side = "right" if score > 0 else "left"
    word = "sure" if abs(score) >= 2.5 else "low" if abs(score) >= 0.5 else "undecided"
    verdict = SideVerdict(None if word == "undecided" else side, word, score, source)
    return AlignedScan(replace(foot.alignment, side=verdict), replace(foot.prepared, side=verdict))


# ---------------------------------------------------------------- a pair


def test_the_sure_feet_of_a_pair_stay_as_they_are(feet: dict[str, AlignedScan]) -> None:
    pair = feet["mh007_L"], feet["mh007_R"]
    assert [foot.aligned for foot in pair_of_feet(pair)] == [*pair]
    ready = profiled_scan(pair[0])
    assert pair_of_feet([ready, pair[1]])[0] is ready


@pytest.mark.parametrize("score", [0.9, 0.2])
@pytest.mark.parametrize("first", [True, False])
def test_a_doubtful_foot_gives_way_to_the_other(
    feet: dict[str, AlignedScan], score: float, first: bool
) -> None:
    doubtful, sure = taken_for(feet["mh008_R"], score), feet["mh007_R"]
    pair = pair_of_feet([doubtful, sure] if first else [sure, doubtful])
    changed, kept = pair if first else pair[::-1]
    assert kept.aligned is sure
    side = changed.aligned.alignment.side
    assert (side.side, side.source, side.score) == ("left", "pair", score)
    (said,) = [n for n in changed.aligned.alignment.warnings if n.code == "side_from_pair"]
    assert "mh007_R.stl is the right foot of the pair" in said.message
    as_left = aligned(read_scan(OTHER_RIGHT), side="left", force_side=True)
    forced = profiled_scan(as_left)
    assert changed.flare.angle_deg == pytest.approx(forced.flare.angle_deg, abs=ROUNDING)
    values = [[row.measured.value for row in each.measures] for each in (changed, forced)]
    assert values[0] == pytest.approx(values[1], abs=ROUNDING)


def test_of_two_doubtful_feet_the_less_sure_one_gives_way(feet: dict[str, AlignedScan]) -> None:
    less, more = taken_for(feet["mh008_R"], 0.8), taken_for(feet["mh007_R"], 1.4)
    for pair in ((less, more), (more, less)):
        sides = {foot.aligned.alignment.side.score: foot for foot in pair_of_feet(pair)}
        assert sides[0.8].aligned.alignment.side.side == "left"
        assert sides[1.4].aligned.alignment.side.side == "right"


def test_a_given_side_does_not_give_way(feet: dict[str, AlignedScan]) -> None:
    given = taken_for(feet["mh008_R"], 0.8, "given")
    with pytest.raises(SameSide, match="both right feet"):
        pair_of_feet([given, feet["mh007_R"]])


def test_two_sure_feet_of_one_side_are_no_pair(feet: dict[str, AlignedScan]) -> None:
    with pytest.raises(SameSide, match=r"mh008_R\.stl are both right feet") as refused:
        pair_of_feet([feet["mh007_R"], feet["mh008_R"]])
    assert refused.value.path == str(RIGHT)


def test_a_pair_that_shows_no_side_at_all_is_refused(feet: dict[str, AlignedScan]) -> None:
    undecided = [taken_for(feet[name], 0.1) for name in ("mh007_R", "mh008_R")]
    with pytest.raises(SideUndecided):
        pair_of_feet(undecided)


# ---------------------------------------------------------------- the commands


@pytest.mark.parametrize(
    "command",
    [("align",), ("flare",), ("measure",), ("match",), ("compare", "derby-40")],
    ids=lambda command: command[0],
)
def test_a_side_against_a_sure_detection_is_refused(
    footfit: Footfit, stocked: Path, command: tuple[str, ...]
) -> None:
    name, *last = command
    here = ("--catalogue", stocked) if name in ("match", "compare") else ()
    run = footfit(name, LEFT, *last, "--side", "right", "--json", *here)
    assert run.code == 5
    error = json.loads(run.last_error)
    assert (error["code"], error["path"]) == ("side_contradicted", str(LEFT))
    for words in ("given as right", "surely a left one (score -", "--force-side"):
        assert words in error["message"]
    agreed = footfit(name, LEFT, *last, "--side", "left", *here)
    assert agreed.code == 0
    assert "is given as" not in agreed.err + agreed.out


def test_a_forced_side_is_said_first_on_the_terminal_and_on_the_page(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    page = tmp_path / "page.html"
    run = footfit(
        *("match", LEFT, "--side", "right", "--force-side", "--html", page),
        *("--catalogue", stocked),
    )
    assert run.code == 0
    words = "the side is given as right, but the shape is surely a left one"
    assert run.out.startswith(f"{LEFT.name}: {words}")
    text = page.read_text(encoding="utf-8")
    assert text.index(words) < text.index('<section class="foot">')
    assert words not in footfit("match", LEFT, "--catalogue", stocked).out


def test_a_pair_of_one_side_is_a_usage_error(footfit: Footfit, stocked: Path) -> None:
    here = ("--catalogue", stocked, "--json")
    run = footfit("match", RIGHT, OTHER_RIGHT, "--pair", *here)
    assert (run.code, run.document["code"], run.document["exit"]) == (2, "same_side", 2)
    assert str(RIGHT) in run.last_error
    assert OTHER_RIGHT.name in run.last_error
    typed = footfit("match", LEFT, RIGHT, "--pair", "--side", "left", *here)
    assert (typed.code, "--side" in typed.last_error) == (2, True)


def test_the_manifests_side_is_held_against_the_shape(footfit: Footfit, tmp_path: Path) -> None:
    last = SAMPLES / "lasts" / "derby-40.stl"
    manifest = tmp_path / "lasts.csv"
    manifest.write_text(f"path,side\n{last},left\n", encoding="utf-8")
    command = ("ingest-last", "--manifest", manifest, "--catalogue", tmp_path / "c.footfit")
    run = footfit(*command, "--json")
    error = json.loads(run.last_error)
    assert (run.code, error["code"], error["path"]) == (5, "side_contradicted", str(last))
    forced = footfit(*command, "--force-side", "--json")
    assert (forced.code, forced.document["side"]) == (0, "left")
    assert "side_contradicted" in [each["code"] for each in forced.document["warnings"]]
