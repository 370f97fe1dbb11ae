"""The name of a last wherever a mesh is taken; and one last compared with another."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

import footfit as library
from footfit.catalogue.store import open_catalogue
from footfit.results import Profiled
from tests.conftest import SAMPLES, Footfit
from tests.reading import read_scan

LAST, OTHER = "derby-40", "derby-41"
"""A right last and a left one."""
FILE = SAMPLES / "lasts" / "derby-40.stl"


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty working folder."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


# ---------------------------------------------------------------- one number for one thing


def test_measure_and_flare_answer_with_the_stored_numbers(
    footfit: Footfit, stocked: Path, elsewhere: Path
) -> None:
    here = ("--catalogue", stocked, "--json")
    shown = footfit("show-last", LAST, *here).document
    measured = footfit("measure", LAST, *here)
    assert measured.document["measures"] == shown["measures"]
    assert measured.document["kind"] == "last"
    assert "stored copy, less than 0.01 mm from the scan" in measured.err
    assert measured.err.startswith(f"{LAST}: ")
    flared = footfit("flare", LAST.upper(), *here).document
    for key in ("flare_angle_deg", "stations", "heading_deg", "curvature", "length_mm", "side"):
        assert flared[key] == shown[key]
    assert flared["mesh"]["path"] == LAST


def test_two_names_and_two_jobs_give_the_same_bytes(
    footfit: Footfit, stocked: Path, elsewhere: Path
) -> None:
    command = ("measure", LAST, OTHER, "--catalogue", stocked, "--json")
    assert footfit(*command).out == footfit(*command, "--jobs", 2).out


def test_align_writes_the_copy_in_its_frame(
    footfit: Footfit, stocked: Path, elsewhere: Path
) -> None:
    run = footfit(
        "align", OTHER, "-o", "x.stl", "--plot", "x.svg", "--catalogue", stocked, "--json"
    )
    document = run.document
    assert document["transform"] == [
        [float(row == column) for column in range(4)] for row in range(4)
    ]
    assert footfit("export-last", OTHER, "-o", "y.stl", "--catalogue", stocked).code == 0
    assert (read_scan(Path("x.stl")).vertices_mm == read_scan(Path("y.stl")).vertices_mm).all()
    paper = footfit("align", OTHER, "--method", "paper", "--catalogue", stocked, "--json")
    assert paper.document["reference"]["last"]


def test_curvature_takes_a_name(footfit: Footfit, stocked: Path, elsewhere: Path) -> None:
    run = footfit("curvature", LAST, "-o", "c.ply", "--catalogue", stocked, "--json")
    assert run.document["defined_vertices"] > 1000
    assert "stored copy" in run.document["warnings"][-1]["message"]


# ---------------------------------------------------------------- a last in a last


def test_last_against_last_speaks_of_no_foot(
    footfit: Footfit, stocked: Path, elsewhere: Path
) -> None:
    command = ("compare", LAST, OTHER, "--catalogue", stocked)
    run = footfit(*command, "--html", "x.html", "--plot", "x.svg")
    assert run.code == 0
    assert "foot" not in run.out
    said = " ".join(run.out.split())
    assert said.startswith(f"{LAST}, right last, in {OTHER}, left last (shown on its mirror image)")
    document = footfit(*command, "--json").document
    assert (document["kind"], document["heel"], document["mirrored"]) == ("last", None, True)
    lengths = document["length_mm"]
    assert lengths["difference"] == pytest.approx(6.7, abs=0.5), "one Paris point is 6.67 mm"
    page = Path("x.html").read_text(encoding="utf-8")
    said = page[page.index("<h1>") : page.index("<footer>")]
    words = re.sub(r'src="[^"]*"|data-[a-z]+="[^"]*"', "", said)
    assert not re.search(r"\bfoot\b", words)
    assert "last in another last" in said
    drawn = re.sub(r"<metadata>.*?</metadata>", "", Path("x.svg").read_text(), flags=re.DOTALL)
    assert not re.search(r"\bfoot\b", drawn)


def test_a_last_in_itself_has_no_clearance(footfit: Footfit, stocked: Path) -> None:
    document = footfit("compare", FILE, LAST, "--catalogue", stocked, "--json").document
    assert document["kind"] == "last"
    assert document["length_mm"]["difference"] == pytest.approx(0.0, abs=0.05)
    for zone in document["zones"].values():
        assert abs(zone["mean_mm"]) < 0.25, "the copy is at most 0.25 mm from the scan"


def test_a_foot_in_a_last_is_still_a_foot(footfit: Footfit, stocked: Path, foot: Path) -> None:
    run = footfit("compare", foot, LAST, "--catalogue", stocked, "--json")
    assert run.document["kind"] == "foot"
    assert run.document["heel"] is not None


# ---------------------------------------------------------------- match


def test_match_refuses_a_last_as_a_foot_and_finds_its_relatives(
    footfit: Footfit, stocked: Path, foot: Path, elsewhere: Path
) -> None:
    here = ("--catalogue", stocked, "--json")
    for by in ("fit", "flare"):
        run = footfit("match", LAST, foot, "--by", by, *here)
        assert [line["schema"] for line in run.lines] == ["footfit.error/1", "footfit.match/2"]
        assert run.code == 2
        assert "--by shape" in json.loads(run.last_error)["message"]
    by_shape = footfit("match", LAST, "--by", "shape", *here).document  # its copy: measured 0.0206
    assert by_shape["candidates"][0]["last"] == LAST
    assert by_shape["candidates"][0]["distance"] == pytest.approx(0.0, abs=0.04)


# ---------------------------------------------------------------- which of the two is taken


def test_a_file_wins_over_a_last_and_it_is_said(
    footfit: Footfit, stocked: Path, foot: Path, elsewhere: Path
) -> None:
    shutil.copy(foot, LAST)
    here = ("--catalogue", stocked)
    for command in (("measure", LAST), ("match", LAST), ("compare", foot, LAST)):
        run = footfit(*command, *here)
        assert (
            f"{LAST}: there is a file or folder here, so the last '{LAST}' is not read" in run.err
        )
    assert footfit("measure", LAST, *here, "--json").document["kind"] == "foot"
    assert "there is a file" not in footfit("measure", f"./{LAST}", *here).err
    assert "there is a file" not in footfit("measure", LAST, *here, "--quiet").err


@pytest.mark.parametrize(
    ("typed", "code", "words"),
    [
        ("derby-4O", 4, "no such file or last; the nearest name of a last is 'derby-4"),
        ("DERBI-40", 4, "the nearest name of a last is 'derby-40'"),
        ("derby-40.stl", 3, "the nearest name of a last is 'derby-40'"),
        ("qqqqq", 4, "there is no such file or last"),
        ("./qqqqq.stl", 3, "there is no such file"),
    ],
)
def test_a_name_of_nothing_gets_the_nearest(
    footfit: Footfit, stocked: Path, elsewhere: Path, typed: str, code: int, words: str
) -> None:
    run = footfit("measure", typed, "--catalogue", stocked)
    assert (run.code, len(run.err.splitlines())) == (code, 1)
    assert run.err.startswith(f"footfit: {typed}: ")
    assert words in run.err


def test_without_a_catalogue_a_missing_file_is_only_that(footfit: Footfit, elsewhere: Path) -> None:
    run = footfit("measure", LAST, "--catalogue", "none.footfit", "--json")
    error = json.loads(run.last_error)
    assert (run.code, error["code"], error["path"]) == (3, "unreadable_file", LAST)
    assert not list(elsewhere.iterdir())


def test_a_file_needs_no_sound_catalogue(footfit: Footfit, foot: Path, elsewhere: Path) -> None:
    Path("bad.footfit").write_bytes(b"not a catalogue")
    shutil.copy(foot, "foot.stl")
    assert footfit("measure", "foot.stl", "--catalogue", "bad.footfit", "--quiet").code == 0
    assert footfit("measure", "none.stl", "--catalogue", "bad.footfit").code == 3
    assert footfit("measure", LAST, "--catalogue", "bad.footfit").code == 6


def test_a_name_with_brackets_is_no_pattern(
    footfit: Footfit, catalogue: Path, elsewhere: Path
) -> None:
    here = ("--catalogue", catalogue)
    assert footfit("rename-last", LAST, "derby[40]*", *here).code == 0
    run = footfit("measure", "derby[40]*", *here, "--json")
    assert run.document["mesh"]["path"] == "derby[40]*"


# ---------------------------------------------------------------- what cannot be done


@pytest.mark.parametrize(
    "given",
    [("--side", "left"), ("--units", "cm"), ("--known-length", "250"), ("--heel-height", "60")],
)
def test_options_of_a_scan_are_refused_for_a_stored_last(
    footfit: Footfit, stocked: Path, elsewhere: Path, given: tuple[str, str]
) -> None:
    run = footfit("measure", LAST, *given, "--catalogue", stocked)
    assert run.code == 2
    assert "leave out the options" in run.err


def test_a_last_without_a_mesh_says_what_to_do(
    footfit: Footfit, catalogue: Path, elsewhere: Path
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        opened.add(opened.record(LAST), None, replace=True)
    for command in (("measure", LAST), ("compare", LAST, OTHER), ("compare", OTHER, LAST)):
        run = footfit(*command, "--catalogue", catalogue)
        assert run.code == 4
        assert "stored without its mesh" in run.err
        assert "--replace" in run.err


def test_a_damaged_copy_is_refused(footfit: Footfit, catalogue: Path, elsewhere: Path) -> None:
    with open_catalogue(catalogue, write=True) as opened, opened.file.atomic() as connection:
        connection.exec_driver_sql("UPDATE mesh_copy SET data = x'00'")
    run = footfit("measure", LAST, "--catalogue", catalogue)
    assert run.code == 6
    assert "--replace" in run.err


# ---------------------------------------------------------------- the library


def test_the_library_takes_names_too(stocked: Path, foot: Path, elsewhere: Path) -> None:
    with library.open_catalogue(stocked) as lasts:
        shape = lasts.shape(LAST.upper())
        assert isinstance(shape, Profiled)
        assert library.measure(shape).measures == lasts.last(LAST).record.measures
        compared = lasts.compare(shape, OTHER)
        assert compared.nouns == ("first last", "second last")
        sources = lasts.sources([LAST, str(foot)])
        kinds = [library.measure(source).alignment.pose.kind for source in sources]
    assert kinds == ["last", "foot"]
