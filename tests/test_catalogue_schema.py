"""The schema: models, migrations and SQLite's settings say the same."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from footfit.catalogue.file.engine import connect, engine_on
from footfit.catalogue.file.file_signature import SIGNATURE
from footfit.catalogue.file.migrate import Revisions, Schema, copy_path, create, migrations_folder
from footfit.catalogue.rows.columns import TABLES, Column, Table
from footfit.catalogue.rows.schema import METADATA
from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged, CatalogueUnusable, NewerCatalogue
from tests import records

HEAD = SIGNATURE.revisions[-1]
NEXT = f"{int(HEAD) + 1:04d}"
SECOND = '''
"""A column more."""
import sqlalchemy as sa
from alembic import op

revision = {revision!r}
down_revision = {down!r}


def upgrade():
    with op.batch_alter_table("last", recreate="always") as batch:
        batch.add_column(sa.Column("colour", sa.String))
    {then}
'''


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A catalogue of three lasts."""
    place = tmp_path / "lasts.footfit"
    with open_catalogue(place, write=True) as catalogue:
        for seed in range(3):
            catalogue.add(records.last(f"last-{seed}", seed), records.mesh_copy(seed))
    return place


def later_schema(folder: Path, then: str = "") -> Schema:
    """A schema one revision on, in a copy of the migrations."""
    shutil.copytree(migrations_folder(), folder, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "versions" / f"{NEXT}_colour.py").write_text(
        SECOND.format(revision=NEXT, down=HEAD, then=then or "pass")
    )
    return Schema((*SIGNATURE.revisions, NEXT), folder)


def test_the_migrations_make_what_the_models_say(path: Path) -> None:
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    engine = engine_on(connect(path, "ro"))
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, METADATA) == []


def test_names_of_keys_and_rules_agree_between_models_and_migrations(
    path: Path, tmp_path: Path
) -> None:
    """Alembic compares no primary keys, checks or rules of deletion: SQLite's own words do."""
    direct = sqlite3.connect(tmp_path / "direct.db")
    direct.isolation_level = None
    with engine_on(direct).connect() as connection, connection.begin():
        METADATA.create_all(connection)
    migrated = sqlite3.connect(path)
    for table in METADATA.tables:
        for pragma in ("table_info", "foreign_key_list", "index_list"):
            select = f"PRAGMA {pragma}({table})"
            assert migrated.execute(select).fetchall() == direct.execute(select).fetchall()
    with pytest.raises(sqlite3.IntegrityError, match="CHECK"):
        migrated.execute("INSERT INTO reference VALUES (2, 1, x'', x'', '')")


COLUMNS = [(table, column) for table in TABLES for column in table.columns]


def test_the_migrated_tables_have_the_columns_of_the_table_of_columns(path: Path) -> None:
    """Also their order, which SQLAlchemy's tables take from there."""
    with closing(sqlite3.connect(path)) as connection:
        migrated = [
            (table.name, name, bool(required), bool(key))
            for table in TABLES
            for _, name, _, required, _, key in connection.execute(
                f"PRAGMA table_info({table.name})"
            )
        ]
    assert migrated == [(t.name, c.name, not c.nullable, c.key) for t, c in COLUMNS]


def test_the_writer_adds_keys_hashes_and_the_version_alone() -> None:
    """Every other value comes from a record, and says where in it."""
    added = {column.name for _, column in COLUMNS if not column.path}
    assert added == {
        *("id", "last_id", "number", "parent_id", "position"),
        *("footfit_version", "record_sha256", "sha256"),
        *("block", "part", "layout", "data", "hash"),
    }


@pytest.mark.parametrize(("table", "column"), COLUMNS, ids=lambda item: item.name)
def test_every_column_has_a_rule_that_can_be_broken(table: Table, column: Column) -> None:
    assert column.implausible(object()), "a value of no type that SQLite has"
    assert (column.implausible(None) is None) is column.nullable


def test_a_catalogue_that_lacks_a_column_can_be_checked(path: Path) -> None:
    """As one of an older schema does; no check needs a column that came later."""
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("ALTER TABLE last DROP COLUMN family")
    with open_catalogue(path) as catalogue:
        assert [finding.code for finding in catalogue.findings()] == ["schema"]
        with pytest.raises(CatalogueDamaged, match="column"):
            catalogue.lasts()


def test_the_known_revisions_are_the_scripts() -> None:
    from alembic.config import Config
    from alembic.script import ScriptDirectory

    config = Config()
    config.set_main_option("script_location", str(migrations_folder()))
    scripts = ScriptDirectory.from_config(config).walk_revisions()
    assert tuple(reversed([script.revision for script in scripts])) == SIGNATURE.revisions


