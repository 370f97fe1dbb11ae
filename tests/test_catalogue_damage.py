"""Changed bytes: every changed value is found, and no damaged last is ranked."""

from __future__ import annotations

import shutil
import sqlite3
from dataclasses import replace
from pathlib import Path

import pytest

from footfit.catalogue.file.dialect import driver_of
from footfit.catalogue.rows.columns import REFERENCE
from footfit.catalogue.rows.verified_rows import row_digest, rows
from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueUnusable
from tests import records

LASTS = 6


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A sound catalogue."""
    place = tmp_path_factory.mktemp("sound") / "lasts.footfit"
    with open_catalogue(place, write=True) as catalogue:
        for seed in range(LASTS):
            side = ("left", "right")[seed % 2]
            catalogue.add(records.last(f"last-{seed}", seed, side=side), records.mesh_copy(seed))
    return place


@pytest.fixture
def path(sound: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return Path(shutil.copy(sound, tmp_path / "lasts.footfit"))


def test_a_schema_number_that_does_not_fit_the_schema_is_found(path: Path) -> None:
    with sqlite3.connect(path) as connection:
        connection.execute("PRAGMA user_version = 1")
    connection.close()
    with open_catalogue(path) as catalogue:
        (finding,) = catalogue.findings()
    assert finding.code == "schema_mirror"
    assert finding.message.startswith("user_version is 1 and the schema is ")
    assert finding.damage


def test_a_sound_catalogue_has_no_findings(sound: Path) -> None:
    with open_catalogue(sound) as catalogue:
        assert catalogue.findings() == []
        assert catalogue.lasts().damaged == ()


def test_a_value_turned_null_or_of_another_type_is_found(path: Path) -> None:
    edits = (
        "UPDATE last SET width_label = NULL WHERE id = 2",
        "UPDATE last SET watertight = 3 - watertight WHERE id = 3",
        "UPDATE flare SET curvature_plan = CAST(curvature_plan AS TEXT) WHERE last_id = 4",
        "UPDATE last SET name = CAST(x'6c61ff' AS TEXT) WHERE id = 5",
    )
    with sqlite3.connect(path) as connection:
        for edit in edits:
            assert connection.execute(edit).rowcount == 1
    connection.close()
    with open_catalogue(path) as catalogue:
        rows = catalogue.lasts()
        found = {finding.last for finding in catalogue.findings() if finding.code == "last"}
    assert [record.labels.name for record in rows.records] == ["last-0", "last-5"]
    assert set(rows.damaged) == found == {"last-1", "last-2", "last-3", "la\\xff"}


def test_two_lasts_whose_rows_change_places_are_found(path: Path) -> None:
    """Each row is what was stored, but not where it was stored."""
    with sqlite3.connect(path) as connection:
        for table in ("flare", "mesh_copy"):
            for old, new in ((2, 99), (3, 2), (99, 3)):
                connection.execute(f"UPDATE {table} SET last_id = {new} WHERE last_id = {old}")
    connection.close()
    with open_catalogue(path) as catalogue:
        found = {(finding.code, finding.last) for finding in catalogue.findings()}
    assert found == {(code, f"last-{i}") for code in ("last", "mesh_copy") for i in (1, 2)}


@pytest.mark.parametrize("table", ["frame", "flare", "measure", "notice"])
def test_a_last_that_lost_a_row_is_not_ranked(path: Path, table: str) -> None:
    with sqlite3.connect(path) as connection:
        row = f"SELECT max(rowid) FROM {table} WHERE last_id = 3"
        connection.execute(f"DELETE FROM {table} WHERE rowid = ({row})")
    connection.close()
    with open_catalogue(path) as catalogue:
        assert catalogue.lasts().damaged == ("last-2",)
        assert catalogue.findings()


@pytest.mark.parametrize("length", [1, 17, 99, 100, 4_095, 4_096, 20_000])
def test_a_truncated_file_is_refused_or_found(path: Path, length: int) -> None:
    path.write_bytes(path.read_bytes()[:length])
    try:
        with open_catalogue(path) as catalogue:
            assert catalogue.findings()
    except CatalogueUnusable:
        pass


def test_a_damaged_reference_is_said_and_made_anew(path: Path) -> None:
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE reference SET om_e = zeroblob(72)")
    connection.close()
    with open_catalogue(path, write=True) as catalogue:
        assert [finding.code for finding in catalogue.findings()] == ["damaged"]
        assert len(catalogue.lasts().records) == LASTS, "ranking needs no OM_E"
        catalogue.set_reference("last-0")
        assert catalogue.findings() == []


def test_a_stale_paper_transform_is_found(sound: Path, path: Path) -> None:
    """Rows that are whole one by one, but not expressed by the reference that is there."""
    with open_catalogue(path, write=True) as catalogue:
        catalogue.set_reference("last-3")
    with sqlite3.connect(path) as connection:
        connection.execute(f"ATTACH '{sound}' AS old")
        connection.execute("DELETE FROM reference")
        connection.execute("INSERT INTO reference SELECT * FROM old.reference")
    connection.close()
    with open_catalogue(path) as catalogue:
        found = {(finding.code, finding.last) for finding in catalogue.findings()}
    assert found == {("paper_transform", f"last-{i}") for i in range(LASTS)}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("name", "nbme"),
        ("record_sha256", "record_sha257"),
        ("position", "pos\xed\xed\xed\xed\xed"),
        ("last_id", "lost_id"),
        ("style", "stylf"),
        ("curvature_bottom_80", "curvature_bottom_90"),  # null in every last
        ("sha256", "sha257"),
    ],
)
def test_a_flip_in_the_schema_itself_is_refused_or_found(path: Path, old: str, new: str) -> None:
    """The text of the schema is bytes of the file like any others."""
    data = path.read_bytes()
    path.write_bytes(data.replace(old.encode("latin-1"), new.encode("latin-1")))
    assert path.read_bytes() != data
    try:
        with open_catalogue(path) as catalogue:
            assert catalogue.findings()
            ranked = catalogue.lasts().records
            assert all(record.labels.style is None or old != "style" for record in ranked)
    except CatalogueUnusable:
        pass


def test_a_mesh_copy_that_cannot_be_is_found_though_its_hash_is_right(tmp_path: Path) -> None:
    with open_catalogue(tmp_path / "c", write=True) as catalogue:
        catalogue.add(records.last(), replace(records.mesh_copy(), faces=0))
        (finding,) = catalogue.findings()
    assert (finding.code, finding.last) == ("range", "oxford-42")
    assert finding.message == "mesh_copy.faces is 0; it must be above zero"


def test_a_reference_that_cannot_be_is_found_though_its_hash_is_right(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue, catalogue.file.atomic() as connection:
        driver = driver_of(connection)
        driver.execute("UPDATE reference SET om_e = zeroblob(72)")
        (row,) = rows(driver, REFERENCE)
        driver.execute("UPDATE reference SET sha256 = ?", (row_digest(REFERENCE, row),))
    with open_catalogue(path) as catalogue:
        findings = catalogue.findings()
    assert (findings[0].code, findings[0].last) == ("range", None)
    assert findings[0].message == "reference.om_e is 72 bytes; it must be a rotation"
    assert {finding.code for finding in findings[1:]} == {"paper_transform"}
