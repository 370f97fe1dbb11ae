"""Backup and restore, files that may not be written, files that are not ours: by the commands."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from footfit.catalogue.file.file_signature import SIGNATURE
from footfit.catalogue.store import open_catalogue
from tests import records
from tests.conftest import ROOT, Footfit
from tests.torture.migrations import OLD_FILE
from tests.torture.scripts import content
from tests.torture.signals import gone

WRITING = (
    ("set-reference", "LAST"),
    ("rename-last", "LAST", "another"),
    ("remove-last", "LAST"),
    ("upgrade-catalogue",),
    ("ingest-last", "SCAN"),
)
READING = (("list-lasts",), ("show-last", "LAST"), ("catalogue-info",), ("check-catalogue",))


def some_last(catalogue: Path) -> str:
    with open_catalogue(catalogue) as opened:
        return opened.names()[0]


# ------------------------------------------------------------------ backup and restore


def test_a_backup_is_the_same_catalogue(footfit: Footfit, stocked: Path, tmp_path: Path) -> None:
    backup = tmp_path / "backup.footfit"
    run = footfit("backup-catalogue", backup, "--catalogue", stocked, "--json")
    assert run.code == 0
    assert run.document["bytes"] == backup.stat().st_size
    assert content(backup) == content(stocked)
    assert list(tmp_path.iterdir()) == [backup]
    assert footfit("backup-catalogue", backup, "--catalogue", stocked).code == 2
    assert footfit("backup-catalogue", backup, "--catalogue", stocked, "--force").code == 0


def test_a_damaged_catalogue_takes_no_good_backups_place(
    footfit: Footfit, catalogue: Path, tmp_path: Path
) -> None:
    backup = tmp_path / "backup.footfit"
    assert footfit("backup-catalogue", backup, "--catalogue", catalogue).code == 0
    good = backup.read_bytes()
    with sqlite3.connect(catalogue) as connection:
        connection.execute("UPDATE last SET style = 'x' WHERE id = 3")
    connection.close()
    run = footfit("backup-catalogue", backup, "--catalogue", catalogue, "--force")
    assert run.code == 7
    assert "check-catalogue" in run.err
    assert backup.read_bytes() == good
    assert sorted(file.name for file in tmp_path.iterdir()) == [backup.name, catalogue.name]


@pytest.mark.parametrize("target", ["the catalogue", "a folder", "no folder"])
def test_a_backup_needs_a_place_of_its_own(
    footfit: Footfit, catalogue: Path, tmp_path: Path, target: str
) -> None:
    places = {"the catalogue": catalogue, "a folder": tmp_path, "no folder": tmp_path / "no" / "b"}
    before = catalogue.read_bytes()
    run = footfit("backup-catalogue", places[target], "--catalogue", catalogue, "--force")
    assert run.code == 2
    assert catalogue.read_bytes() == before


def test_a_restore_brings_the_backup_and_keeps_what_was_there(
    footfit: Footfit, catalogue: Path, tmp_path: Path
) -> None:
    backup, wanted = tmp_path / "backup.footfit", content(catalogue)
    footfit("backup-catalogue", backup, "--catalogue", catalogue)
    footfit("rename-last", some_last(catalogue), "renamed", "--catalogue", catalogue)
    before = catalogue.read_bytes()
    run = footfit("restore-catalogue", backup, "--catalogue", catalogue, "--json")
    kept = Path(run.document["kept"])
    assert content(catalogue) == wanted
    assert kept.read_bytes() == before
    again = footfit("restore-catalogue", kept, "--catalogue", catalogue, "--json").document["kept"]
    assert content(Path(again)) == wanted
    assert "renamed" in footfit("list-lasts", "--catalogue", catalogue).out


def test_a_restore_where_there_is_nothing_makes_the_catalogue(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    place = tmp_path / "new folder" / "lasts.footfit"
    refused = footfit("restore-catalogue", stocked, "--catalogue", place)
    assert (refused.code, list(tmp_path.iterdir())) == (2, [])
    place.parent.mkdir()
    run = footfit("restore-catalogue", stocked, "--catalogue", place, "--json")
    assert run.document["kept"] is None
    assert content(place) == content(stocked)
    assert [file.name for file in place.parent.iterdir()] == [place.name]


def test_a_program_that_has_it_open_goes_on_with_the_restored_one(
    footfit: Footfit, catalogue: Path, stocked: Path
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        opened.add(records.last("before", 90), None)
        code = "import sys; from footfit.cli.app import main; main()"
        arguments = ["restore-catalogue", str(stocked), "--catalogue", str(catalogue)]
        subprocess.run([sys.executable, "-c", code, *arguments], check=True, capture_output=True)
        assert "before" not in opened.names()
        opened.add(records.last("after", 91), None)
    with open_catalogue(catalogue) as opened:
        assert "after" in opened.names()
        assert opened.findings() == []


@pytest.mark.parametrize("harm", ["a value", "cut short", "text", "missing", "a folder"])
def test_a_bad_backup_is_refused_before_anything_is_touched(
    footfit: Footfit, catalogue: Path, tmp_path: Path, harm: str
) -> None:
    backup = tmp_path / "backup"
    shutil.copy(catalogue, backup)
    if harm == "a value":
        with sqlite3.connect(backup) as connection:
            connection.execute("UPDATE mesh_copy SET error_mm = error_mm + 1 WHERE last_id = 2")
        connection.close()
    elif harm == "cut short":
        os.truncate(backup, backup.stat().st_size - 5_000)
    elif harm == "text":
        backup.write_text("no catalogue")
    else:
        backup.unlink()
        if harm == "a folder":
            backup.mkdir()
    before, files = catalogue.read_bytes(), sorted(tmp_path.iterdir())
    run = footfit("restore-catalogue", backup, "--catalogue", catalogue)
    assert run.code in {"a value": (7,), "cut short": (6, 7), "missing": (3,)}.get(harm, (6,))
    assert len(run.err.splitlines()) == 1
    assert "backup" in run.err
    assert catalogue.read_bytes() == before
    assert sorted(tmp_path.iterdir()) == files


def test_an_older_backup_is_brought_up_to_date(footfit: Footfit, tmp_path: Path) -> None:
    place, before = tmp_path / "lasts.footfit", OLD_FILE.read_bytes()
    run = footfit("restore-catalogue", OLD_FILE, "--catalogue", place, "--json")
    assert run.code == 0
    assert run.document["lasts"] == 4
    assert OLD_FILE.read_bytes() == before
    assert list(tmp_path.iterdir()) == [place]
    assert footfit("list-lasts", "--catalogue", place).code == 0


def test_a_restore_writes_over_no_foreign_file(
    footfit: Footfit, stocked: Path, tmp_path: Path
) -> None:
    place = tmp_path / "thesis.txt"
    place.write_text("years of work")
    run = footfit("restore-catalogue", stocked, "--catalogue", place)
    assert run.code == 6
    assert "move the file away" in run.err
    assert place.read_text() == "years of work"
    assert list(tmp_path.iterdir()) == [place]


def test_a_restore_writes_over_no_newer_catalogue(
    footfit: Footfit, catalogue: Path, stocked: Path
) -> None:
    with sqlite3.connect(catalogue) as connection:
        connection.execute("PRAGMA user_version = 907")
    connection.close()
    before, files = catalogue.read_bytes(), sorted(catalogue.parent.iterdir())
    run = footfit("restore-catalogue", stocked, "--catalogue", catalogue, "--json")
    assert (run.code, json.loads(run.last_error)["code"]) == (6, "newer_catalogue")
    for words in ("0907", SIGNATURE.revisions[-1], "move the file away"):
        assert words in run.last_error
    assert catalogue.read_bytes() == before
    assert sorted(catalogue.parent.iterdir()) == files


def test_a_restore_over_a_wreck_keeps_the_wreck(
    footfit: Footfit, catalogue: Path, stocked: Path
) -> None:
    data = bytearray(catalogue.read_bytes())
    data[200 : len(data) // 2] = bytes(len(data) // 2 - 200)
    catalogue.write_bytes(data)
    run = footfit("restore-catalogue", stocked, "--catalogue", catalogue, "--json")
    assert run.code == 0
    assert Path(run.document["kept"]).read_bytes() == bytes(data)
    assert content(catalogue) == content(stocked)


# ------------------------------------------------------------------ what may not be written


def without_override(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Run the command so that mode bits bind it, as they do everyone but root."""
    command = [sys.executable, "-m", "footfit", *map(str, arguments)]
    if os.geteuid() == 0:
        if shutil.which("setpriv") is None:
            pytest.skip("root ignores mode bits and there is no setpriv")
        command = ["setpriv", "--bounding-set", "-dac_override,-dac_read_search", *command]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)