def test_the_marks_are_in_the_file(path: Path) -> None:
    header = path.read_bytes()[:100]
    assert header[68:72] == b"Foot"
    assert int.from_bytes(header[60:64], "big") == int(SIGNATURE.revisions[-1])
    assert header[18:20] == b"\x01\x01", "a rollback journal: a WAL file cannot be copied alone"


def test_the_settings_are_on(path: Path) -> None:
    with open_catalogue(path, write=True) as catalogue, catalogue.file.atomic() as connection:
        for pragma, value in (
            ("foreign_keys", 1),
            ("synchronous", 3),
            ("journal_mode", "delete"),
            ("busy_timeout", 30_000),
            ("trusted_schema", 0),
        ):
            assert connection.exec_driver_sql(f"PRAGMA {pragma}").scalar() == value
        # BEGIN IMMEDIATE: nobody else can begin to write meanwhile.
        other = connect(path, "rw", busy_timeout_s=0)
        with pytest.raises(sqlite3.OperationalError, match="locked"):
            other.execute("BEGIN IMMEDIATE")
        other.close()


def test_a_write_through_a_reader_is_impossible(path: Path) -> None:
    with (
        open_catalogue(path) as catalogue,
        pytest.raises(sqlite3.OperationalError, match="readonly"),
    ):
        catalogue.file.connection.execute("DELETE FROM notice")


def test_an_older_schema_is_upgraded_with_a_copy_beside(path: Path, tmp_path: Path) -> None:
    before = path.read_bytes()
    with open_catalogue(path) as catalogue:
        old = [str(record) for record in catalogue.lasts().records]
    newer = later_schema(tmp_path / "migrations")
    with (
        pytest.raises(CatalogueUnusable, match="upgrade-catalogue"),
        open_catalogue(path, schema=newer),
    ):
        pass
    assert path.read_bytes() == before
    with open_catalogue(path, write=True, schema=newer) as catalogue:
        assert catalogue.revisions == Revisions(HEAD, NEXT, str(copy_path(path, HEAD)))
        assert catalogue.summary().schema_revision == NEXT
        assert catalogue.findings() == [], "a column more leaves every hash as it was"
        assert [str(record) for record in catalogue.lasts().records] == old
        assert catalogue.summary().mesh_copies == 3, "foreign keys on would have deleted them"
    with open_catalogue(copy_path(path, HEAD)) as copy:
        assert [str(record) for record in copy.lasts().records] == old
        assert copy.findings() == []


@pytest.mark.parametrize(
    "fault",
    [
        "raise RuntimeError('half way')",
        "op.execute('DELETE FROM last WHERE id = 2')",  # leaves rows without their last
    ],
)
def test_an_upgrade_that_fails_leaves_the_old(path: Path, tmp_path: Path, fault: str) -> None:
    before = path.read_bytes()
    newer = later_schema(tmp_path / "migrations", fault)
    with (
        pytest.raises((RuntimeError, CatalogueDamaged)),
        open_catalogue(path, write=True, schema=newer),
    ):
        pass
    assert path.read_bytes() == before
    with open_catalogue(path) as catalogue:
        assert catalogue.findings() == []


@pytest.mark.parametrize("write", [False, True])
@pytest.mark.parametrize(
    "edit", ["PRAGMA user_version = 7", "UPDATE alembic_version SET version_num = '0007'"]
)
def test_a_newer_catalogue_is_refused_untouched(path: Path, write: bool, edit: str) -> None:
    other = sqlite3.connect(path)
    other.execute(edit)
    other.commit()
    other.close()
    before = path.read_bytes()
    with pytest.raises(NewerCatalogue) as caught, open_catalogue(path, write=write):
        pass
    assert "0007" in str(caught.value)
    assert SIGNATURE.revisions[-1] in str(caught.value)
    assert path.read_bytes() == before
    assert list(path.parent.iterdir()) == [path]


def test_a_revision_that_never_was_is_damage(path: Path) -> None:
    other = sqlite3.connect(path)
    other.execute("UPDATE alembic_version SET version_num = '0q01'")
    other.commit()
    other.close()
    with pytest.raises(CatalogueDamaged, match="0q01"), open_catalogue(path):
        pass


def test_a_catalogue_that_another_process_made_meanwhile_is_left_as_it_is(
    path: Path, tmp_path: Path
) -> None:
    """Also one of a later footfit, which only the opening after it refuses."""
    newer = later_schema(tmp_path / "migrations")
    with open_catalogue(path, write=True, schema=newer):
        pass
    before = path.read_bytes()
    connection = connect(path, "rwc")
    create(connection, Schema())
    connection.close()
    assert path.read_bytes() == before
