"""``export-last``: formats, fewer faces, a folder, and the sections along the bottom."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import footfit as library
from footfit.meshes.copies.compact_copy import compact_copy, expanded_mesh, limited_copy
from footfit.meshes.copies.deviation import largest_deviation_mm
from footfit.meshes.read import file_mesh
from tests import shapes
from tests.conftest import Footfit

LAST = "derby-40"


@pytest.fixture
def export(footfit: Footfit, stocked, tmp_path):
    def run(name: str, *options: object):
        return footfit("export-last", LAST, "-o", tmp_path / name, *options, "--catalogue", stocked)

    return run


@pytest.mark.parametrize("kind", ["stl", "ply", "obj", "off", "3mf", "3dm"])
def test_every_kind_holds_the_same_last(export, stocked, tmp_path, kind):
    assert export(f"last.{kind}").code == 0
    file = file_mesh((tmp_path / f"last.{kind}").read_bytes())
    assert file.unit == ("mm" if kind in ("3mf", "3dm") else None)
    with library.open_catalogue(stocked) as catalogue:
        vertices, faces = expanded_mesh(catalogue.mesh(LAST).data)
    assert len(file.mesh.faces) == len(faces)
    # what float32 and nine digits keep of 270 mm
    assert np.abs(np.sort(file.mesh.vertices, axis=0) - np.sort(vertices, axis=0)).max() < 3e-5


def test_fewer_faces_and_their_deviation():
    vertices, faces = shapes.ellipsoid((125.0, 50.0, 35.0), subdivisions=5)
    copy = compact_copy(vertices, faces, len(faces))
    light = limited_copy(copy, 2_000)
    assert light.faces <= 2_000
    lighter = expanded_mesh(light.data)
    deviation_mm = largest_deviation_mm(vertices, faces, *lighter)
    assert 0.0 < deviation_mm <= light.error_mm
    assert light.error_mm < deviation_mm + 2.0 * copy.error_mm + 0.01
    assert limited_copy(copy, len(faces)) is copy


def test_the_deviation_is_said_and_nothing_is_cut_by_zero(export):
    outcome = export("few.stl", "--faces", "1000", "--json").document
    assert outcome["faces"] <= 1000
    assert 0.1 < outcome["error_mm"] < 1.0  # measured: 0.46 mm
    assert export("all.stl", "--faces", "0", "--json").document["faces"] > 5000
    assert export("none.stl", "--faces", "20").code == 2


def test_in_a_folder_the_labels_name_the_file(export, tmp_path):
    outcome = export("run/", "--json").document
    assert outcome["output"].endswith("run/derby_EU40_G_right_h25_ts14_mm.stl")
    assert [path.name for path in (tmp_path / "run").iterdir()] == [
        "derby_EU40_G_right_h25_ts14_mm.stl"
    ]
    assert export("run/").code == 2
    assert export("run/", "--force").code == 0


def table(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_sections_are_where_the_written_mesh_has_them(export, tmp_path):
    done = export("last.ply", "--sections", "9", "--json").document
    sections, outlines = tmp_path / "last_sections.csv", tmp_path / "last_outlines.csv"
    assert (done["sections"], done["outlines"]) == (str(sections), str(outlines))
    rows, points = table(sections), table(outlines)
    shares = [float(row["station"]) for row in rows]
    assert shares == sorted(shares)
    assert [row["place"] for row in rows if row["place"]] == [
        *("heel", "arch", "instep", "waist", "ball", "toes")
    ]
    mesh = library.to_trimesh(library.read(tmp_path / "last.ply"))
    for row in rows:
        own = [point for point in points if point["station"] == row["station"]]
        places = np.array([[float(point[f"{axis}_mm"]) for axis in "xyz"] for point in own])
        point = np.array([float(row[f"point_{axis}_mm"]) for axis in "xyz"])
        normal = np.array([float(row[f"normal_{axis}"]) for axis in "xyz"])
        assert np.abs((places - point) @ normal).max() < 0.002  # rounding to 0.001 mm
        cut = mesh.section(plane_origin=point, plane_normal=normal).vertices
        assert float(row["height_mm"]) == pytest.approx(np.ptp(cut[:, 2]), abs=1.0)
        if row["girth_mm"]:
            assert float(row["girth_mm"]) > 2.0 * float(row["width_mm"])
        else:
            assert "runs over the top" in row["reason"]


def test_sections_that_exist_are_kept_without_force(export, tmp_path):
    (tmp_path / "last_outlines.csv").write_text("mine")
    assert export("last.stl", "--sections", "3").code == 2
    assert not (tmp_path / "last.stl").exists()
