"""What is kept of a last beside its measures: its sections, its whole mesh, and how both return."""

from __future__ import annotations

import shutil
import sqlite3
from pathlib import Path

import numpy as np
import pytest

import footfit
from footfit.catalogue.rows.columns import SECTION
from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged
from footfit.geometry.fit.named_sections import NAMED_SECTIONS, named_sections, toes_outline_mm
from footfit.geometry.fit.stations import STATIONS
from footfit.geometry.measures import girths
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.tape import hull_girth
from footfit.meshes.copies.compact_copy import expanded_mesh
from footfit.meshes.write import encoded_mesh
from footfit.pipeline.library import upgrade as upgrading
from footfit.pipeline.library.upgrade import upgrade
from footfit.results import LastLabels, ShapeSections
from tests import records
from tools.lasts import LastSpec, last_mesh

SMALL = {"rings": 60, "segments": 48}
GIRTH_MM = 0.2  # of 120 points against the measure's own outline; measured: 0.10


@pytest.fixture(scope="module")
def shape() -> Shape:
    return Shape(*last_mesh(LastSpec(flare_deg=6.0, **SMALL)), "last")


def test_a_kept_section_has_the_girth_that_was_measured(shape: Shape) -> None:
    kept = named_sections(shape)
    assert set(kept) == {station.name for station in STATIONS}
    girth = girths.ball_girth(shape).value
    assert hull_girth(kept["ball"].points_mm) == pytest.approx(girth, abs=GIRTH_MM)


def test_a_kept_section_lies_on_the_surface(shape: Shape) -> None:
    for section in named_sections(shape).values():
        assert section.points_mm.shape == (NAMED_SECTIONS.points, 2)
        points = np.pad(section.points_mm, ((0, 0), (0, 1)))
        there = points @ section.plane[:3, :3].T + section.plane[:3, 3]
        near = np.linalg.norm(shape.vertices_mm[:, None] - there[None, ::10], axis=2).min(axis=0)
        assert near.max() < 5.0  # within the edges of the mesh, which are up to 9 mm long
        turn = section.plane[:3, :3]
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(turn) > 0.0


def test_the_outline_of_the_toes_closes_at_the_tip_and_turns_medial(shape: Shape) -> None:
    x, lateral, medial = toes_outline_mm(shape).T
    assert np.all(np.diff(x) > 0.0)
    width = medial - lateral
    assert width[0] > 80.0 > width[-1]
    assert np.all(np.diff(width[60:]) < 0.0)
    mirrored = Shape(shape.vertices_mm * [1.0, -1.0, 1.0], shape.faces[:, ::-1], "last")
    other = toes_outline_mm(mirrored)
    np.testing.assert_allclose(other[:, [1, 2]], -np.column_stack([medial, lateral]), atol=0.02)


def test_sections_come_back_as_they_were_stored(tmp_path: Path, shape: Shape) -> None:
    sections = ShapeSections(named_sections(shape), toes_outline_mm(shape))
    del sections.sections["instep"]
    with open_catalogue(tmp_path / "a.footfit", write=True) as catalogue:
        catalogue.add(records.last("with", 1), None, sections)
        catalogue.add(records.last("without", 2))
        assert catalogue.section_names() == ("with",)
        assert catalogue.sections("without") is None
        again = catalogue.sections("with")
        assert catalogue.findings() == []
    assert set(again.sections) == set(sections.sections)
    np.testing.assert_array_equal(again.toes_outline_mm, sections.toes_outline_mm)
    for name, section in sections.sections.items():
        np.testing.assert_array_equal(again.sections[name].plane, section.plane)
        np.testing.assert_array_equal(again.sections[name].points_mm, section.points_mm)


def test_damaged_sections_are_found_and_not_used(tmp_path: Path, shape: Shape) -> None:
    path = tmp_path / "a.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("derby", 1), None, ShapeSections(named_sections(shape), None))
    with sqlite3.connect(path) as connection:
        connection.execute(f"UPDATE {SECTION.name} SET ball_points_mm = heel_points_mm")
    connection.close()
    with open_catalogue(path) as catalogue:
        assert [(f.code, f.last) for f in catalogue.findings()] == [("section", "derby")]
        with pytest.raises(CatalogueDamaged, match="--replace"):
            catalogue.sections("derby")


