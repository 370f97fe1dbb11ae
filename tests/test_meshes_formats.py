"""Each format's reader against trimesh, against planted values and against the writers."""

from __future__ import annotations

import io
import struct
import zipfile
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import BadOption, DamagedMesh, EmptyMesh, TooLarge
from footfit.geometry.mesh.surface import area_vectors
from footfit.meshes.formats import stl
from footfit.meshes.formats.foreign import is_text, known_foreign, likeness
from footfit.meshes.formats.ply import read_ply
from footfit.meshes.formats.raw import RawMesh, checked_mesh
from footfit.meshes.formats.threemf import CORE, is_3mf
from footfit.meshes.formats.tokens import floats, text_lines
from footfit.meshes.known_formats import EXTENSIONS, FORMATS, raw_mesh
from footfit.meshes.read_limits import LIMITS
from footfit.meshes.write import COLOUR, WRITERS, encoded_mesh
from tests import corpus, rhino_models, shapes
from tests.distortions import shuffled
from tests.solids import surface_area


def read(data: bytes):
    return raw_mesh(data, None, None, LIMITS)[1]


def trimesh_of(data: bytes, extension: str):
    return trimesh.load(io.BytesIO(data), file_type=extension, process=False, force="mesh")


MESHES = {
    "ellipsoid": (corpus.VERTICES, corpus.FACES),
    "torus": shapes.torus(around=24, across=12),
    "sheet": shapes.flat_sheet(cells=6),
    "tetrahedron": shapes.tetrahedron(),
}
TOLERANCE = {  # of the largest coordinate
    "stl": 3e-7,
    "ply": 0.0,
    "obj": 5e-9,
    "off": 5e-9,
    "3mf": 5e-9,
    "3dm": 0.0,
}


def peer_triangles(data: bytes, extension: str):
    """The corners (m, 3, 3) as other code reads them: trimesh, an XML parser, rhino3dm."""
    if extension == "3mf":
        with zipfile.ZipFile(io.BytesIO(data)) as zipped:
            root = ElementTree.fromstring(zipped.read("3D/3dmodel.model"))
        assert root.get("unit") == "millimeter"
        rows = {
            name: [[float(row.get(key)) for key in keys] for row in root.iter(f"{{{CORE}}}{name}")]
            for name, keys in (("vertex", "xyz"), ("triangle", ("v1", "v2", "v3")))
        }
        return np.array(rows["vertex"])[np.array(rows["triangle"], dtype=int)]
    if extension == "3dm":
        return rhino_models.triangles_of(data)
    return np.asarray(trimesh_of(data, extension).triangles)


@pytest.mark.parametrize("extension", WRITERS)
@pytest.mark.parametrize("name", MESHES)
def test_what_is_written_is_read_by_us_and_by_a_peer(name, extension):
    vertices, faces = MESHES[name]
    data = encoded_mesh(vertices, faces, extension)
    ours, theirs = read(data), peer_triangles(data, extension)
    bound = TOLERANCE[extension] * np.abs(vertices).max()
    assert np.abs(ours.vertices[ours.faces] - vertices[faces]).max() <= bound
    assert np.abs(theirs - vertices[faces]).max() <= bound + 1e-9
    if extension != "stl":
        assert np.array_equal(ours.faces, faces)


@pytest.mark.parametrize("extension", ["stl", "ply", "obj", "off"])
def test_what_trimesh_writes_is_read(extension):
    vertices, faces = MESHES["ellipsoid"]
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    data = mesh.export(file_type=extension)
    ours = read(data if isinstance(data, bytes) else data.encode())
    assert np.allclose(ours.vertices[ours.faces], vertices[faces], atol=7e-7)  # measured 4.6e-07


@pytest.mark.parametrize("kind", ["stl_ascii", "ply"])
def test_trimeshs_text_formats_are_read(kind):
    vertices, faces = MESHES["ellipsoid"]
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    options = {"encoding": "ascii"} if kind == "ply" else {}
    data = mesh.export(file_type=kind, **options)
    ours = read(data if isinstance(data, bytes) else data.encode())
    assert np.allclose(ours.vertices[ours.faces], vertices[faces], atol=7e-7)  # measured 4.6e-07