def filled_in(words: tuple[str, ...], catalogue: Path) -> list[str]:
    scan = sorted((ROOT / "sample_data").rglob("*.stl"))[0]
    known = {"LAST": some_last(catalogue), "SCAN": str(scan)}
    return [known.get(word, word) for word in words]


@pytest.mark.parametrize("read_only", ["file", "folder"])
def test_a_read_only_catalogue_is_read_and_not_written(
    catalogue: Path, tmp_path: Path, foot: Path, read_only: str
) -> None:
    shop = tmp_path / "shop"
    shop.mkdir()
    place = Path(shutil.move(catalogue, shop / "lasts.footfit"))
    name, before = some_last(place), place.read_bytes()
    write = [without_override, *filled_in(WRITING[1], place)][1:]
    (place if read_only == "file" else shop).chmod(0o444 if read_only == "file" else 0o555)
    try:
        matched = without_override("match", foot, "--catalogue", place, "--json")
        exported = without_override(
            "export-last", name, "-o", tmp_path / "last.stl", "--catalogue", place
        )
        checked = without_override("check-catalogue", "--catalogue", place)
        written = without_override(*write, "--catalogue", place)
    finally:
        shop.chmod(0o755)
    assert (matched.returncode, exported.returncode, checked.returncode) == (0, 0, 0)
    assert written.returncode == 6
    assert len(written.stderr.splitlines()) == 1
    assert place.read_bytes() == before
    assert list(shop.iterdir()) == [place]


