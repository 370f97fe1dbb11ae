"""What a custom last says of lasts in stock, of the room it was given, and of its file's heel."""

from __future__ import annotations

from pathlib import Path

import pytest

import footfit
from footfit.errors import BadOption, UnreadableFile
from footfit.report.page.custom_page import custom_page
from footfit.results import CustomLast, MeasuredScan
from tests.conftest import ROOT

LASTS = ROOT / "sample_data" / "lasts"
FOOT = ROOT / "sample_data" / "feet" / "mh008_R.stl"


def custom_from(name: str, path: Path, **asked):
    (made,) = footfit.customise(str(FOOT), name, catalogue=path, name="own", **asked)
    return made


def ranked(path: Path) -> dict[str, tuple[str, ...]]:
    """The lasts in the order of a match, each with those that it is tied with."""
    with footfit.Catalogue(path) as catalogue:
        match = catalogue.match(str(FOOT))
    return {candidate.last: candidate.tied_with for candidate in match.candidates}


def test_a_last_of_the_catalogue_that_fits_better_is_said_as_match_ranks_it(tmp_path) -> None:
    path = tmp_path / "shop.footfit"
    with footfit.Catalogue(path) as catalogue:
        for name in ("derby-41", "derby-43"):
            catalogue.ingest(str(LASTS / f"{name}.stl"), heel_height_mm=25.0)
    poor = custom_from("derby-41", path)
    better = poor.better_in_stock
    assert better is not None
    document = poor.to_dict()
    assert document["better_in_stock"]["last"] == better.last == "derby-43"
    assert (better.verdict, better.custom_verdict) == ("good", poor.verdict)
    (notice,) = (each for each in poor.warnings if each.code == "better_in_stock")
    assert "derby-43 of the catalogue (good) fits this foot better than this custom last (" in (
        notice.message
    )
    assert "with --base derby-43, or from the best last without --base" in notice.message
    assert notice.message in custom_page(poor)
    best = custom_from("derby-43", path)
    assert best.better_in_stock is None
    footfit.store_custom(poor, path)
    assert [*ranked(path)] == ["derby-43", "own"]
    footfit.store_custom(best, path, replace=True)
    order = ranked(path)
    assert next(iter(order)) == "own" or "own" in order["derby-43"]
    again = custom_from("derby-41", path)  # a last that was made for a customer does not count
    assert again.better_in_stock == better


def test_a_last_without_the_room_that_was_asked_for_is_not_called_better(tmp_path) -> None:
    path = tmp_path / "shop.footfit"
    with footfit.Catalogue(path) as catalogue:
        catalogue.ingest(str(LASTS / "derby-43.stl"), heel_height_mm=25.0)
    roomy = custom_from("derby-43", path, room_mm={"ball-medial": 4.0})
    without = custom_from("derby-43", path)
    (lost,) = (zone for zone in roomy.judged if zone.name == "ball_width")
    (kept,) = (zone for zone in without.judged if zone.name == "ball_width")
    assert kept.custom_verdict == "good"
    assert lost.custom_verdict != "good"  # the last of the catalogue would be ranked first
    assert roomy.better_in_stock is None
    assert "better_in_stock" not in {each.code for each in roomy.warnings}
    (notice,) = (each for each in roomy.warnings if each.code == "not_good")
    assert "ball width (this is the room that was asked for, and without it" in notice.message
    page = custom_page(roomy)
    assert "of the catalogue" not in page
    assert "Give less" not in page


def heel_mm(measured: MeasuredScan) -> float:
    """The heel height that was read, in mm."""
    (value,) = (m.measured.value for m in measured.measures if m.name == "heel_height")
    assert value is not None
    return value


def test_a_file_that_reads_another_heel_without_the_label_is_said() -> None:
    def made(**stands: float) -> CustomLast:
        (custom,) = footfit.customise(str(FOOT), str(LASTS / "derby-43.stl"), name="own", **stands)
        return custom

    last = made(heel_height_mm=25.0)
    file = footfit.mesh_file(last, "stl")
    without = heel_mm(footfit.measure(file, kind="last"))
    (notice,) = (each for each in last.warnings if each.code == "heel_by_label")
    said = float(notice.message.split(" reads ")[1].split(" mm")[0])
    assert said == pytest.approx(without, abs=0.15)
    assert without < 25.0 - 1.5
    assert "give its heel height with the file (--heel-height 25)" in notice.message
    assert notice.message in custom_page(last)
    assert notice.code in {each["code"] for each in last.to_dict()["warnings"]}
    for quiet in (made(), made(heel_height_mm=round(without, 1))):
        assert "heel_by_label" not in {each.code for each in quiet.warnings}


def test_what_is_wrong_in_python_is_said_without_options_of_the_command() -> None:
    with pytest.raises(UnreadableFile, match=r"no catalogue with a last of this name: give a cat"):
        footfit.customise(str(FOOT), base="derby-43")
    with pytest.raises(UnreadableFile, match=r"there is no such file: check the path"):
        footfit.customise(str(FOOT), base="lasts/derby-43.stl")
    for room_mm in ({"bunion": 4.0}, {"ball-medial": 40.0}):
        with pytest.raises(BadOption) as refused:
            footfit.customise(str(FOOT), str(LASTS / "derby-43.stl"), room_mm=room_mm)
        assert "room" in refused.value.message
        assert "--" not in refused.value.message