@pytest.mark.parametrize("piece_bytes", [1, 97, 5_000])
def test_an_ascii_stl_read_in_pieces_is_the_same(monkeypatch, piece_bytes):
    data = corpus.ascii_stl()
    whole = read(data).vertices
    monkeypatch.setattr(stl, "_CHUNK_BYTES", piece_bytes)
    assert np.array_equal(read(data).vertices, whole)
    assert np.array_equal(read(data.upper().replace(b"NAN", b"0")).vertices, whole)


@pytest.mark.parametrize(
    ("word", "instead"),
    [
        (b"facet", b"facets"),
        (b"normal", b"normals"),
        (b"outer", b"oute"),
        (b"loop", b"loap"),
        (b"vertex", b"vertez"),
        (b"vertex", b"vertex8"),
        (b"vertex", b"12345678"),
        (b"endloop", b"endloops"),
        (b"endfacet", b"endface"),
    ],
)
def test_an_ascii_stl_with_one_wrong_word_is_damaged(word, instead):
    before, last, after = corpus.ascii_stl().rpartition(b"facet normal")
    damaged = before + (last + after).replace(word, instead, 1)
    with pytest.raises(DamagedMesh):
        read(damaged)


def test_the_facets_of_an_ascii_stl_are_counted_before_the_work():
    facet = b"facet normal 0 0 0 outer loop" + 3 * b" vertex 0 0 0" + b" endloop endfacet "
    data = b"solid\n" + 40 * facet + b"endsolid\n"
    with pytest.raises(TooLarge, match="40 faces"):
        stl.read_ascii_stl(data, replace(LIMITS, faces=39))
    assert len(facet) == stl._LEAST_FACET_BYTES


@given(
    digits=st.lists(
        st.floats(-1e6, 1e6, allow_nan=False).map(lambda x: x + 0.0), min_size=9, max_size=9
    )
)
@settings(max_examples=60, deadline=None)
def test_ply_gives_back_every_bit_and_the_text_formats_nine_digits(digits):
    vertices, faces = np.array(digits).reshape(3, 3), np.array([[0, 1, 2]])
    assert np.array_equal(read(encoded_mesh(vertices, faces, "ply")).vertices, vertices)
    for extension in ("obj", "off"):
        found = read(encoded_mesh(vertices, faces, extension)).vertices
        assert np.allclose(found, vertices, rtol=1e-8, atol=0.0)
    assert np.array_equal(read(corpus.ascii_stl(vertices, faces)).vertices, vertices)


def test_the_same_mesh_gives_the_same_bytes():
    vertices, faces = MESHES["torus"]
    for extension in set(WRITERS) - {"3dm"}:  # its ids and its date are new in each file
        again = encoded_mesh(vertices.copy(), faces.copy(), extension)
        assert encoded_mesh(vertices, faces, extension) == again


def test_values_of_vertices_stand_in_a_ply():
    vertices, faces = MESHES["tetrahedron"]
    curvature, colour = np.arange(4.0) / 8.0, np.arange(12, dtype=np.uint8).reshape(4, 3)
    data = encoded_mesh(vertices, faces, "ply", {"k1": curvature, COLOUR: colour})
    read_back = trimesh_of(data, "ply")
    raw = read_back.metadata["_ply_raw"]["vertex"]["data"]
    assert np.array_equal(np.asarray(raw["k1"]).ravel(), curvature)
    assert np.array_equal(read_back.visual.vertex_colors[:, :3], colour)
    assert np.array_equal(read(data).vertices, vertices)


def test_what_cannot_be_written_is_said():
    with pytest.raises(BadOption, match="stl, ply, obj, off"):
        encoded_mesh(*MESHES["tetrahedron"], "step")
    with pytest.raises(BadOption, match=r"use \.ply"):
        encoded_mesh(*MESHES["tetrahedron"], "stl", {"k1": np.zeros(4)})


# ---------------------------------------------------------------- polygons, indices, layouts

SQUARE = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 3, 0]])


@pytest.mark.parametrize(
    "face",
    ["f 1 2 3 5 4", "f 1/9 2/9 3/9 5/9 4/9", "f 1//7 2//7 3//7 5//7 4//7", "f -5 -4 -3 -1 -2"],
)
def test_a_polygon_of_an_obj_covers_its_area(face):
    lines = [f"v {x} {y} {z}" for x, y, z in SQUARE] + [face]
    mesh = read("\n".join(lines).encode())
    assert len(mesh.faces) == 3
    assert surface_area(mesh.vertices, mesh.faces) == pytest.approx(5.0)
    assert (area_vectors(mesh.vertices, mesh.faces)[:, 2] > 0.0).all()