def test_a_whole_mesh_is_kept_if_it_is_asked_for(tmp_path: Path) -> None:
    vertices, faces = last_mesh(LastSpec(flare_deg=6.0, rings=110, segments=60))
    mesh, catalogue = tmp_path / "derby.stl", tmp_path / "lasts.footfit"
    mesh.write_bytes(encoded_mesh(vertices, faces, "stl"))
    stored = footfit.open_catalogue(catalogue)
    with stored:
        assert stored.ingest(mesh)[0].status == "added"
        assert stored.mesh("derby").faces < len(faces)
        (unchanged,) = stored.ingest(mesh, keep_mesh="full")
        assert unchanged.status == "unchanged"
        assert [notice.code for notice in unchanged.warnings] == ["compact_copy"]
        assert stored.ingest(mesh, keep_mesh="full", replace=True)[0].status == "replaced"
        copy = stored.mesh("derby")
        assert stored.ingest(mesh, keep_mesh="full")[0].warnings == ()
        styled = LastLabels("", style="derby")
        assert stored.ingest(mesh, replace=True, labels=styled)[0].status == "replaced"
        assert stored.mesh("derby").faces == copy.faces  # it stays whole
        typed = stored.ingest(mesh, replace=True, keep_mesh="compact")
        assert typed[0].status == "replaced"
        assert stored.mesh("derby").faces < copy.faces  # that was typed
    assert copy.faces == len(faces)
    assert copy.error_mm < 0.01
    assert len(expanded_mesh(copy.data)[0]) == len(vertices)


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A catalogue of three lasts, of which the first two lack their sections."""
    folder = tmp_path_factory.mktemp("lasts")
    for number, flare_deg in enumerate((3.0, 6.0, 9.0)):
        mesh = encoded_mesh(*last_mesh(LastSpec(flare_deg=flare_deg, **SMALL)), "stl")
        (folder / f"last-{number}.stl").write_bytes(mesh)
    path = folder / "lasts.footfit"
    with footfit.open_catalogue(path) as catalogue:
        catalogue.ingest(folder)
    with sqlite3.connect(path) as connection:
        connection.execute("DELETE FROM section WHERE last_id < 3")
    connection.close()
    return path


@pytest.fixture
def older(measured: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(measured, tmp_path / "lasts.footfit"))


def test_an_upgrade_measures_what_is_missing_with_any_number_of_jobs(
    older: Path, tmp_path: Path
) -> None:
    twin = Path(shutil.copy(older, tmp_path / "twin.footfit"))
    outcome = upgrade(older, jobs=2)
    assert outcome.recomputed == ("last-0", "last-1")
    assert outcome.left == ()
    upgrade(twin)
    with open_catalogue(older) as catalogue, open_catalogue(twin) as other:
        assert catalogue.section_names() == ("last-0", "last-1", "last-2")
        assert catalogue.findings() == []
        for name in catalogue.names():
            assert str(catalogue.record(name)) == str(other.record(name))
            assert str(catalogue.sections(name)) == str(other.sections(name))
            stands = catalogue.record(name).standing_transform
            assert stands[2, 2] == pytest.approx(np.cos(np.arcsin(stands[2, 0])))
            assert catalogue.record(name).stance_by == "shape"
    assert upgrade(older).recomputed == ()


def test_an_upgrade_that_is_interrupted_goes_on(
    older: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    work = upgrading._measured_again

    def interrupted(mesh: upgrading.StoredMesh) -> upgrading.MeasuredAgain:
        if mesh.path == "last-1":
            raise KeyboardInterrupt
        return work(mesh)

    monkeypatch.setattr(upgrading, "_measured_again", interrupted)
    with pytest.raises(KeyboardInterrupt):
        upgrade(older)
    with open_catalogue(older) as catalogue:
        assert catalogue.section_names() == ("last-0", "last-2")
    monkeypatch.setattr(upgrading, "_measured_again", work)
    assert upgrade(older).recomputed == ("last-1",)


def test_an_upgrade_names_the_lasts_that_it_leaves(older: Path) -> None:
    with sqlite3.connect(older) as connection:
        connection.execute("DELETE FROM mesh_copy WHERE last_id = 1")
    connection.close()
    outcome = upgrade(older)
    assert (outcome.recomputed, outcome.left) == (("last-1",), ("last-0",))
    notice, blocks = outcome.warnings
    assert (notice.code, blocks.code) == ("not_upgraded", "blocks_renewed")
    assert "'last-0' was stored without its mesh" in notice.message
