"""Polygons of OBJ, PLY and OFF become triangles as their outline runs."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import footfit
from footfit.errors import DamagedMesh
from footfit.geometry.mesh.surface import area_vectors
from footfit.meshes.formats.polygons import polygon_triangles
from footfit.meshes.known_formats import raw_mesh
from footfit.meshes.read_limits import LIMITS
from tests.strategies import rotations, seeds

CASES = Path(__file__).parents[2] / "shared" / "cases"


def triangles_of(points, start=0):
    """A polygon's triangles, each from its lowest corner on, with the corner ``start`` first."""
    order = np.roll(np.arange(len(points)), -start)
    triangles, notices = polygon_triangles(
        np.asarray(points, dtype=float), order, np.array([len(points)]), LIMITS
    )
    return {tuple(np.roll(row, -int(row.argmin())).tolist()) for row in triangles}, notices


def assert_covered_once(points, share=1.0 + 1e-9):
    """The triangles have the outline's area, at most ``share`` more, whichever corner is first."""
    triangles, notices = triangles_of(points)
    assert notices == ()
    assert len(triangles) == len(points) - 2
    vectors = area_vectors(np.asarray(points, dtype=float), np.array(sorted(triangles)))
    whole = np.linalg.norm(vectors.sum(axis=0))
    assert np.linalg.norm(vectors, axis=1).sum() <= whole * share
    assert all(triangles_of(points, start)[0] == triangles for start in range(len(points)))


def flat(*places):
    return [(x, y, 0.0) for x, y in places]


OUTLINES = {
    "arrowhead": flat((0, 0), (4, 0), (0, 4), (1, 1)),
    "U": flat((0, 0), (5, 0), (5, 5), (4, 5), (4, 1), (2, 1), (1, 1), (1, 5), (0, 5)),
    "comb": flat((0, 0), (9, 0), (8, 6), (7, 1), (6, 6), (5, 1), (4, 6), (3, 1), (2, 6), (1, 1)),
    "corners on a line": flat((0, 0), (1, 0), (2, 0), (2, 2), (1, 2), (0, 2), (0, 1)),
    "a corner twice": flat((0, 0), (1, 0), (1, 0), (1, 1), (0.3, 0.3), (0, 1)),
    "out and back": flat((0, 0), (2, 0), (3, 0), (2, 0), (2, 2), (0, 2)),
    "round a hole": flat(
        (0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)
    ),
}


@pytest.mark.parametrize("name", OUTLINES)
def test_a_concave_outline_is_covered_once_whichever_corner_is_first(name):
    assert_covered_once(OUTLINES[name])


@given(seeds, st.integers(4, 40), rotations())
@settings(max_examples=40, deadline=None)
def test_a_bent_star_is_covered_once_in_any_pose(seed, corners, rotation):
    rng = np.random.default_rng(seed)
    angle = (np.arange(corners) + rng.uniform(0.0, 0.8, corners)) * 2 * np.pi / corners
    reach = rng.uniform(0.5, 2.0, corners)
    bend = 0.03 * np.cos(2 * angle)  # so bent the area grows by up to 4 %
    points = np.column_stack([reach * np.cos(angle), reach * np.sin(angle), bend])
    assert_covered_once(points @ rotation.T, share=1.05)


def test_the_two_halves_of_a_bent_quadrangle_meet_in_its_shorter_diagonal():
    bent = [(0, 0, 0), (3, 0, 0.2), (3, 1, 0), (0, 2, 0.2)]
    assert triangles_of(bent)[0] == {(0, 1, 2), (0, 2, 3)}
    assert triangles_of(bent, 1)[0] == {(0, 1, 2), (0, 2, 3)}


PLATE = [(-9, -9, 0), (9, -9, 0), (9, 9, 0)]  # the mesh around a polygon
CROSSED = {
    "bow tie": flat((0, 0), (1, 1), (1, 0), (0, 1)),
    "star of five": [(np.cos(k * 0.8 * np.pi), np.sin(k * 0.8 * np.pi), 0.0) for k in range(5)],
    "eight": flat((0, 0), (2, 2), (2, 0), (1, 0), (0, 2)),
}


@pytest.mark.parametrize("name", CROSSED)
def test_an_outline_that_crosses_itself_is_refused_if_it_is_large(name):
    with pytest.raises(DamagedMesh, match="crosses itself: export the mesh as triangles"):
        triangles_of(CROSSED[name])
    small = 0.1 * np.array(CROSSED[name])
    points = np.concatenate([small, PLATE])
    sizes = np.array([len(small), 3])
    triangles, notices = polygon_triangles(points, np.arange(len(points)), sizes, LIMITS)
    assert len(triangles) == len(small) - 1
    assert [notice.code for notice in notices] == ["polygons_crossed"]


