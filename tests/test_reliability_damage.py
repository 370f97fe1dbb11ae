"""Damage to the file, as the command line sees it: found, refused, never ranked."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from footfit.catalogue.checks.plausible_values import implausible
from footfit.catalogue.file.migrate import Schema
from footfit.catalogue.rows.verified_rows import LastRows, stored_lasts
from footfit.catalogue.store import open_catalogue
from tests import records
from tests.conftest import Footfit
from tests.torture.damage import HARMS, column_trials, damage_trials
from tests.torture.migrations import OLD_FILES, later_schema
from tests.torture.scripts import values

COUNTS = dict(zip(HARMS, (100, 20, 20, 10), strict=True))


@pytest.mark.parametrize("harm", HARMS)
def test_every_changed_value_is_found_and_none_is_ranked(tmp_path: Path, harm: str) -> None:
    tally = damage_trials(tmp_path, harm, COUNTS[harm], seed=3)
    assert tally.bad == []
    assert tally.struck >= COUNTS[harm] / 2  # the rest met unused bytes; measured: 65 % or more


def test_every_column_is_under_a_check(tmp_path: Path) -> None:
    tally = column_trials(tmp_path)
    assert tally.bad == []
    assert tally.trials > 80  # measured: 93; the tables' own rules refuse some changes


OBJECTS = {
    "the trigger t": "CREATE TRIGGER t AFTER INSERT ON last BEGIN DELETE FROM last; END",
    "the view v": "CREATE VIEW v AS SELECT 1",
    "the table more": "CREATE TABLE more (x)",
    "the table notice": "DROP TABLE notice",
    "the table reference": "UPDATE sqlite_schema SET sql = replace(sql, 'id = 1', 'id > 0')"
    " WHERE name = 'reference'",
    "the table frame": "UPDATE sqlite_schema SET sql = replace(sql, 'CASCADE', 'RESTRICT')"
    " WHERE name = 'frame'",
}


@pytest.mark.parametrize("named", OBJECTS)
def test_an_object_of_the_schema_that_is_not_footfits_is_found(
    footfit: Footfit, catalogue: Path, named: str
) -> None:
    connection = sqlite3.connect(catalogue)
    connection.execute("PRAGMA writable_schema = ON")
    connection.execute(OBJECTS[named])
    connection.commit()
    connection.close()
    run = footfit("check-catalogue", "--catalogue", catalogue, "--json")
    assert run.code == 7
    assert any(
        finding["code"] == "schema" and named in finding["message"]
        for finding in run.document["findings"]
    )


def test_check_says_that_a_sound_catalogue_is_sound(footfit: Footfit, stocked: Path) -> None:
    before = stocked.read_bytes()
    run = footfit("check-catalogue", "--catalogue", stocked)
    assert run.code == 0
    assert run.err == ""
    assert "sound" in run.out
    assert footfit("check-catalogue", "--catalogue", stocked, "--json").document["findings"] == []
    assert stocked.read_bytes() == before


def test_check_lists_what_is_damaged_and_match_leaves_it_out(
    footfit: Footfit, catalogue: Path, foot: Path
) -> None:
    whole = footfit("match", foot, "--catalogue", catalogue, "--json").document
    name = whole["candidates"][0]["last"]
    with sqlite3.connect(catalogue) as connection:
        (key,) = connection.execute("SELECT id FROM last WHERE name = ?", (name,)).fetchone()
        connection.execute("UPDATE frame SET length_mm = 262.5 WHERE last_id = ?", (key,))
        connection.execute("UPDATE mesh_copy SET data = x'00' WHERE last_id = ?", (key + 1,))
    connection.close()
    run = footfit("check-catalogue", "--catalogue", catalogue, "--json")
    found = {(finding["code"], finding["last"]) for finding in run.document["findings"]}
    assert run.code == 7
    assert {("last", name)} < found
    assert {code for code, _ in found} == {"last", "mesh_copy"}
    assert '"code":"check_failed"' in run.last_error
    match = footfit("match", foot, "--catalogue", catalogue, "--top", "99", "--json")
    assert match.code == 0
    assert name not in [candidate["last"] for candidate in match.document["candidates"]]
    assert "damaged_last" in [warning["code"] for warning in match.document["warnings"]]


def test_what_cannot_be_opened_is_exit_6(footfit: Footfit, catalogue: Path) -> None:
    catalogue.write_bytes(catalogue.read_bytes()[:5_000])
    run = footfit("check-catalogue", "--catalogue", catalogue)
    assert run.code == 6
    assert len(run.err.splitlines()) == 1


def test_a_mesh_copy_that_makes_no_mesh_is_found(footfit: Footfit, tmp_path: Path) -> None:
    """Its hash is right: it was stored like that."""
    path = tmp_path / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last(), records.mesh_copy())
        assert catalogue.findings() == []
    run = footfit("check-catalogue", "--catalogue", path, "--json")
    assert [finding["code"] for finding in run.document["findings"]] == ["mesh_copy"]


@pytest.mark.parametrize(
    ("table", "column", "value"),
    [
        ("last", "unit_scale", 0.0),
        ("last", "side", "middle"),
        ("last", "content_sha256", "abc"),
        ("frame", "length_mm", 26.0),
        ("frame", "eigenvectors", b"\0" * 72),
        ("frame", "centroid_mm", b"\0" * 16),
        ("frame", "canonical_transform", b"\0" * 128),
        ("flare", "angle_deg", 400.0),
        ("flare", "stations", b"\0" * 480),
        ("flare", "heading_deg", b"\0" * 8),
        ("flare", "definition", "{"),
        ("measures", "sd", -1.0),
    ],
)
def test_a_value_that_cannot_be_is_found_though_its_hash_is_right(
    tmp_path: Path, table: str, column: str, value: object
) -> None:
    with open_catalogue(tmp_path / "c", write=True) as catalogue:
        catalogue.add(records.last())
        (stored,) = stored_lasts(catalogue.file.connection)
    assert list(implausible(stored)) == []
    rows = stored.measures[0] if table == "measures" else getattr(stored, table)
    changed = {**rows, column: value}
    given = (changed,) if table == "measures" else changed
    parts = {name: getattr(stored, name) for name in LastRows.__slots__}
    wrong = LastRows(**{**parts, table: given})
    assert any(column in words or "curves" in words for words in implausible(wrong))


@pytest.mark.parametrize("column", ["type", "name", "tbl_name"])
def test_every_word_of_the_schema_is_under_a_check(
    footfit: Footfit, catalogue: Path, column: str
) -> None:
    """Also where SQLite keeps no SQL, and obeys none: the index behind a UNIQUE."""
    with closing(sqlite3.connect(catalogue)) as connection:
        (word,) = connection.execute(
            f"SELECT {column} FROM sqlite_schema WHERE name = 'sqlite_autoindex_last_2'"
        ).fetchone()
    data = catalogue.read_bytes()
    at = data.index(b"indexsqlite_autoindex_last_2last")
    at += {"type": 0, "name": 5, "tbl_name": 28}[column] + 3
    assert chr(data[at]) == word[3]
    catalogue.write_bytes(data[:at] + bytes([data[at] ^ 16]) + data[at + 1 :])
    assert footfit("check-catalogue", "--catalogue", catalogue).code in (6, 7)


@pytest.mark.parametrize("name", [None, 7, b"\xff\x00"])
def test_a_name_that_is_no_text_harms_no_other_last(
    footfit: Footfit, catalogue: Path, foot: Path, name: object
) -> None:
    """A torn page may leave a null where none can be stored."""
    with open_catalogue(catalogue) as opened:
        names = opened.names()
    laxly = "UPDATE sqlite_schema SET sql = ? WHERE name = 'last'"
    with closing(sqlite3.connect(catalogue, isolation_level=None)) as connection:
        (strict,) = connection.execute(
            "SELECT sql FROM sqlite_schema WHERE name = 'last'"
        ).fetchone()
        connection.execute("PRAGMA writable_schema = ON")
        connection.execute(laxly, [strict.replace(" NOT NULL", "")])
    with closing(sqlite3.connect(catalogue, isolation_level=None)) as connection:
        connection.execute("UPDATE last SET name = ? WHERE id = 2", [name])
        connection.execute("PRAGMA writable_schema = ON")
        connection.execute(laxly, [strict])
    here = ("--catalogue", catalogue, "--json")
    with open_catalogue(catalogue) as opened:
        assert len(opened.names()) == len(names)
    assert len(footfit("list-lasts", *here).document["lasts"]) == len(names) - 1
    assert footfit("catalogue-info", *here).document["lasts"] == len(names)
    assert footfit("check-catalogue", *here).code == 7
    matched = footfit("match", foot, *here)
    assert matched.code == 0
    assert "damaged" in matched.err


def test_every_schema_has_a_stored_file() -> None:
    assert [file.stem.partition("-")[2] for file in OLD_FILES] == list(Schema().revisions)


@pytest.mark.parametrize("stored", OLD_FILES, ids=lambda file: file.stem)
def test_a_stored_file_is_read_checked_and_upgraded(tmp_path: Path, stored: Path) -> None:
    """What a released schema stored is what every later one reads: value by value."""
    path = Path(shutil.copy(stored, tmp_path / "lasts.footfit"))
    with open_catalogue(path, older=True) as catalogue:
        assert [finding for finding in catalogue.findings() if finding.damage] == []
        names = catalogue.names()
    old = dict(values(path))
    with open_catalogue(path, write=True, schema=later_schema()) as catalogue:
        assert [finding for finding in catalogue.findings() if finding.damage] == []
        assert catalogue.names() == names
        assert [record.labels.name for record in catalogue.lasts().records] == list(names)
    new = dict(values(path))
    for table in old.keys() - {"alembic_version"}:
        width = len(old[table][0])
        assert [row[:width] for row in new[table]] == old[table], table
