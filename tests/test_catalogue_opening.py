"""Missing, foreign, newer, held and read-only files: said in words, and left as they are."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import shutil
import sqlite3
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from footfit.catalogue.file import opening
from footfit.catalogue.file.engine import connect
from footfit.catalogue.store import open_catalogue
from footfit.errors import (
    BadOption,
    CatalogueDamaged,
    CatalogueLocked,
    CatalogueNotWritable,
    FootfitError,
    NoCatalogue,
    NotACatalogue,
)
from tests import records

NOBODY = 65534


@pytest.fixture
def path() -> Iterator[Path]:
    """A catalogue of two lasts in a folder that every user may enter."""
    folder = Path(tempfile.mkdtemp(prefix="footfit-"))
    folder.chmod(0o755)
    place = folder / "lasts.footfit"
    with open_catalogue(place, write=True) as catalogue:
        for seed in range(2):
            catalogue.add(records.last(f"last-{seed}", seed), records.mesh_copy(seed))
    yield place
    folder.chmod(0o755)
    shutil.rmtree(folder)


@pytest.mark.parametrize("name", ["none", "no/folder/none", "empty"])
def test_reading_makes_nothing(tmp_path: Path, name: str) -> None:
    (tmp_path / "empty").touch()
    with pytest.raises(NoCatalogue, match="ingest-last"), open_catalogue(tmp_path / name):
        pass
    assert [file.name for file in tmp_path.iterdir()] == ["empty"]
    assert (tmp_path / "empty").stat().st_size == 0


@pytest.mark.parametrize("name", ["none", "no/folder/none", "empty"])
def test_an_edit_of_nothing_makes_nothing(tmp_path: Path, name: str) -> None:
    (tmp_path / "empty").touch()
    with (
        pytest.raises(NoCatalogue, match="ingest-last"),
        open_catalogue(tmp_path / name, write=True, create=False),
    ):
        pass
    assert [file.name for file in tmp_path.iterdir()] == ["empty"]


def test_writing_makes_the_file_in_a_folder_of_any_name(tmp_path: Path) -> None:
    place = tmp_path / "a %41 folder?" / "lästs#1.footfit"
    place.parent.mkdir()
    with open_catalogue(place, write=True) as catalogue:
        assert catalogue.names() == ()
    (tmp_path / "empty").touch()
    for there in (place, tmp_path / "empty"):
        with open_catalogue(there, write=True) as catalogue:
            catalogue.add(records.last())
        with open_catalogue(there) as catalogue:
            assert catalogue.names() == ("oxford-42",)
    assert [file.name for file in place.parent.iterdir()] == [place.name]


@pytest.mark.parametrize("folder", ["none", "none/below"])
def test_no_folder_is_made_for_a_catalogue(tmp_path: Path, folder: str) -> None:
    with (
        pytest.raises(BadOption, match=r"folder .* does not exist: check the path"),
        open_catalogue(tmp_path / folder / "lasts", write=True),
    ):
        pass
    assert not list(tmp_path.iterdir())


def test_a_file_in_place_of_the_folder_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    with (
        pytest.raises(CatalogueNotWritable, match="Not a directory"),
        open_catalogue(tmp_path / "file" / "lasts", write=True),
    ):
        pass


def foreign_database(place: Path, *statements: str) -> None:
    other = sqlite3.connect(place)
    for statement in statements:
        other.execute(statement)
    other.commit()
    other.close()


def folder(place: Path) -> None:
    place.mkdir()


FOREIGN: dict[str, Callable[[Path], object]] = {
    "text": lambda place: place.write_text("path,name\nx.stl,x\n"),
    "one byte": lambda place: place.write_bytes(b"S"),
    "stl": lambda place: place.write_bytes(bytes(84) + bytes(5_000)),
    "header only": lambda place: place.write_bytes(b"SQLite format 3\0"),
    "database": lambda place: foreign_database(place, "CREATE TABLE last (id, name)"),
    "marked database": lambda place: foreign_database(
        place, "PRAGMA application_id = 7", "CREATE TABLE t (x)"
    ),
    "wal database": lambda place: foreign_database(
        place, "PRAGMA journal_mode = WAL", "CREATE TABLE t (x)"
    ),
}


@pytest.mark.parametrize("write", [False, True])
@pytest.mark.parametrize("kind", FOREIGN)
def test_a_foreign_file_is_refused_untouched(tmp_path: Path, kind: str, write: bool) -> None:
    place = tmp_path / "thing"
    FOREIGN[kind](place)
    before = place.read_bytes()
    with pytest.raises(NotACatalogue), open_catalogue(place, write=write):
        pass
    assert place.read_bytes() == before
    assert list(tmp_path.iterdir()) == [place]


@pytest.mark.parametrize("write", [False, True])
def test_what_is_no_file_is_refused_at_once(tmp_path: Path, write: bool) -> None:
    os.mkfifo(tmp_path / "fifo")
    for place in (tmp_path, tmp_path / "fifo"):
        with pytest.raises(NotACatalogue, match="regular file"), open_catalogue(place, write=write):
            pass


@pytest.mark.parametrize("write", [False, True])
def test_a_catalogue_cut_short_is_damaged(path: Path, write: bool) -> None:
    os.truncate(path, 8_192)
    with pytest.raises(CatalogueDamaged), open_catalogue(path, write=write) as catalogue:
        catalogue.lasts()


@pytest.mark.parametrize("write", [False, True])
def test_a_catalogue_without_its_tables_is_damaged(path: Path, write: bool) -> None:
    foreign_database(path, "DROP TABLE alembic_version")
    with pytest.raises(CatalogueDamaged, match="lacks"), open_catalogue(path, write=write):
        pass


def test_a_held_catalogue_is_locked_after_the_timeout(path: Path) -> None:
    other = connect(path, "rw")
    other.execute("BEGIN IMMEDIATE")
    with open_catalogue(path, busy_timeout_s=0.05) as catalogue:
        assert len(catalogue.lasts().records) == 2, "readers go on while another one writes"
    with (
        pytest.raises(CatalogueLocked, match="another program"),
        open_catalogue(path, write=True, busy_timeout_s=0.05),
    ):
        pass
    other.execute("ROLLBACK")
    with open_catalogue(path, write=True, busy_timeout_s=0.05) as catalogue:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(CatalogueLocked):
            catalogue.add(records.last("late", 5))
        other.execute("ROLLBACK")
        catalogue.add(records.last("late", 5))
        other.execute("BEGIN EXCLUSIVE")
        with pytest.raises(CatalogueLocked):
            catalogue.names()
        with pytest.raises(CatalogueLocked), open_catalogue(path, busy_timeout_s=0.05):
            pass
    other.close()


def test_a_reader_that_stays_does_not_lose_a_writer_its_last(path: Path) -> None:
    """The commit itself may meet a reader: it is refused whole, and can be tried again."""
    reader = connect(path, "ro")
    reader.execute("BEGIN")
    reader.execute("SELECT count(*) FROM last").fetchone()
    with open_catalogue(path, write=True, busy_timeout_s=0.05) as catalogue:
        with pytest.raises(CatalogueLocked):
            catalogue.add(records.last("late", 5))
        reader.close()
        assert "late" not in catalogue.names()
        catalogue.add(records.last("late", 5))
        assert catalogue.findings() == []


def test_a_full_disk_is_said_and_loses_nothing(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue:
        pages = catalogue.file.connection.execute("PRAGMA page_count").fetchone()[0]
        catalogue.file.connection.execute(f"PRAGMA max_page_count = {pages}")
        with pytest.raises(CatalogueNotWritable, match="full"):
            catalogue.add(records.last("big", 5), records.mesh_copy(5, 200_000))
        assert catalogue.names() == ("last-0", "last-1")
        catalogue.file.connection.execute("PRAGMA max_page_count = 1000000")
        catalogue.add(records.last("big", 5), records.mesh_copy(5, 200_000))
        assert catalogue.findings() == []


# ------------------------------------------------------------------ as a user without rights


def _run(function: Callable[[], str], answers: object) -> None:
    if os.getuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
    try:
        answer = function()
    except FootfitError as error:
        answer = f"{type(error).__name__}: {error}"
    answers.put(answer)


def without_rights(function: Callable[[], str]) -> str:
    """What a function says when it may not write: as another user where we are root."""
    context = multiprocessing.get_context("fork")
    answers = context.SimpleQueue()
    process = context.Process(target=_run, args=(function, answers))
    process.start()
    process.join(60)
    assert process.exitcode == 0
    return str(answers.get())


def read(path: Path) -> str:
    with open_catalogue(path) as catalogue:
        lasts, copy = catalogue.lasts().records, catalogue.mesh_copy("last-0")
        return f"{len(lasts)} lasts, {len(copy.data)} bytes"


def write(path: Path) -> str:
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("new", 9))
        return "written"


def opened(path: Path) -> str:
    """Said at once: not after the first scan was aligned in vain."""
    with open_catalogue(path, write=True):
        return "open"


@pytest.mark.parametrize("read_only", ["file", "folder", "both"])
def test_a_read_only_catalogue_can_be_read(path: Path, read_only: str) -> None:
    for module in ("alembic.command", "sqlalchemy.orm"):  # the other user may not be able to
        importlib.import_module(module)
    path.chmod(0o666 if read_only == "folder" else 0o444)
    path.parent.chmod(0o777 if read_only == "file" else 0o555)
    before = path.read_bytes()
    assert without_rights(lambda: read(path)) == "2 lasts, 2000 bytes"
    assert without_rights(lambda: opened(path)).startswith("CatalogueNotWritable: ")
    assert path.read_bytes() == before
    assert list(path.parent.iterdir()) == [path]


def test_a_new_catalogue_in_a_read_only_folder_is_refused(path: Path) -> None:
    path.parent.chmod(0o555)
    answer = without_rights(lambda: write(path.parent / "new"))
    assert answer.startswith("CatalogueNotWritable: ")
    assert list(path.parent.iterdir()) == [path]


def test_a_file_that_may_not_be_read_is_said(path: Path) -> None:
    path.chmod(0)
    assert without_rights(lambda: read(path)).startswith("CatalogueNotWritable: cannot be read")


def test_a_catalogue_that_cannot_be_made_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("planted")

    monkeypatch.setattr(opening, "create", fail)
    with pytest.raises(RuntimeError, match="planted"), open_catalogue(tmp_path / "c", write=True):
        pass
