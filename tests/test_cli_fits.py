"""The fit log from the command line: recorded with consent, listed, and forgotten."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import pytest

from footfit.catalogue.store import open_catalogue
from footfit.pipeline.evidence.learned_profile import entries_of_csv
from footfit.pipeline.evidence.recording import definitions
from footfit.pipeline.evidence.zone_ratings import log_ratings
from tests.conftest import Footfit

GIVEN = ("--zone", "ball=+1", "--zone", "toe=0", "--comfort", "70", "--kept", "--consent")


def test_an_entry_has_the_clearances_of_the_match(
    footfit: Footfit, catalogue: Path, foot: Path
) -> None:
    match = json.loads(footfit("match", foot, "--json", "--catalogue", catalogue).out)
    best = match["candidates"][0]
    place = ("--catalogue", catalogue, "--json", "--wearer", "W-1", "--hours", 8, "--days", 2)
    run = footfit("record-fit", best["last"], foot, *GIVEN, *place)
    assert run.code == 0, run.err
    entry = json.loads(run.out)
    assert entry["schema"] == "footfit.record-fit/1"
    for zone, values in best["fits"][0]["zones"].items():
        if values["clearance"]["value"] is not None:
            kept = entry["zones"][zone]
            assert kept["clearance"] == pytest.approx(values["clearance"]["value"], abs=5.1e-4)
            assert kept["unit"] == values["unit"]
            assert kept["definition"]
    assert entry["ratings"] == {"ball": 1, "toe": 0}
    assert (entry["comfort"], entry["outcome"], entry["wearer"]) == (70.0, "kept", "W-1")
    assert (entry["hours"], entry["days"], entry["profile"]) == (8.0, 2.0, "walking")


def test_a_recorded_entry_teaches_its_zones(footfit: Footfit, catalogue: Path, foot: Path) -> None:
    assert footfit("record-fit", "derby-41", foot, *GIVEN, "--catalogue", catalogue).code == 0
    with open_catalogue(catalogue) as opened:
        entries = opened.fit_log.entries()
        log = log_ratings(entries, "walking", definitions())
    assert set(log.zones) >= {"length", "ball_girth", "ball_width"}
    assert log.left_out == {}


def test_a_sock_is_taken_off_what_a_rating_teaches(
    footfit: Footfit, catalogue: Path, foot: Path, tmp_path: Path
) -> None:
    """Else a profile would learn the sock, and a match would add it again."""
    table, place = tmp_path / "fits.csv", ("--catalogue", catalogue)
    assert footfit("record-fit", "derby-41", foot, *GIVEN, *place).code == 0
    worn = ("--sock", 2, "--insole", 1, "--load", "air", "--time", "morning")
    assert footfit("record-fit", "derby-41", foot, *GIVEN, *worn, *place).code == 0
    assert footfit("list-fits", "--csv", table, *place).code == 0
    with open_catalogue(catalogue) as opened:
        entries = opened.fit_log.entries()
    bare, socked = ({zone.zone: zone for zone in entry.zones} for entry in entries)
    girth = socked["ball_girth"].asked_more
    assert girth > 2.0 * math.pi * 2.0 + 1.75  # and 3 % of the foot's girth
    assert bare["ball_girth"].asked_more == 0.0
    assert socked["ball_girth"].clearance == bare["ball_girth"].clearance
    for known in (entries, entries_of_csv(table)):
        rooms = log_ratings(known, "walking", definitions()).zones["ball_girth"].clearance_mm
        assert rooms[0] - rooms[1] == pytest.approx(girth, abs=1e-6)


def test_nothing_of_the_file_is_kept(footfit: Footfit, catalogue: Path, foot: Path) -> None:
    assert footfit("record-fit", "derby-41", foot, *GIVEN, "--catalogue", catalogue).code == 0
    assert foot.stem.encode() not in catalogue.read_bytes()


def test_the_list_is_a_row_for_each_zone(footfit: Footfit, catalogue: Path, foot: Path) -> None:
    footfit("record-fit", "derby-41", foot, *GIVEN, "--catalogue", catalogue, "--wearer", "A")
    rows = list(
        csv.DictReader(
            io.StringIO(footfit("list-fits", "--csv", "-", "--catalogue", catalogue).out)
        )
    )
    by_zone = {row["zone"]: row for row in rows}
    assert by_zone["ball_girth"]["rating"] == "1"
    assert by_zone["length"]["rating"] == "0"
    assert by_zone["instep_girth"]["rating"] == ""
    assert {row["wearer"] for row in rows} == {"A"}
    table = " ".join(footfit("list-fits", "--catalogue", catalogue).out.split())
    assert "comfort" in table
    assert "70 of 100, kept" in table
    assert "1 entry of 1 wearer" in table


def test_forgetting_by_code_and_by_id(footfit: Footfit, catalogue: Path, foot: Path) -> None:
    place = ("--catalogue", catalogue)
    for wearer in ("A", "A", "B"):
        footfit("record-fit", "derby-41", foot, *GIVEN, *place, "--wearer", wearer)
    run = footfit("forget-fits", "A", *place)
    assert run.code == 0
    assert "2 entries" in run.out
    assert "backups" in run.out
    (left,) = json.loads(footfit("list-fits", "--json", *place).out)["fits"]
    assert footfit("forget-fits", left["id"], *place).code == 0
    assert json.loads(footfit("list-fits", "--json", *place).out)["fits"] == []
    run = footfit("forget-fits", "A", *place)
    assert run.code == 4
    assert "list-fits" in run.err


@pytest.mark.parametrize(
    ("given", "code", "words"),
    [
        (("--zone", "ball=1"), 2, "--consent"),
        (("--consent",), 2, "nothing is said"),
        (("--consent", "--zone", "ball=9"), 2, "rating"),
        (("--consent", "--zone", "knee=1"), 2, "no place"),
        (("--consent", "--comfort", "101"), 2, "100"),
        (("--consent", "--kept", "--returned"), 2, "give one"),
        (("--consent", "--kept", "--wearer", "Ana Silva"), 2, "never a name"),
        (("--consent", "--kept", "--altered", "x"), 2, "give one"),
        (("--consent", "--kept", "--hours", "-1"), 2, "hours"),
        (("--consent", "--kept", "--profile", "slippers"), 2, "slippers"),
    ],
)
def test_a_refused_entry_stores_nothing(
    footfit: Footfit, catalogue: Path, foot: Path, given: tuple[str, ...], code: int, words: str
) -> None:
    before = catalogue.read_bytes()
    run = footfit("record-fit", "derby-41", foot, *given, "--catalogue", catalogue)
    assert run.code == code
    assert words in run.err
    assert len(run.err.splitlines()) == 1
    assert catalogue.read_bytes() == before


def test_an_unknown_last_is_named(footfit: Footfit, catalogue: Path, foot: Path) -> None:
    run = footfit("record-fit", "derbi-41", foot, *GIVEN, "--catalogue", catalogue)
    assert run.code == 4
    assert "derbi-41" in run.err
