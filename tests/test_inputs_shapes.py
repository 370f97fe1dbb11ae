"""What is no foot ends in exit 5 with its reason, from the command line, whatever its unit."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from footfit.meshes.write import encoded_mesh
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.reading import aligned_source
from tests import distortions, shapes
from tests.conftest import SAMPLES, Footfit


def canonical(path: Path):
    scan = aligned_source(Source(str(path)), ReadingOptions())
    return scan.vertices_mm, scan.faces


@pytest.fixture(scope="module")
def bodies():
    return {
        "foot": canonical(sorted((SAMPLES / "feet").iterdir())[0]),
        "last": canonical(sorted((SAMPLES / "lasts").iterdir())[0]),
    }


def half(mesh, share: float, sign: float):
    vertices, faces = mesh
    at = np.array([share * vertices[:, 0].max(), 0.0, 0.0])
    return distortions.plane_cut(vertices, faces, at, np.array([sign, 0.0, 0.0]))


def slab(mesh):
    """The lowest 12 mm, closed above: a sole, or an insole."""
    vertices, faces = mesh
    flat = vertices.copy()
    flat[:, 2] = np.minimum(flat[:, 2], 12.0)
    return flat, faces


def sheet(mesh):
    """All that faces down, open above: what a scanner under a glass plate sees."""
    vertices, faces = mesh
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return vertices, faces[(normals[:, 2] < 0.0) & (corners[:, :, 2].min(axis=1) < 25.0)]


def box(*sides: float):
    vertices, faces = shapes.cube(1.0, 8)
    return vertices * sides, faces


def bubbles(count: int):
    vertices, faces = shapes.sphere(2.0, 1)
    middles = np.random.default_rng(1).uniform([-130, -45, -30], [130, 45, 30], (count, 3))
    several = np.arange(count)[:, None, None] * len(vertices) + faces
    return (middles[:, None] + vertices).reshape(-1, 3), several.reshape(-1, 3)


ALONE = {
    "cube": lambda: shapes.cube(250.0, 8),
    "small-cube": shapes.cube,
    "sphere": lambda: shapes.sphere(125.0),
    "ellipsoid": lambda: shapes.ellipsoid((125.0, 50.0, 35.0)),
    "sheet": shapes.flat_sheet,
    "shin": shapes.shin,
    "hand": shapes.hand,
    "cylinder": shapes.cylinder,
    "torus": shapes.torus,
    "box": lambda: box(260.0, 95.0, 60.0),
    "slab": lambda: box(260.0, 95.0, 12.0),
    "balls": lambda: bubbles(40),
}


def refusal(footfit: Footfit, tmp_path: Path, mesh, *more: str):
    pose = distortions.random_pose(np.random.default_rng(3))
    path = tmp_path / "shape.stl"
    path.write_bytes(encoded_mesh(distortions.moved(mesh[0], pose), mesh[1], "stl"))
    run = footfit("align", path, "--json", *more)
    assert run.code == 5, run.out
    assert run.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == [path]
    return json.loads(run.last_error)["code"]


@pytest.mark.parametrize("name", ALONE)
def test_a_shape_that_is_no_foot_is_refused(footfit, tmp_path, name):
    assert refusal(footfit, tmp_path, ALONE[name]()) in ("not_a_foot", "half_scan")


@pytest.mark.parametrize("body", ["foot", "last"])
@pytest.mark.parametrize(("share", "sign"), [(0.5, 1.0), (0.5, -1.0), (0.65, 1.0), (0.35, -1.0)])
@pytest.mark.parametrize("units", ["auto", "mm"])
def test_half_a_foot_is_refused(footfit, tmp_path, bodies, body, share, sign, units):
    code = refusal(footfit, tmp_path, half(bodies[body], share, sign), "--units", units)
    assert code in ("not_a_foot", "half_scan")


@pytest.mark.parametrize("body", ["foot", "last"])
def test_a_sole_is_refused(footfit, tmp_path, bodies, body):
    assert refusal(footfit, tmp_path, slab(bodies[body])) in ("not_a_foot", "half_scan")


@pytest.mark.parametrize("body", ["foot", "last"])
def test_two_in_one_file_are_said_to_be_two(footfit, tmp_path, bodies, body):
    vertices, faces = bodies[body]
    mirrored = distortions.mirrored(vertices, faces)
    beside = (mirrored[0] + [0.0, 140.0, 0.0], mirrored[1])
    pair = distortions.joined((vertices, faces), beside)
    assert refusal(footfit, tmp_path, pair) == "several_feet"


@pytest.mark.parametrize("body", ["foot", "last"])
def test_a_plantar_sheet_is_refused(footfit, tmp_path, bodies, body):
    assert refusal(footfit, tmp_path, sheet(bodies[body])) in ("half_scan", "not_a_foot")


def test_a_scanned_plantar_sheet_is_refused(footfit, scans):
    run = footfit("align", scans / "insoleTilter_scan.stl", "--json")
    assert run.code == 5
    assert json.loads(run.last_error)["code"] in ("half_scan", "not_a_foot")


def test_a_childs_foot_has_a_unit_and_a_smaller_one_is_asked_for_it(footfit, tmp_path, bodies):
    """The shape passes; only then is the unit the question."""
    vertices, faces = bodies["foot"]
    child = tmp_path / "child.stl"
    child.write_bytes(encoded_mesh(vertices * 0.5, faces, "stl"))
    run = footfit("align", child, "--json")
    assert run.code == 0
    assert json.loads(run.out)["mesh"]["units"] == "mm"
    child.write_bytes(encoded_mesh(vertices * 0.3, faces, "stl"))
    run = footfit("align", child, "--json")
    assert (run.code, json.loads(run.last_error)["code"]) == (3, "unknown_units")


def test_thousands_of_pieces_and_lone_triangles_end_in_a_word(footfit, tmp_path):
    rng = np.random.default_rng(2)
    corners = rng.uniform(-130, 130, (3000, 1, 3)) + rng.normal(size=(3000, 3, 3))
    soup = corners.reshape(-1, 3), np.arange(9000).reshape(-1, 3)
    few = corners[:30].reshape(-1, 3), np.arange(90).reshape(-1, 3)
    for name, mesh, code in (("soup", soup, 3), ("bubbles", bubbles(3000), 3), ("few", few, 5)):
        path = tmp_path / f"{name}.stl"
        path.write_bytes(encoded_mesh(*mesh, "stl"))
        run = footfit("align", path, "--units", "mm")
        assert run.code == code, name
        assert run.err.count("\n") == 1


def test_a_foot_with_fins_and_doubled_faces_is_read_and_they_are_said(footfit, tmp_path, bodies):
    vertices, faces = bodies["foot"]
    fin = np.column_stack([faces[:5, :2], np.full(5, len(vertices))])  # a third face on an edge
    points = np.vstack([vertices, vertices[faces[0]].mean(axis=0) * 1.02])
    path = tmp_path / "fins.stl"
    path.write_bytes(encoded_mesh(points, np.vstack([faces, faces[:50], fin]), "stl"))
    document = footfit("align", path, "--json").document
    codes = {warning["code"] for warning in document["warnings"]}
    assert {"duplicates_removed", "non_manifold"} <= codes
