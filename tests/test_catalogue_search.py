"""What matching reads: the lasts that pass, no mesh, no SQLAlchemy."""

from __future__ import annotations

import json
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from footfit.catalogue.rows.array_blobs import definition_of, definition_text
from footfit.catalogue.rows.search import rejection
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.geometry.flare.definition import FlareDefinition
from tests import records

LASTS = 12


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A catalogue whose lasts are added in no order of names."""
    place = tmp_path_factory.mktemp("search") / "lasts.footfit"
    with open_catalogue(place, write=True) as catalogue:
        for seed in (7, 2, 11, 0, 5, 9, 1, 3, 10, 4, 8, 6):
            catalogue.add(records.last(f"last-{seed:02d}", seed), records.mesh_copy(seed))
    return place


@pytest.fixture
def catalogue(path: Path) -> Iterator[Catalogue]:
    """It, open for reading."""
    with open_catalogue(path) as opened:
        yield opened


def test_all_lasts_come_by_name_as_records_do(catalogue: Catalogue) -> None:
    rows = catalogue.lasts()
    names = [record.labels.name for record in rows.records]
    assert names == [f"last-{seed:02d}" for seed in range(LASTS)] == list(catalogue.names())
    assert records.plain(rows.records) == records.plain([catalogue.record(name) for name in names])
    assert (rows.rejected, rows.damaged, rows.outdated) == ((), (), ())


def test_filters_keep_what_they_say_and_count_the_rest(catalogue: Catalogue) -> None:
    lasts = catalogue.lasts().records
    rows = catalogue.lasts(style="Oxford", size_system="EU")
    kept = [
        record.labels.name
        for record in lasts
        if record.labels.style == "oxford" and record.labels.size_system == "eu"
    ]
    assert [record.labels.name for record in rows.records] == kept
    assert kept
    assert sum(count for _, count in rows.rejected) == LASTS - len(kept)
    assert dict(rows.rejected)["style"] == sum(r.labels.style != "oxford" for r in lasts)


@pytest.mark.parametrize(
    ("filters", "reason"),
    [
        ({}, None),
        ({"style": "DERBY"}, None),
        ({"style": "boot"}, "style"),
        ({"size_system": "eu"}, "size_system"),
        ({"style": "boot", "size_system": "eu"}, "style"),
    ],
)
def test_a_label_is_compared_without_its_case_and_a_missing_one_does_not_pass(
    filters: dict[str, str], reason: str | None
) -> None:
    assert (
        rejection(asdict(records.last(style="Derby", size_system=None).labels), filters) == reason
    )


def test_ranking_reads_no_mesh(path: Path, tmp_path: Path) -> None:
    copy = tmp_path / "meshless"
    copy.write_bytes(path.read_bytes())
    with sqlite3.connect(copy) as connection:
        connection.execute("DROP TABLE mesh_copy")
    connection.close()
    with open_catalogue(path) as whole, open_catalogue(copy) as meshless:
        assert records.plain(meshless.lasts()) == records.plain(whole.lasts())


def test_a_profile_of_another_definition_is_set_apart(path: Path, tmp_path: Path) -> None:
    copy = tmp_path / "older"
    copy.write_bytes(path.read_bytes())
    flare = records.profile(3)
    older = replace(flare, definition=replace(flare.definition, version="flare/0"))
    with open_catalogue(copy, write=True) as catalogue:
        catalogue.update_measured(replace(catalogue.record("last-03"), flare=older))
        rows = catalogue.lasts()
        assert rows.outdated == ("last-03",)
        assert len(rows.records) == LASTS
        assert catalogue.record("last-03").flare.definition.version == "flare/0"
        assert dict(catalogue.summary().definitions)["flare/0"] == 1


def test_a_definition_comes_back_equal_from_its_text() -> None:
    """Equal with its types: a tuple that comes back as a list would make every last outdated."""
    definition = FlareDefinition()
    assert definition_of(definition_text(definition)) == definition
    hash(definition_of(definition_text(definition)))


def test_a_parameter_that_a_stored_definition_lacks_is_not_filled_in() -> None:
    stored = json.loads(definition_text(FlareDefinition()))
    del stored["band_height"], stored["seat"]
    found = definition_of(json.dumps(stored))
    assert found != FlareDefinition()
    assert np.isnan([found.band_height, *found.seat]).all()
    assert replace(found, band_height=0.1, seat=FlareDefinition().seat) == FlareDefinition()


def test_reading_opens_neither_sqlalchemy_nor_alembic_nor_a_mesh_library(path: Path) -> None:
    code = (
        "import sys; from footfit.catalogue.store import open_catalogue\n"
        "with open_catalogue(sys.argv[1]) as catalogue: rows = catalogue.lasts()\n"
        "heavy = {'sqlalchemy', 'alembic', 'trimesh', 'scipy'} & set(sys.modules)\n"
        "print(len(rows.records), sorted(heavy))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(path)],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(__file__).resolve().parents[1],
    )
    assert done.stdout.strip() == f"{LASTS} []"
