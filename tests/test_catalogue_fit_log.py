"""The fit log in the catalogue: what is stored, what damage does, and forgetting for good."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import CatalogueDamaged, UnknownFit
from footfit.pipeline.library.backup import back_up, restore
from tests import records
from tests.fits import entry


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A catalogue with two lasts and 40 entries of 20 wearers."""
    place = tmp_path / "lasts.footfit"
    with open_catalogue(place, write=True) as catalogue:
        for seed in range(2):
            catalogue.add(records.last(f"last-{seed}", seed))
        for seed in range(40):
            catalogue.fit_log.add(entry(seed, wearer=f"wearer-{seed % 20}"))
    return place


def change(path: Path, sql: str, *values: object) -> None:
    """Change the file as another program would."""
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(sql, values)


def test_entries_come_back_as_they_were(path: Path) -> None:
    with open_catalogue(path) as catalogue:
        stored = catalogue.fit_log.entries()
    assert stored == tuple(entry(seed, wearer=f"wearer-{seed % 20}") for seed in range(40))


@pytest.mark.parametrize(
    "given",
    [
        {"wearer": None, "side": None, "comfort": None, "outcome": None},
        {"wearer": "Žofia 7; DROP", "ratings": {}, "worn": {}, "zones": ()},
        {"outcome": "altered", "alteration": 'gestreckt +2 mm\n"ball"', "hours": 8.0, "days": 2.0},
    ],
)
def test_any_entry_comes_back(path: Path, given: dict[str, object]) -> None:
    strange = entry(77, **given)
    with open_catalogue(path, write=True) as catalogue:
        catalogue.fit_log.add(strange)
    with open_catalogue(path) as catalogue:
        assert catalogue.fit_log.entries()[-1] == strange
        assert catalogue.findings() == []


def test_an_entry_outlives_its_last(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue:
        catalogue.fit_log.add(entry(50, last="last-1"))
        catalogue.remove("last-1")
        assert catalogue.fit_log.entries()[-1].last == "last-1"
        assert catalogue.findings() == []


@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("ratings", '{"ball":2}'),
        ("comfort", 1.0),
        ("wearer", "other"),
        ("zones", "[]"),
        ("id", "x"),
    ],
)
def test_a_changed_entry_is_damage(path: Path, column: str, value: object) -> None:
    change(path, f"UPDATE fit SET {column} = ? WHERE number = 3", value)
    with open_catalogue(path) as catalogue:
        (finding,) = catalogue.findings()
        assert finding.code == "fit"
        with pytest.raises(CatalogueDamaged, match="forget-fits"):
            catalogue.fit_log.entries()


def test_values_that_cannot_be_are_found(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue:
        catalogue.fit_log.add(replace(entry(60), comfort=400.0))
        assert [finding.code for finding in catalogue.findings()] == ["range"]


def traces(folder: Path, words: list[str]) -> list[str]:
    """Which of the words stand in any file of a folder, as text or as the bytes of a hash."""
    content = b"".join(file.read_bytes() for file in folder.rglob("*") if file.is_file())
    return [word for word in words if word.encode() in content]


def signs_of(path: Path, wearer: str) -> list[str]:
    """All by which the entries of a wearer could be known."""
    with open_catalogue(path) as catalogue:
        gone = [e for e in catalogue.fit_log.entries() if e.wearer == wearer]
    with closing(sqlite3.connect(path)) as connection:
        select = "SELECT sha256 FROM fit WHERE wearer = ?"
        hashes = [str(digest) for (digest,) in connection.execute(select, (wearer,))]
    clearances = [repr(zone.clearance) for e in gone for zone in e.zones]
    return [wearer, *(e.id for e in gone), *(e.foot_sha256 for e in gone), *hashes, *clearances]


def test_forgetting_a_wearer_leaves_nothing_of_the_entries(path: Path, tmp_path: Path) -> None:
    signs = signs_of(path, "wearer-13")
    assert len(signs) == 1 + 2 * 3 + 10
    assert traces(tmp_path, signs) == signs
    with open_catalogue(path, write=True) as catalogue:
        assert catalogue.fit_log.forget("wearer-13").entries == 2
        assert catalogue.findings() == []
    back_up(path, tmp_path / "backup.footfit")
    assert traces(tmp_path, signs) == []
    with open_catalogue(path) as catalogue:
        assert len(catalogue.fit_log.entries()) == 38


def test_forgetting_leaves_nothing_even_before_the_file_is_written_anew(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    signs = signs_of(path, "wearer-13")
    with open_catalogue(path, write=True) as catalogue:
        monkeypatch.setattr(type(catalogue.file), "compact", lambda _: None)
        catalogue.fit_log.forget("wearer-13")
    assert traces(tmp_path, signs) == []


def test_one_entry_is_forgotten_by_its_id(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue:
        assert catalogue.fit_log.forget(entry(7).id).entries == 1
        left = [e.id for e in catalogue.fit_log.entries()]
    assert len(left) == 39
    assert entry(7).id not in left


def test_a_damaged_entry_can_be_forgotten(path: Path) -> None:
    change(path, "UPDATE fit SET ratings = 'x' WHERE number = 3")
    with open_catalogue(path, write=True) as catalogue:
        catalogue.fit_log.forget(entry(2).id)
        assert catalogue.findings() == []


def test_an_unknown_code_forgets_nothing(path: Path) -> None:
    before = path.read_bytes()
    with (
        open_catalogue(path, write=True) as catalogue,
        pytest.raises(UnknownFit, match="list-fits"),
    ):
        catalogue.fit_log.forget("nobody")
    assert path.read_bytes() == before


def test_a_backup_and_its_restoring_keep_the_log(path: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy.footfit"
    back_up(path, copy)
    with open_catalogue(path, write=True) as catalogue:
        catalogue.fit_log.forget("wearer-3")
    restore(path, copy)
    with open_catalogue(path) as catalogue:
        assert len(catalogue.fit_log.entries()) == 40


def test_a_failing_write_stores_nothing(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> str:
        raise OSError("the disk is gone")

    monkeypatch.setattr("footfit.catalogue.rows.writing.row_digest", fail)
    catalogue: Catalogue
    with open_catalogue(path, write=True) as catalogue:
        with pytest.raises(OSError, match="disk"):
            catalogue.fit_log.add(entry(99))
        assert len(catalogue.fit_log.entries()) == 40