@pytest.mark.parametrize("count", [4, 5, 9])
def test_a_polygon_without_an_area_is_no_fault(count):
    line = [(float(k), 0.0, 0.0) for k in range(count)]
    assert len(triangles_of(line)[0]) == count - 2


def obj(points, start):
    order = np.roll(np.arange(len(points)), -start) + 1
    lines = [f"v {x} {y} {z}" for x, y, z in points]
    return "\n".join([*lines, "f " + " ".join(map(str, order)), ""]).encode()


def off(points, start):
    order = np.roll(np.arange(len(points)), -start)
    lines = ["OFF", f"{len(points)} 1 0", *(f"{x} {y} {z}" for x, y, z in points)]
    return "\n".join([*lines, f"{len(order)} " + " ".join(map(str, order)), ""]).encode()


def ply(points, start):
    order = np.roll(np.arange(len(points)), -start)
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\n"
        "property double y\nproperty double z\nelement face 1\n"
        "property list ushort int vertex_indices\nend_header\n"
    )
    row = struct.pack(f"<H{len(order)}i", len(order), *order)
    return header.encode() + np.asarray(points, dtype="<f8").tobytes() + row


@pytest.mark.parametrize("written", [obj, off, ply])
@pytest.mark.parametrize("start", [0, 3, 7])
def test_every_format_with_polygons_cuts_them_alike(written, start):
    mesh = raw_mesh(written(OUTLINES["U"], start), None, None, LIMITS)[1]
    upward = area_vectors(mesh.vertices, mesh.faces)[:, 2]
    assert upward.sum() == pytest.approx(13.0)
    assert (upward >= 0.0).all()


def test_triangles_and_polygons_stay_in_their_order():
    points = np.array(flat((0, 0), (2, 0), (2, 2), (0, 2), (5, 5), (6, 5), (6, 6)))
    corners, counts = np.array([4, 5, 6, 0, 1, 2, 3, 4, 6, 5]), np.array([3, 4, 2, 1])
    triangles, _ = polygon_triangles(points, corners, counts, LIMITS)
    assert triangles.tolist() == [[4, 5, 6], [0, 1, 2], [0, 2, 3]]


@pytest.mark.skipif(not CASES.exists(), reason="the cases beside the project are not here")
@pytest.mark.parametrize("name", ["foot_ngon0.obj", "foot_ngon0_triangulated.stl"])
def test_a_foot_with_one_polygon_for_its_sole_measures_as_it_is(name):
    values = {row.name: row.measured.value for row in footfit.measure(CASES / name).measures}
    assert values["instep_girth"] == pytest.approx(218.8, abs=0.1)
    assert values["waist_girth"] == pytest.approx(217.9, abs=0.1)
    assert values["arch_height"] == pytest.approx(1.3, abs=0.1)


# ---------------------------------------------------------------- numbers with a decimal comma

TRIANGLE = "v 0,5 0 0\nv 1e1 0,0 0\nv 0 -,25e1 0\nf 1 2 3\n"
COMMAS = {
    "obj": TRIANGLE,
    "off": "OFF\n3 1 0\n0 0 0\n1,5 0 0\n0 1,5 0\n3 0 1 2\n",
    "ply": "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0,1 0,2 0,3\n",
    "stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1,5 0 0\n"
    "vertex 0 1,5 0\nendloop\nendfacet\nendsolid a\n",
}


@pytest.mark.parametrize("name", COMMAS)
def test_a_decimal_comma_is_named_with_what_to_do(name):
    with pytest.raises(DamagedMesh, match=r"decimal comma, such as [01],\d: .* decimal point"):
        raw_mesh(COMMAS[name].encode(), None, None, LIMITS)


@pytest.mark.parametrize("number", ["1.0,2.0", "1,2,3", "1,", "nought", "1,234.5"])
def test_another_wrong_word_is_no_decimal_comma(number):
    with pytest.raises(DamagedMesh, match="a word where a number belongs"):
        raw_mesh(
            TRIANGLE.replace("0,5", number).replace(",0", "").replace(",25", "").encode(),
            None,
            None,
            LIMITS,
        )


@pytest.mark.skipif(not CASES.exists(), reason="the cases beside the project are not here")
def test_the_german_exporters_file_is_said_to_have_decimal_commas():
    with pytest.raises(DamagedMesh, match="decimal comma"):
        footfit.read(CASES / "decimal_comma.obj")
