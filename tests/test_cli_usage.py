"""What is typed wrongly is said in plain words, with what to type instead."""

from __future__ import annotations

import codecs
import json
from pathlib import Path

import pytest

from footfit.cli import settings
from footfit.errors import BadOption, NotAFoot
from footfit.geometry.fit.sizes import label_check
from footfit.pipeline.fit.fit_profile import FOLDER, fit_profile
from tests import corpus
from tests.conftest import Footfit


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "No command given. See footfit -h"),
        (("meassure",), "there is no command 'meassure'; did you mean measure? See footfit -h"),
        (("measure",), "MESH is missing. See footfit measure -h"),
        (("measure", "x.stl", "--unit", "mm"), "did you mean --units?"),
        (("measure", "x.stl", "--units", "ft"), "--units takes auto, mm, cm, m or in, not 'ft'"),
        (("measure", "x.stl", "--jobs", "x"), "--jobs takes a whole number, not 'x'"),
        (("measure", "x.stl", "--csv"), "--csv needs a value"),
        (("match", "x.stl", "--top", "0"), "--top takes 1 or more, not 0"),
        (("measure", "x.stl", "--heel-height", "300"), "--heel-height takes 0 to 200, not 300"),
        (("measure", "x.stl", "--heel-height", "25,5"), "write 25.5"),
        (("list-lasts", "a", "b"), "there are too many arguments: a b"),
        (("measure", "-foot.stl"), "for a file of this name write ./-foot.stl"),
        (("measure", "-j.OBJ"), "write ./-j.OBJ"),
        (("measure", "--foot.glb", "x.stl"), "write ./--foot.glb"),
        (("measure", "-feet"), "write ./-feet"),
        (("show-last", "-x"), "before a name that begins with - write --"),
        (("--json", "list-lasts"), "there is no option --json before a command"),
        (("ingest-last", "x.stl", "--size", ""), "--size is empty (an unset variable?)"),
    ],
)
def test_a_usage_error_says_what_to_type(
    arguments: tuple[str, ...],
    words: str,
    footfit: Footfit,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (tmp_path / "-feet").mkdir()
    monkeypatch.chdir(tmp_path)
    run = footfit(*arguments)
    assert run.code == 2
    (line,) = run.err.splitlines()
    assert words in line


@pytest.mark.parametrize(
    ("command", "usage"),
    [
        ("measure", "[OPTIONS] MESH..."),
        ("compare", "[OPTIONS] FOOT LAST"),
        ("ingest-last", "[OPTIONS] [PATH...]"),
        ("demo", "[OPTIONS] [FOLDER]"),
        ("list-lasts", "[OPTIONS]"),
    ],
)
def test_the_usage_shows_what_a_command_takes(command: str, usage: str, footfit: Footfit) -> None:
    assert footfit(command, "-h").out.splitlines()[0] == f"Usage: footfit {command} {usage}"


def test_a_manifest_without_a_line_is_refused(footfit: Footfit, tmp_path: Path) -> None:
    manifest = tmp_path / "lasts.csv"
    manifest.write_text("path,name,,\n,,,\n")
    run = footfit("ingest-last", "--manifest", manifest, "--catalogue", tmp_path / "c.footfit")
    assert run.code == 3
    assert "no line with a last" in run.last_error
    assert list(tmp_path.iterdir()) == [manifest]


@pytest.mark.parametrize(
    ("length", "meant"), [(25.2, 252), (0.252, 252), (9.9, 251), (2520, 252), (12, 305), (14, 140)]
)
def test_a_known_length_in_another_unit_is_guessed_but_not_taken(
    length: float, meant: int, footfit: Footfit
) -> None:
    run = footfit("measure", "nowhere.stl", "nowhere2.stl", "--known-length", length)
    assert run.code == 2
    (line,) = run.err.splitlines()
    too = "long" if length > 370 else "short"
    assert f"{length:g} mm is too {too}; this is in mm: did you mean {meant}?" in line


@pytest.mark.parametrize(
    "label", ["42 2/3", "42⅔", "42 ⅔", "42 2⁄3", "42\N{NO-BREAK SPACE}2/3", "42,667", "42.667"]
)
def test_a_size_is_read_as_people_write_it(label: str) -> None:
    check = label_check(label, "eu", 280.0)
    assert check is not None
    assert check.off == pytest.approx(2 / 3, abs=0.01)


@pytest.mark.parametrize("label", ["6½", "6 1/2", "6.5", "6,5", " 6½ "])
def test_a_half_size_is_read_as_people_write_it(label: str) -> None:
    half, whole = (label_check(size, "uk", 260.0) for size in (label, "6"))
    assert half is not None
    assert whole is not None
    assert half.off - whole.off == pytest.approx(0.5)


@pytest.mark.parametrize("label", ["422/3x", "half", "6/7", "42W", "", "1/2"])
def test_what_is_no_size_is_no_number(label: str) -> None:
    assert label_check(label, "eu", 280.0) is None


# ---------------------------------------------------------------- settings and profiles


@pytest.fixture
def settings_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "settings.toml"
    monkeypatch.setattr(settings, "settings_path", lambda: path)
    return path


def test_a_byte_order_mark_in_the_settings_is_passed_over(settings_file: Path) -> None:
    settings_file.write_bytes(codecs.BOM_UTF8 + b'catalogue = "shop.footfit"\r\n')
    assert settings.catalogue_path(None) == settings_file.parent / "shop.footfit"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b'catalog = "x"\n', "unknown key 'catalog'; did you mean catalogue"),
        (b'[footfit]\ncatalogue = "x"\n', "unknown key 'footfit'; it takes catalogue"),
        (b"catalogue = 3\n", "needs a line like"),
        (b"catalogue = x\n", "not valid TOML"),
        (b'catalogue = "C:\\Users\\x"\n', "write / in the place of"),
        (b'catalogue = "C:\\temp\\x"\n', "write / in the place of"),
        (b'catalogue = "~nobody_here/x"\n', "write the whole path"),
        ('catalogue = "x"\n'.encode("utf-16"), "save it as UTF-8"),
    ],
)
def test_a_mistake_in_the_settings_is_one_line_that_names_the_file(
    data: bytes, words: str, settings_file: Path, footfit: Footfit
) -> None:
    settings_file.write_bytes(data)
    run = footfit("list-lasts")
    assert (run.code, run.out) == (2, "")
    (line,) = run.err.splitlines()
    assert words in line
    assert str(settings_file) in line


