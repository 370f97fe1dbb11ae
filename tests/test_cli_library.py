"""The commands that look after the lasts, from the command line."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import footfit as library
from footfit.catalogue.store import open_catalogue
from footfit.errors import BadOption
from footfit.results import Notice
from tests.conftest import SAMPLES, Footfit, Run

LAST = SAMPLES / "lasts" / "derby-38.stl"


# ---------------------------------------------------------------- where a new catalogue lies


def test_a_new_catalogue_is_said_once_with_its_path(footfit: Footfit, tmp_path: Path) -> None:
    place = tmp_path / "new.footfit"
    dry = footfit("ingest-last", LAST, "--catalogue", place, "--dry-run", "--json")
    assert dry.document["new_catalogue"] is None
    assert not place.exists()
    run = footfit("ingest-last", LAST, "--catalogue", place, "--json")
    assert run.document["new_catalogue"] == str(place)
    assert f"new catalogue: {place}" in run.err.splitlines()
    again = footfit("ingest-last", LAST, "--catalogue", place)
    assert "new catalogue" not in again.err
    assert footfit("remove-last", "derby-38", "--catalogue", place).code == 0
    empty = footfit("ingest-last", LAST, "--catalogue", place)
    assert "new catalogue" not in empty.err, "the file was there, without a last"
    assert "is now the reference" in empty.out


def test_no_catalogue_is_made_if_no_last_is_stored(footfit: Footfit, tmp_path: Path) -> None:
    place, junk = tmp_path / "typo.footfit", tmp_path / "junk.stl"
    junk.write_bytes(b"no mesh")
    for refused in (junk, tmp_path / "missing.stl"):
        run = footfit("ingest-last", refused, "--catalogue", place)
        assert run.code == 3, run.err
        assert "new catalogue" not in run.err
        assert not place.exists()
        assert run.out.split() == ["refused", str(refused)]
        assert len(run.err.splitlines()) == 1, "the reason is said once"
    run = footfit("ingest-last", junk, LAST, "--catalogue", place)
    assert run.err.count(f"new catalogue: {place}") == 1
    assert "is now the reference" in run.out


@pytest.mark.parametrize("by", ["option", "environment", "settings"])
@pytest.mark.parametrize("command", ["ingest", "dry run", "restore"])
def test_a_missing_folder_is_refused_and_nothing_is_made(
    footfit: Footfit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stocked: Path,
    by: str, command: str,
) -> None:  # fmt: skip
    config = tmp_path / "config"
    (config / "footfit").mkdir(parents=True)
    place, more = tmp_path / "typo" / "lasts.footfit", []
    if by == "option":
        more = ["--catalogue", str(place)]
    elif by == "environment":
        monkeypatch.setenv("FOOTFIT_CATALOGUE", str(place))
    else:
        monkeypatch.setenv("XDG_CONFIG_HOME", str(config))
        (config / "footfit" / "settings.toml").write_text(f'catalogue = "{place}"\n')
    words = {
        "ingest": ("ingest-last", LAST),
        "dry run": ("ingest-last", LAST, "--dry-run"),
        "restore": ("restore-catalogue", stocked),
    }
    run = footfit(*words[command], *more)
    assert (run.code, run.out) == (2, "")
    assert len(run.err.splitlines()) == 1
    assert f"the folder {place.parent} does not exist" in run.err
    assert [path.name for path in tmp_path.iterdir()] == ["config"]


def test_the_data_folder_is_made_for_the_first_catalogue(
    footfit: Footfit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    assert footfit("ingest-last", LAST, "--dry-run").code == 0
    assert not (tmp_path / "data").exists()
    run = footfit("ingest-last", LAST)
    assert run.code == 0
    made = tmp_path / "data" / "footfit" / "lasts.footfit"
    assert f"new catalogue: {made}" in run.err.splitlines()
    assert made.is_file()


# ---------------------------------------------------------------- the last one


def test_the_only_last_may_go_and_what_follows_is_said(footfit: Footfit, catalogue: Path) -> None:
    here = ("--catalogue", catalogue)
    document = footfit("list-lasts", *here, "--json").document
    reference = document["reference"]
    names = [last["last"] for last in document["lasts"]]
    refused = footfit("remove-last", reference, *here)
    assert refused.code == 2
    assert "choose another reference first" in refused.err
    for left, name in enumerate(name for name in reversed(names) if name != reference):
        run = footfit("remove-last", name, *here, "--json")
        assert run.document["left"] == len(names) - 1 - left
    run = footfit("remove-last", reference, *here)
    assert run.code == 0
    assert "the next last that you ingest becomes the reference" in " ".join(run.out.split())
    assert footfit("list-lasts", *here, "--json").document == {
        **document,
        "lasts": [],
        "reference": None,
    }
    assert footfit("check-catalogue", *here).code == 0


# ---------------------------------------------------------------- filters and order


def listed(run: Run) -> list[str]:
    """The names of the lasts in the order of the document."""
    return [last["last"] for last in run.document["lasts"]]


@pytest.mark.parametrize(
    ("given", "names"),
    [
        (("--style", "DERBY", "--size", "40"), ["derby-40"]),
        (("--width", "g", "--size", "39,0"), ["derby-39"]),
        (("--width", "E"), ["loafer-39", "loafer-40", "loafer-42", "loafer-43"]),
        (("--size", "42"), ["loafer-42", "trainer-42"]),
        (("--style", "none"), []),
    ],
)
def test_lasts_are_listed_by_their_labels(
    footfit: Footfit, stocked: Path, given: tuple[str, ...], names: list[str]
) -> None:
    here = ("--catalogue", stocked)
    run = footfit("list-lasts", *given, *here, "--json")
    assert (run.code, listed(run)) == (0, names)
    rows = footfit("list-lasts", *given, *here, "--csv", "-").out.splitlines()[1:]
    assert [row.partition(",")[0] for row in rows] == names
    shown = " ".join(footfit("list-lasts", *given, *here).out.split())
    assert f"{len(names)} of 14 lasts: " in shown


@pytest.mark.parametrize(
    ("sort", "key"),
    [
        ("size", lambda last: float(last["size"])),
        ("length", lambda last: last["length_mm"]),
        ("ball-girth", lambda last: last["ball_girth_mm"]),
        ("flare", lambda last: last["flare_angle_deg"]),
        ("heel", lambda last: last["heel_height_mm"]),
        ("name", lambda last: last["last"]),
    ],
)
def test_lasts_are_sorted(
    footfit: Footfit, stocked: Path, sort: str, key: Callable[[dict[str, Any]], float]
) -> None:
    run = footfit("list-lasts", "--sort", sort, "--catalogue", stocked, "--json")
    lasts = run.document["lasts"]
    assert len(lasts) == 14
    assert [key(last) for last in lasts] == sorted(map(key, lasts))


def test_what_has_no_value_comes_last(footfit: Footfit, catalogue: Path) -> None:
    here = ("--catalogue", catalogue)
    assert footfit("edit-last", "derby-38", "--size", "wide", *here).code == 0
    assert footfit("edit-last", "trainer-38", "--size", "10 1/2", *here).code == 0
    names = listed(footfit("list-lasts", "--sort", "size", *here, "--json"))
    assert (names[0], names[-1]) == ("trainer-38", "derby-38")


def test_an_order_that_is_not_known_is_refused(footfit: Footfit, stocked: Path) -> None:
    run = footfit("list-lasts", "--sort", "colour", "--catalogue", stocked)
    assert (run.code, len(run.err.splitlines())) == (2, 1)
    with pytest.raises(BadOption, match="name, size, length"):
        library.open_catalogue(stocked).lasts(sort="colour")


# ---------------------------------------------------------------- marks


@pytest.mark.parametrize(
    ("code", "letter", "words"),
    [
        ("side_contradicted", "S", "the other side"),
        ("low_side_confidence", "U", "the side is not sure"),
        ("looks_like_a_foot", "F", "nearer to a foot's"),
        ("suspect_flare", "O", "hardly any last has such a flare"),
        ("stance_label_contradicted", "H", "heel height, toe spring or platform"),
        ("open_end", "W", "another warning"),
        ("a_code_of_a_later_version", "W", "another warning"),
    ],
)
def test_every_stored_warning_is_marked(
    footfit: Footfit, catalogue: Path, code: str, letter: str, words: str
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        record = opened.record("derby-40")
        warned = replace(record, warnings=(Notice(code, "as it was said"),))
        opened.add(warned, opened.mesh_copy("derby-40"), replace=True)
    run = footfit("list-lasts", "--catalogue", catalogue)
    line = next(line for line in run.out.splitlines() if line.lstrip().startswith("derby-40"))
    assert line.split()[1] == letter
    legend = " ".join(run.out.split())
    assert f"{letter} " in legend
    assert words in legend
    assert "show-last NAME says more" in legend
    entries = footfit("list-lasts", "--catalogue", catalogue, "--json").document["lasts"]
    codes = {entry["last"]: [notice["code"] for notice in entry["warnings"]] for entry in entries}
    assert {name: found for name, found in codes.items() if found} == {"derby-40": [code]}


def test_a_sound_library_has_no_legend(footfit: Footfit, stocked: Path) -> None:
    assert "says more" not in footfit("list-lasts", "--catalogue", stocked).out


def test_ingest_says_a_wrong_size_and_counts_the_warned(footfit: Footfit, tmp_path: Path) -> None:
    manifest = tmp_path / "m.csv"
    lines = [f"{SAMPLES / 'lasts' / f'derby-{size}.stl'},{label},eu" for size, label in WRONG]
    manifest.write_text("\n".join(["path,size,size_system", *lines]) + "\n")
    command = ("ingest-last", "--manifest", manifest, "--catalogue", tmp_path / "c")
    run = footfit(*command, "--json")
    codes = [[notice["code"] for notice in line["warnings"]] for line in run.lines]
    assert codes == [[], ["size_contradicted"]]
    assert "derby-39.stl: labelled 5.9 sizes larger than its length: it is EU 39" in run.err
    assert "1 of 2 lasts have warnings; footfit list-lasts marks them" in run.err
    again = footfit(*command)
    assert "have warnings" not in again.err, "nothing new was stored"
    table = footfit("list-lasts", "--catalogue", tmp_path / "c").out
    assert "derby-39    L  -" in table


WRONG = ((38, 38), (39, 45))
"""The size of a sample last, and its label."""