def test_a_backward_index_of_an_obj_counts_from_where_it_stands():
    text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n"
    assert read(text).faces.tolist() == [[0, 1, 2], [3, 4, 5]]


def mixed_ply(order: str, lists: bool) -> bytes:
    """Triangles and quadrangles with a scalar before and a second list after, and an edge table."""
    name = {"<": "little", ">": "big"}[order]
    header = (
        f"ply\nformat binary_{name}_endian 1.0\nelement note 2\nproperty short id\n"
        "element face 2\nproperty uchar flag\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nelement vertex 5\nproperty uchar a\n"
        "property double x\nproperty double y\nproperty double z\n"
        "element edge 1\nproperty int from\nend_header\n"
    ).encode()
    rows = struct.pack(order + "2h", 4, 5)
    for face in ([0, 1, 2, 3], [2, 4, 3] if lists else [2, 4, 3, 3]):
        rows += struct.pack(order + f"BB{len(face)}i", 7, len(face), *face)
        rows += struct.pack(order + "B2f", 2, 0.5, 0.5)
    for point in SQUARE.tolist():
        rows += struct.pack(order + "B3d", 9, *point)
    return header + rows + struct.pack(order + "i", 3)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("lists", [True, False])
def test_a_ply_with_other_columns_lists_and_tables_is_read(order, lists):
    mesh = read_ply(mixed_ply(order, lists), LIMITS)
    assert np.array_equal(mesh.vertices, SQUARE)
    assert surface_area(mesh.vertices, mesh.faces) == pytest.approx(5.0)


def test_words_and_lines_are_counted_as_split_counts_them():
    text = b"  v 1  2\r\n\n\tf\n \n3 4"
    rows = text_lines(text)
    assert rows.counts.tolist() == [len(line.split()) for line in text.split(b"\n") if line.split()]
    assert floats(b"1 2\n3", 3).tolist() == [1.0, 2.0, 3.0]


@given(numbers=st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=30))
@settings(max_examples=60, deadline=None)
def test_numbers_are_read_as_python_reads_them(numbers):
    text = " \n".join(repr(number) for number in numbers).encode()
    assert floats(text, len(numbers)).tolist() == numbers


# ---------------------------------------------------------------- recognition


@pytest.mark.parametrize("extension", WRITERS)
def test_every_written_format_is_recognised_once(extension):
    data = encoded_mesh(*shuffled(*MESHES["torus"], np.random.default_rng(3)), extension)
    found = [known.extension for known in FORMATS if known.recognised(data)]
    assert found == [extension]
    assert extension in EXTENSIONS


def test_foreign_content_is_named():
    assert "PNG" in likeness(b"\x89PNG\r\n")
    assert "ZIP" in likeness(corpus.zipped())
    assert "Git LFS" in likeness(b"version https://git-lfs.github.com/spec/v1\noid sha256:0")
    assert "HTML" in likeness(b"\n <HTML>")
    assert "HTML" in likeness(b"\xef\xbb\xbf<html>")  # behind a byte order mark
    assert known_foreign(corpus.stl()) is None
    assert is_text(corpus.obj())
    assert not is_text(corpus.stl())


def test_only_the_beginning_says_what_a_file_is():
    """4 KiB of it for text; of a 3MF 64 KiB at both ends, where a ZIP names its parts."""
    assert not is_text(b"a" * 4_095 + b"\0")
    assert is_text(b"a" * 4_096 + b"\0")
    name = b"3D/3dmodel.model"
    for before, behind in ((65_520, 99_999), (99_999, 65_530)):
        assert is_3mf(b"PK\3\4" + bytes(before - 4) + name + bytes(behind))
    assert not is_3mf(b"PK\3\4" + bytes(65_536) + name + bytes(65_536))


@pytest.mark.parametrize(("points", "said"), [(3, "3 points but no faces"), (0, "no triangles")])
def test_a_file_without_a_face_says_what_it_holds(points, said):
    raw = RawMesh(np.zeros((points, 3)), np.zeros((0, 3), dtype=np.int64))
    with pytest.raises(EmptyMesh, match=f"the file holds {said}:"):
        checked_mesh(raw, LIMITS)
