"""Upgrading: profiles of another definition are made anew from the catalogue's own meshes."""

from __future__ import annotations

import json
import shutil
import sqlite3
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from footfit.catalogue.file.dialect import driver_of
from footfit.catalogue.rows.array_blobs import definition_text
from footfit.catalogue.rows.columns import FLARE
from footfit.catalogue.rows.last_names import last_id
from footfit.catalogue.rows.writing import seal, update_row
from footfit.catalogue.store import open_catalogue
from footfit.errors import NoCatalogue
from footfit.geometry.flare.definition import FlareDefinition
from footfit.meshes.copies.compact_copy import compact_copy, expanded_mesh
from footfit.pipeline.library.measured_copy import measured_copy
from footfit.pipeline.library.upgrade import upgrade
from footfit.pipeline.scan.preparation import right_copy
from footfit.pipeline.shelf.candidates import choice
from footfit.results import SideName
from tests.conftest import SAMPLES, Footfit
from tests.distortions import axis_rotation, moved

CORNERED = ("instep_girth_least",)
"""Its section keeps corners, and which bends are corners depends on the noise: measured 0.049."""
LOOSE_PLACES = ("ball_length", "tread_from", "tread_to")
"""They move along the bottom by more than they are off it."""
ON_THE_GROUND = ("heel_height", "toe_spring_tip", "tread_from", "tread_to", "bottom_length")


def test_profiles_of_another_definition_are_recomputed_and_marked(catalogue: Path) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        record = opened.lasts().records[0]
        definition = replace(record.flare.definition, version="flare/0", band_height=0.2)
        older = replace(record.flare, definition=definition, angle_deg=99.0)
        opened.update_measured(replace(record, flare=older))
    assert [notice.code for notice in choice(catalogue, None, None).warnings] == ["outdated_last"]

    outcome = upgrade(catalogue)
    assert outcome.recomputed == (record.labels.name,)
    assert outcome.backup is None
    assert choice(catalogue, None, None).warnings == ()
    with open_catalogue(catalogue) as opened:
        again = opened.record(record.labels.name)
    assert again.upgraded_from == "flare/0"
    assert again.flare.definition == FlareDefinition()
    # measured 0.00105
    assert again.flare.angle_deg == pytest.approx(record.flare.angle_deg, abs=1.6e-3)
    assert upgrade(catalogue).recomputed == ()