# ------------------------------------------------------------------ what is not ours, or newer


@pytest.mark.parametrize("words", [*READING, *WRITING], ids=" ".join)
@pytest.mark.parametrize("kind", ["foreign", "newer"])
def test_every_command_refuses_what_it_does_not_know_and_leaves_it(
    footfit: Footfit, catalogue: Path, words: tuple[str, ...], kind: str
) -> None:
    arguments = filled_in(words, catalogue)
    if kind == "foreign":
        catalogue.write_bytes(b"SQLite format 3\0" + bytes(5_000))
    else:
        with sqlite3.connect(catalogue) as connection:
            connection.execute("PRAGMA user_version = 907")
        connection.close()
    before, files = catalogue.read_bytes(), sorted(catalogue.parent.iterdir())
    run = footfit(*arguments, "--catalogue", catalogue)
    assert run.code == 6
    assert len(run.err.splitlines()) == 1
    assert kind != "newer" or ("0907" in run.err and SIGNATURE.revisions[-1] in run.err)
    assert catalogue.read_bytes() == before
    assert sorted(catalogue.parent.iterdir()) == files


@pytest.mark.parametrize(
    ("words", "code"),
    [(("align", "SCANS", "--json"), 0), (("ingest-last", "SCANS", "--json", "--style", "s"), 2)],
    ids=["align", "ingest-last"],
)
def test_a_reader_that_goes_ends_the_work_in_words_and_leaves_no_process(
    tmp_path: Path, words: tuple[str, ...], code: int
) -> None:
    """``footfit ... | head -1``: reading is done, storing is not."""
    scans = str(ROOT / "sample_data" / "lasts")
    place = tmp_path / "lasts.footfit"
    command = [sys.executable, "-m", "footfit", *(w if w != "SCANS" else scans for w in words)]
    process = subprocess.Popen(
        [*command, *(["--catalogue", str(place)] if code else []), "--quiet"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    first = process.stdout.readline()
    process.stdout.close()
    said = process.stderr.read().decode()
    assert process.wait(60) == code, said
    assert json.loads(first)
    assert len(said.splitlines()) == (code != 0), said
    assert gone(process.pid)
    if code:
        with open_catalogue(place) as catalogue:
            assert json.loads(first)["last"] in catalogue.names()
            assert catalogue.findings() == []


def test_a_full_stderr_changes_no_answer(stocked: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("there is no /dev/full")
    with Path("/dev/full").open("wb") as full:
        command = [sys.executable, "-m", "footfit", "show-last", "none", "--catalogue", stocked]
        done = subprocess.run(command, stderr=full, stdout=subprocess.PIPE, check=False)
    assert (done.returncode, done.stdout) == (4, b"")


def test_a_full_stdout_is_said(stocked: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("there is no /dev/full")
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "footfit", "list-lasts", "--catalogue", str(stocked)],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=ROOT,
            check=False,
        )
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert "stdout" in done.stderr