def test_a_profile_with_a_byte_order_mark_is_the_same_profile(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(codecs.BOM_UTF8 + (FOLDER / "walking.toml").read_bytes())
    assert fit_profile(str(path)) == fit_profile("walking")


# ---------------------------------------------------------------- errors name their file


@pytest.mark.parametrize("bad_is_last", [True, False])
@pytest.mark.parametrize("content", [b"", b"v 1,5 2,5 3,5\nv 1 2 3\n", corpus.stl()])
def test_compare_names_the_bad_one_of_two_files(
    bad_is_last: bool, content: bytes, footfit: Footfit, foot: Path, tmp_path: Path
) -> None:
    bad = tmp_path / "bad.obj"
    bad.write_bytes(content)
    run = footfit("compare", *((foot, bad) if bad_is_last else (bad, foot)), "--json")
    assert run.code in (3, 5)
    assert json.loads(run.last_error)["path"] == str(bad)


@pytest.mark.parametrize("last", ["none.stl", "lasts/none"])
def test_a_missing_file_of_a_last_is_named(
    last: str, footfit: Footfit, foot: Path, stocked: Path
) -> None:
    run = footfit("compare", foot, last, "--catalogue", stocked, "--json")
    error = json.loads(run.last_error)
    assert (error["code"], error["path"]) == ("unreadable_file", last)
    bare = footfit("compare", foot, "none", "--catalogue", stocked, "--json")
    assert json.loads(bare.last_error)["code"] == "unknown_last"


def test_the_numbers_behind_a_refusal_come_with_verbose(footfit: Footfit, tmp_path: Path) -> None:
    cube = tmp_path / "cube.stl"
    cube.write_bytes(corpus.stl())
    short = footfit("measure", cube, "--known-length", 250)
    assert "cost" not in short.err
    long = footfit("measure", cube, "--known-length", 250, "--verbose")
    assert short.code == long.code == 5
    assert "neither a foot nor a last" in short.err
    assert "cost" in long.last_error


def test_the_details_of_an_error_survive_where_it_gets_its_path() -> None:
    error = NotAFoot("no foot", details="cost 0.5")
    assert error.at("x.stl").details == "cost 0.5"
    assert error.at(None) is error
    assert BadOption("no", "a").at("b").path == "a"
