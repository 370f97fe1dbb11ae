"""The commands that look after the lasts, from the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.conftest import SAMPLES, Footfit

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