def test_a_profile_with_other_stations_than_its_definition_is_found_and_made_anew(
    catalogue: Path,
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        record = opened.lasts().records[0]
        whole = record.flare
        fewer = replace(
            whole,
            stations=whole.stations[1:],
            heading_deg=whole.heading_deg[1:],
            centre_line=whole.centre_line[1:],
            curvature={k: None if v is None else v[1:] for k, v in whole.curvature.items()},
        )
        opened.update_measured(replace(record, flare=fewer))
        (finding,) = (entry for entry in opened.findings() if entry.code == "definition")
    assert "stations" in finding.message
    shelf = choice(catalogue, None, None)
    assert {notice.code for notice in shelf.warnings} == {"outdated_last"}
    assert not shelf.ranked.all()
    assert upgrade(catalogue).recomputed == (record.labels.name,)
    assert choice(catalogue, None, None).ranked.all()
    with open_catalogue(catalogue) as opened:
        assert opened.findings() == []


def test_a_catalogue_of_an_older_definition_is_made_anew(tmp_path: Path) -> None:
    """The stored profiles are of flare/2, and some have 60 stations."""
    old = Path(__file__).parent / "data" / "catalogue-0005.footfit"
    path = Path(shutil.copy(old, tmp_path / "old.footfit"))
    with open_catalogue(path) as opened:
        found = [finding for finding in opened.findings() if finding.code == "definition"]
        assert len(found) == len(opened.names())
    assert all("'flare/2'" in finding.message for finding in found)
    shelf = choice(path, None, None)
    assert {notice.code for notice in shelf.warnings} >= {"outdated_last"}
    assert not shelf.ranked.any()
    assert len(upgrade(path).recomputed) == len(found)
    assert choice(path, None, None).ranked.all()
    with open_catalogue(path) as opened:
        assert opened.findings() == []


@pytest.mark.parametrize("other", [{"band_height": None}, {"band_width": 0.3}])
def test_a_parameter_more_or_less_is_another_definition_whatever_its_version(
    catalogue: Path, other: dict[str, float | None]
) -> None:
    stored = {**json.loads(definition_text(FlareDefinition())), **other}
    text = json.dumps({name: value for name, value in stored.items() if value is not None})
    with open_catalogue(catalogue, write=True) as opened:
        record = opened.lasts().records[0]
        with opened.file.atomic() as connection:
            key = last_id(driver_of(connection), record.labels.name)
            update_row(connection, FLARE, key, {"definition": text, "angle_deg": 19.0})
            seal(connection, key)
        opened.renew_blocks()
    assert [notice.code for notice in choice(catalogue, None, None).warnings] == ["outdated_last"]
    with open_catalogue(catalogue) as opened:
        assert (
            opened.record(record.labels.name).flare.definition.version == FlareDefinition().version
        )
        assert [finding.code for finding in opened.findings()] == ["definition"]

    assert upgrade(catalogue).recomputed == (record.labels.name,)
    assert choice(catalogue, None, None).warnings == ()
    with open_catalogue(catalogue) as opened:
        assert opened.record(record.labels.name).flare.angle_deg != 19.0


def test_measures_of_older_definitions_are_taken_anew_and_the_profile_stays(
    catalogue: Path,
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        record, other = opened.lasts().records[:2]
        name = record.labels.name
        stale = [replace(record.measures[0], definition="length/1"), *record.measures[2:]]
        opened.update_measured(replace(record, measures=tuple(stale)))
    assert upgrade(catalogue).recomputed == (name,)
    with open_catalogue(catalogue) as opened:
        again, untouched = opened.record(name), opened.record(other.labels.name)
    assert untouched.measures == other.measures
    assert again.upgraded_from is None
    np.testing.assert_array_equal(again.flare.heading_deg, record.flare.heading_deg)
    for before, after in zip(record.measures, again.measures, strict=True):
        assert (after.name, after.definition) == (before.name, before.definition)
        assert before.measured.value is not None
        # of a mesh copy: measured 0.010, and 0.017 of what turns about the tread
        within = 0.034 if after.name in ON_THE_GROUND else 0.018
        if after.name in CORNERED:
            within = 0.09
        assert after.measured.value == pytest.approx(before.measured.value, abs=within), after.name
    assert upgrade(catalogue).recomputed == ()


def with_older_profiles(catalogue: Path, count: int) -> list[str]:
    """The first lasts of a catalogue get profiles of another definition; their names."""
    with open_catalogue(catalogue, write=True) as opened:
        older = opened.lasts().records[:count]
        for record in older:
            definition = replace(record.flare.definition, version="flare/0", band_height=0.2)
            flare = replace(record.flare, definition=definition)
            opened.update_measured(replace(record, flare=flare))
    return [record.labels.name for record in older]


def without_copy(catalogue: Path, name: str) -> None:
    with sqlite3.connect(catalogue) as connection:
        last = "(SELECT id FROM last WHERE name = ?)"
        connection.execute(f"DELETE FROM mesh_copy WHERE last_id = {last}", (name,))
    connection.close()


def test_a_match_counts_the_lasts_with_older_profiles_in_one_line(catalogue: Path) -> None:
    names = with_older_profiles(catalogue, 5)
    (notice,) = choice(catalogue, None, None).warnings
    assert notice.message == (
        f"5 lasts were left out ({', '.join(names[:3])} and 2 more): their profiles are older;"
        " type: footfit upgrade-catalogue"
    )


def test_a_last_without_its_mesh_gets_an_advice_that_helps(
    catalogue: Path, footfit: Footfit
) -> None:
    """An upgrade cannot measure it again, so neither a match nor a check proposes one."""
    first, second = with_older_profiles(catalogue, 2)
    without_copy(catalogue, first)
    messages = [notice.message for notice in choice(catalogue, None, None).warnings]
    assert messages == [
        f"{second} was left out: its profile is older; type: footfit upgrade-catalogue",
        f"{first} was left out: its profile is older, and it was stored without its mesh: ingest"
        " its file again with --replace",
    ]
    run = footfit("upgrade-catalogue", "--catalogue", catalogue, "--json")
    assert (run.code, run.document["left"]) == (0, [first])
    run = footfit("check-catalogue", "--catalogue", catalogue, "--json")
    assert run.code == 7
    (finding,) = run.document["findings"]
    assert (finding["code"], finding["last"]) == ("definition", first)
    assert finding["message"].endswith("it has no mesh copy: ingest its file again with --replace")


def test_older_measures_without_a_mesh_get_an_advice_that_helps(catalogue: Path) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        for record in opened.lasts().records[:2]:
            stale = (replace(record.measures[0], definition="length/1"), *record.measures[1:])
            opened.update_measured(replace(record, measures=stale))
        first, second = (record.labels.name for record in opened.lasts().records[:2])
    without_copy(catalogue, first)
    notices = choice(catalogue, None, None).warnings
    assert [notice.code for notice in notices] == ["other_measures"] * 2
    assert notices[0].message.startswith(second)
    assert notices[0].message.endswith("type: footfit upgrade-catalogue")
    assert notices[1].message.startswith(first)
    assert notices[1].message.endswith("ingest its file again with --replace")


def test_a_catalogue_of_older_measures_fits_no_foot_and_says_why(
    catalogue: Path, footfit: Footfit
) -> None:
    with open_catalogue(catalogue, write=True) as opened:
        for record in opened.lasts().records:
            older = [replace(row, definition=f"{row.name}/0") for row in record.measures]
            opened.update_measured(replace(record, measures=tuple(older)))
    foot = SAMPLES / "feet" / "mh008_R.stl"
    run = footfit("match", foot, "--catalogue", catalogue, "--json")
    assert run.code == 0
    assert list(run.document["rejected"]["by_reason"]) == ["length_unknown"]
    codes = {notice["code"] for notice in run.document["warnings"]}
    assert {"other_measures", "nothing_fits"} <= codes


def test_an_upgrade_counts_the_lasts_as_it_stores_them(catalogue: Path) -> None:
    with_older_profiles(catalogue, 3)
    counts: list[tuple[int, int]] = []
    upgrade(catalogue, count=lambda *done: counts.append(done))
    assert counts == [(0, 3), (1, 3), (2, 3), (3, 3)]


def test_an_upgrade_makes_no_catalogue(tmp_path: Path) -> None:
    with pytest.raises(NoCatalogue):
        upgrade(tmp_path / "none.footfit")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("roll_deg", "side"), [(1.0, "right"), (-1.5, "right"), (2.0, "left"), (-1.0, "left")]
)
def test_a_last_that_was_left_rolled_is_measured_level(
    catalogue: Path, roll_deg: float, side: SideName
) -> None:
    """Older versions did not level a last across its tread: a degree is .5 mm of heel."""
    with open_catalogue(catalogue) as opened:
        record = opened.lasts().records[0]
        copy = opened.mesh_copy(record.labels.name)
    points, faces = right_copy(*right_copy(*expanded_mesh(copy.data), record.side.side), side)
    record = replace(record, side=replace(record.side, side=side))
    rolled = moved(points, axis_rotation("x", roll_deg))
    rolled = rolled - [0.0, 0.0, rolled[:, 2].min()]
    level, again = (
        measured_copy(record, compact_copy(mesh, faces, len(faces))) for mesh in (points, rolled)
    )
    for row, other in zip(level.measures, again.measures, strict=True):
        most_mm = 0.5 if row.name in LOOSE_PLACES else 0.1  # measured: 0.05
        assert other.measured.value == pytest.approx(row.measured.value, abs=most_mm), row.name
    assert level.standing_transform is not None
    assert again.standing_transform is not None
    stands = moved(points, level.standing_transform)
    assert np.abs(moved(rolled, again.standing_transform) - stands)[:, 2].max() < 0.15
