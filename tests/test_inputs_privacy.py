"""The same bytes every time, nothing kept of a foot, nothing told of the machine."""

from __future__ import annotations

import getpass
import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from footfit.pipeline.batch.runs import HERE, outcome_groups
from footfit.pipeline.library import ingest
from footfit.pipeline.library.entries import Entry
from tests.conftest import SAMPLES, Footfit

ROOT = Path(__file__).resolve().parents[1]


def run(folder: Path, *arguments: object, seed: int = 0) -> bytes:
    """The command line in a process of its own, at home in ``folder``; its stdout."""
    home = {"HOME": str(folder / "home"), "TMPDIR": str(folder / "tmp")}
    for place in home.values():
        Path(place).mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, **home, "PYTHONHASHSEED": str(seed), "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "footfit", *(str(argument) for argument in arguments)]
    done = subprocess.run(command, capture_output=True, cwd=folder, env=environment)
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout


def answers(folder: Path, stocked: Path, jobs: int, seed: int) -> list[bytes]:
    """Everything that a match of two feet and the ingest of two lasts give."""
    folder.mkdir()
    shutil.copytree(SAMPLES / "feet", folder / "feet")
    for path in sorted((SAMPLES / "lasts").iterdir())[:2]:
        shutil.copy(path, folder)
    shutil.copy(stocked, folder / "shop.footfit")
    more = ("--jobs", jobs, "--catalogue", "shop.footfit")
    found = [run(folder, "match", "feet", "--json", "--csv", "m.csv", *more, seed=seed)]
    found.append(run(folder, "match", "feet/mh007_L.stl", "--html", "m.html", *more, seed=seed))
    mine = ("--catalogue", "mine.footfit")
    found.append(run(folder, "ingest-last", ".", "--json", "--jobs", jobs, *mine, seed=seed))
    found += [(folder / name).read_bytes() for name in ("m.csv", "m.html")]
    with sqlite3.connect(folder / "mine.footfit") as connection:
        return [*found, "\n".join(connection.iterdump()).encode()]


def test_jobs_and_hash_seeds_change_no_byte(tmp_path, stocked, foot):
    first = answers(tmp_path / "one", stocked, jobs=1, seed=1)
    second = answers(tmp_path / "two", stocked, jobs=2, seed=4242)
    for one, other in zip(first, second, strict=True):
        assert one == other
    for folder in (tmp_path / "one", tmp_path / "two"):
        left = [path for path in (folder / "home").rglob("*") if path.is_file()]
        assert all("matplotlib" in path.parts for path in left)  # its list of the fonts here
        assert not list((folder / "tmp").rglob("*"))
    page = first[4].decode()
    assert "mh007_L" in page  # the file's name is the customer's label; the folders are not
    for told in (str(tmp_path), str(ROOT), f"{os.sep}{getpass.getuser()}/"):
        assert told not in page
    assert b'"path":"feet/mh007_L.stl"' in first[0]  # as it was given, and no longer
    kept = first[5].decode()
    assert str(tmp_path) not in kept
    assert "feet" not in kept


def test_a_match_leaves_the_catalogue_as_it_was(footfit: Footfit, foot: Path, catalogue: Path):
    before = catalogue.read_bytes()
    run_ = footfit("match", foot, "--catalogue", catalogue, "--json")
    assert run_.code == 0
    assert catalogue.read_bytes() == before
    assert sorted(path.name for path in catalogue.parent.iterdir()) == [catalogue.name]
    assert "forgotten" in footfit("catalogue-info", "--catalogue", catalogue).out
    kept = footfit("catalogue-info", "--catalogue", catalogue, "--json").document
    assert kept["feet_kept"] == 0
    of_lasts = {"last", "frame", "flare", "measure", "notice", "mesh_copy", "section", "reference"}
    assert set(kept["kept"]) == of_lasts | {"fit", "parentage", "search_block"}
    assert kept["kept"]["fit"] == 0, "the fit log, which only record-fit writes, with consent"
    with sqlite3.connect(catalogue) as connection:
        names = {name for (name,) in connection.execute("SELECT name FROM sqlite_schema")}
    assert not {name for name in names if "foot" in name or "feet" in name or "customer" in name}


def test_a_file_that_takes_too_long_is_named_and_the_rest_is_stored(
    footfit: Footfit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """The alarm rings while the second of three lasts is worked on (test_pipeline_batch.py lets
    time pass, kills workers and fills memory)."""
    for path in sorted((SAMPLES / "lasts").iterdir())[:3]:
        shutil.copy(path, tmp_path)
    slow = sorted(tmp_path.iterdir())[1].name
    usual = ingest.ready_last

    def ready_last(entry: Entry, **options: Any) -> ingest.ReadyLast:
        if entry.path and entry.path.endswith(slow):
            signal.raise_signal(signal.SIGALRM)
        return usual(entry, **options)

    monkeypatch.setattr(ingest, "ready_last", ready_last)

    def in_this_process(work, items, _, **more):
        return outcome_groups(work, items, HERE, **more)

    monkeypatch.setattr(ingest, "outcome_groups", in_this_process)
    got = footfit("ingest-last", tmp_path, "--catalogue", tmp_path / "c", "--json")
    status = {Path(line["path"]).name: line["status"] for line in got.lines if "status" in line}
    assert status.pop(slow) == "refused"
    assert list(status.values()) == ["added", "added"]
    error = json.loads(got.last_error)
    assert (got.code, error["code"]) == (3, "too_slow")
    assert "longer than 60 s" in error["message"]
