"""Changed bytes: every changed value is found, and no damaged last is ranked."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import CatalogueUnusable
from tests import records

LASTS = 6
FLIPS = 120


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


def columns(path: Path) -> Iterator[tuple[str, str]]:
    connection = sqlite3.connect(path)
    tables = ("last", "frame", "flare", "measure", "notice", "mesh_copy", "reference")
    for table in tables:
        for row in connection.execute(f"PRAGMA table_info({table})").fetchall():
            yield table, row[1]
    connection.close()


def test_a_sound_catalogue_has_no_findings(sound: Path) -> None:
    with open_catalogue(sound) as catalogue:
        assert catalogue.findings() == []
        assert catalogue.rows_for_search().damaged == ()


def test_a_change_of_any_column_is_found(sound: Path, tmp_path: Path) -> None:
    """Each column of each table, set to another value of its kind; keys and hashes as well."""
    changed = 0
    for table, column in columns(sound):
        copy = Path(shutil.copy(sound, tmp_path / "copy"))
        with sqlite3.connect(copy) as connection:
            connection.execute("PRAGMA ignore_check_constraints = ON")
            where = f"rowid = (SELECT max(rowid) FROM {table} WHERE {column} IS NOT NULL)"
            value = (
                f"CASE typeof({column}) WHEN 'text' THEN {column} || 'x' WHEN 'blob' THEN "
                f"zeroblob(length({column})) ELSE {column} + 1000 END"
            )
            done = connection.execute(f"UPDATE {table} SET {column} = {value} WHERE {where}")
            changed += done.rowcount
        connection.close()
        with open_catalogue(copy) as catalogue:
            # A column that is null in every last has nothing to change.
            assert bool(catalogue.findings()) == bool(done.rowcount), (table, column)
    assert changed > 55


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
        rows = catalogue.rows_for_search()
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
        assert catalogue.rows_for_search().damaged == ("last-2",)
        assert catalogue.findings()


def dump(catalogue: Catalogue) -> list[list[tuple[object, ...]]]:
    """Every value of every table, as SQLite reads it."""
    connection = catalogue.file.connection
    tables = ("last", "frame", "flare", "measure", "notice", "mesh_copy", "reference")
    return [connection.execute(f"SELECT * FROM {table}").fetchall() for table in tables]


def test_flipped_bits_are_found_and_never_ranked(sound: Path, tmp_path: Path) -> None:
    """Single bits anywhere in the file: wherever a value changed, a finding or a refusal."""
    generator = np.random.default_rng(20)
    data = sound.read_bytes()
    with open_catalogue(sound) as catalogue:
        truth = dump(catalogue)
        good = {r.labels.name: records.plain(r) for r in catalogue.records()}
    changed = missed = 0
    for bit in generator.integers(0, 8 * len(data), FLIPS):
        flipped = bytearray(data)
        flipped[bit // 8] ^= 1 << (bit % 8)
        copy = tmp_path / "flipped"
        copy.write_bytes(flipped)
        try:
            with open_catalogue(copy) as catalogue:
                differs = _differs(catalogue, truth)
                found = catalogue.findings()
                ranked = catalogue.rows_for_search().records
        except CatalogueUnusable:
            continue
        changed += differs
        missed += differs and not found
        for record in ranked:
            assert records.plain(record) == good[record.labels.name], f"bit {bit}"
    assert missed == 0
    assert changed > FLIPS / 4, "the flips must hit values, or this test shows nothing"


def _differs(catalogue: Catalogue, truth: object) -> bool:
    try:
        return dump(catalogue) != truth
    except (sqlite3.DatabaseError, UnicodeDecodeError):
        return True


@pytest.mark.parametrize("length", [1, 17, 99, 100, 4_095, 4_096, 20_000])
def test_a_truncated_file_is_refused_or_found(path: Path, length: int) -> None:
    path.write_bytes(path.read_bytes()[:length])
    try:
        with open_catalogue(path) as catalogue:
            assert catalogue.findings()
    except CatalogueUnusable:
        pass


def test_a_zeroed_page_is_refused_or_found(sound: Path, tmp_path: Path) -> None:
    data = sound.read_bytes()
    for page in range(len(data) // 4_096):
        copy = tmp_path / "zeroed"
        copy.write_bytes(data[: page * 4_096] + bytes(4_096) + data[(page + 1) * 4_096 :])
        try:
            with open_catalogue(copy) as catalogue:
                assert catalogue.findings(), f"page {page}"
        except CatalogueUnusable:
            pass


def test_a_damaged_reference_is_said_and_made_anew(path: Path) -> None:
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE reference SET om_e = zeroblob(72)")
    connection.close()
    with open_catalogue(path, write=True) as catalogue:
        assert [finding.code for finding in catalogue.findings()] == ["damaged"]
        assert len(catalogue.rows_for_search().records) == LASTS, "ranking needs no OM_E"
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
            ranked = catalogue.rows_for_search().records
            assert all(record.labels.style is None or old != "style" for record in ranked)
    except CatalogueUnusable:
        pass
