"""``calibrate-profile``: a profile learns from the log or from a CSV, or is refused in words."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import footfit as library
from footfit.catalogue.store import open_catalogue
from footfit.pipeline.evidence.learned_profile import calibration, entries_of_csv, profile_text
from footfit.pipeline.evidence.recording import definitions
from footfit.pipeline.fit.fit_profile import fit_profile, profile_of, shipped
from footfit.pipeline.fit.zones import ZONES
from footfit.report.terminal.profile_tables import calibration_table
from footfit.report.terminal.scan_tables import terminal_text
from footfit.results import FitEntry, RatedZone, Worn
from tests import fits
from tests.conftest import Footfit

TARGET_MM = 5.0


def entries(count: int, target_mm: float = TARGET_MM, seed: int = 1) -> list[FitEntry]:
    """Entries of wearers whose target at the ball is known."""
    rng = np.random.default_rng(seed)
    made = []
    for number in range(count):
        clearance = float(rng.uniform(-8.0, 14.0))
        felt = (clearance - target_mm - rng.normal(0.0, 3.0)) / 5.0 + rng.normal()
        rating = int(np.digitize(felt, [-2.0, -1.0, 1.0, 2.0])) - 2
        zone = RatedZone("ball_girth", "mm", clearance, 1.0, definitions()["ball_girth"])
        made.append(fits.entry(number, zones=(zone,), ratings={"ball": rating}))
    return made


@pytest.fixture
def log(catalogue: Path) -> Path:
    """A catalogue whose log says that the ball should be looser."""
    with open_catalogue(catalogue, write=True) as opened:
        for entry in entries(60):
            opened.fit_log.add(entry)
    return catalogue


def test_a_profile_learns_and_is_read_again(footfit: Footfit, log: Path, tmp_path: Path) -> None:
    output = tmp_path / "mine.toml"
    run = footfit("calibrate-profile", "walking", "-o", output, "--catalogue", log, "--json")
    assert run.code == 0, run.err
    answer = json.loads(run.out)
    assert answer["applied"] == ["ball_girth"]
    learned = fit_profile(str(output))
    assert learned.version == fit_profile("walking").version + 1
    assert answer["after"] == learned.to_dict()  # with the hash that a match will give
    rules = {rule.zone: rule for rule in learned.zones}
    low, high = answer["zones"]["ball_girth"]["target_interval_mm"]
    assert low < TARGET_MM < high
    assert low < rules["ball_girth"].target < high
    assert rules["ball_girth"].grade == "A"
    assert "60 ratings of 60 wearers" in rules["ball_girth"].source
    assert rules["length"] == fit_profile("walking").zones[0]


def test_the_table_says_the_log_loss_and_that_a_move_is_held_back() -> None:
    """Wearers wish 25 mm more at the ball; the target follows by two prior standard deviations."""
    made = []
    for entry in entries(60):
        (zone,) = entry.zones
        made.append(replace(entry, zones=(replace(zone, clearance=zone.clearance + 20.0),)))
    words = terminal_text(calibration_table(calibration(fit_profile("walking"), made)), 300)
    assert "target is now +9.0, as far as it may move at once" in words
    assert "log loss of held-out ratings" in words
    near = terminal_text(calibration_table(calibration(fit_profile("walking"), entries(60))), 300)
    assert "target is now" in near
    assert "as far as it may move" not in near


def test_the_picture_shows_the_ratings_before_and_after(
    footfit: Footfit, log: Path, tmp_path: Path
) -> None:
    svg, png = tmp_path / "fit.svg", tmp_path / "fit.png"
    for plot in (svg, png):
        run = footfit("calibrate-profile", "walking", "--plot", plot, "--catalogue", log)
        assert run.code == 0, run.err
    assert svg.read_text(encoding="utf-8").startswith("<?xml")
    assert png.read_bytes().startswith(b"\x89PNG")


def test_the_csv_of_the_log_teaches_the_same(footfit: Footfit, log: Path, tmp_path: Path) -> None:
    table, first, second = (tmp_path / name for name in ("fits.csv", "a.toml", "b.toml"))
    assert footfit("list-fits", "--csv", table, "--catalogue", log).code == 0
    assert footfit("calibrate-profile", "walking", "-o", first, "--catalogue", log).code == 0
    run = footfit("calibrate-profile", "walking", "--fits", table, "-o", second)
    assert run.code == 0, run.err
    assert first.read_bytes() == second.read_bytes()


def test_a_spreadsheets_csv_is_read(footfit: Footfit, log: Path, tmp_path: Path) -> None:
    table = tmp_path / "fits.csv"
    assert footfit("list-fits", "--csv", table, "--catalogue", log).code == 0
    read = entries_of_csv(table)
    text = table.read_text(encoding="utf-8").replace(".", "§").replace(",", ";").replace("§", ",")
    other = tmp_path / "excel.csv"
    other.write_text("\ufeff" + text, encoding="utf-8")
    again = entries_of_csv(other)
    assert [entry.zones for entry in again] == [
        tuple(replace(z, definition=z.definition.replace(".", ",")) for z in entry.zones)
        for entry in read
    ]


def test_what_cannot_tell_is_refused_in_words(
    footfit: Footfit, catalogue: Path, tmp_path: Path
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        for entry in entries(12):
            opened.fit_log.add(entry)
    output = tmp_path / "mine.toml"
    run = footfit("calibrate-profile", "walking", "-o", output, "--catalogue", catalogue)
    assert run.code == 7
    assert "20 are needed" in " ".join(run.out.split())
    assert "the profile stays as it is" in run.err
    assert not output.exists()
    with library.open_catalogue(catalogue) as opened:
        answer = opened.fit_log.calibrate_profile("walking")
    assert answer.after == answer.before == fit_profile("walking")


def test_an_empty_log_is_refused_in_words(footfit: Footfit, catalogue: Path) -> None:
    run = footfit("calibrate-profile", "walking", "--catalogue", catalogue)
    assert run.code == 7
    assert "0 entries were read" in run.err
    with open_catalogue(catalogue, write=True) as opened:
        opened.fit_log.add(entries(1)[0])
    run = footfit("calibrate-profile", "walking", "--catalogue", catalogue)
    assert "1 entry was read" in run.err
    assert "1 wearer rated" in " ".join(run.out.split())


@pytest.mark.parametrize(
    ("old", "new", "words", "lines"),
    [
        ("ball,", "ball,x", "rating", 1),
        ("rating,", "rated,", "rated", 2),  # it is not known, and the column rating is missing
        (",mm,", ",mm,x", "clearance", 1),
    ],
)
def test_a_bad_csv_is_named(
    footfit: Footfit, log: Path, tmp_path: Path, old: str, new: str, words: str, lines: int
) -> None:
    table = tmp_path / "fits.csv"
    footfit("list-fits", "--csv", table, "--catalogue", log)
    table.write_text(table.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    run = footfit("calibrate-profile", "walking", "--fits", table)
    assert run.code == 3
    assert words in run.err
    assert str(table) in run.err
    assert len(run.err.splitlines()) == lines


def test_a_written_profile_says_what_is_worn() -> None:
    profile = replace(fit_profile("walking"), worn=Worn(sock_mm=2.0, load="half"))
    assert profile_of(profile_text(profile)).worn == profile.worn


@pytest.mark.parametrize("name", shipped())
def test_a_written_profile_has_the_same_values(name: str) -> None:
    profile = fit_profile(name)
    assert profile_of(profile_text(profile)) == profile


@pytest.mark.parametrize("name", ["walking", "sandal"])
def test_a_profile_calls_its_zones_as_a_match_does(footfit: Footfit, name: str) -> None:
    run = footfit("show-profile", name.upper())
    assert run.code == 0, run.err
    for rule in fit_profile(name).zones:
        assert f"\n {ZONES[rule.zone].label} " in run.out
    assert "toe room is length" in " ".join(run.out.split())
