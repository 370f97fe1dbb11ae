"""GLB and 3MF scenes: one surface in several objects is one surface again, each in its place."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from footfit.meshes.write import encoded_mesh
from tests import packed
from tests.bounds import ROUNDING
from tests.conftest import SAMPLES
from tests.distortions import moved, random_pose
from tests.reading import scan_from_bytes

VERTICES, FACES = packed.VERTICES, packed.FACES
SCALES = {"plain": None, "small": [0.5, 0.5, 0.5], "uneven": [2.0, 0.5, 1.0], "mirror": [-1, 1, 1]}


def pieces(vertices, faces, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """The faces from heel to toe in ``count`` pieces, each with vertices of its own."""
    order = np.argsort(vertices[faces].mean(axis=1)[:, 0], kind="stable")
    cut = []
    for part in np.array_split(faces[order], count):
        used, corners = np.unique(part, return_inverse=True)
        cut.append((vertices[used], corners.reshape(-1, 3)))
    return cut


def scene_glb(meshes, nodes, scenes=None, **more) -> bytes:
    """A GLB of these meshes (points in metres, faces); ``nodes`` are the rows of its tree."""
    tree: packed.Tree = {"asset": {"version": "2.0"}, "scene": 0, "nodes": nodes}
    tree |= {"scenes": scenes or [{"nodes": [0]}], "meshes": [], "accessors": [], "bufferViews": []}
    content = b""
    for points, faces in meshes:
        first = len(tree["accessors"])
        for data, kind, row in (
            (points.astype("<f4").tobytes(), 5126, "VEC3"),
            (faces.astype("<u4").tobytes(), 5125, "SCALAR"),
        ):
            view = {"buffer": 0, "byteOffset": len(content), "byteLength": len(data)}
            count = len(data) // (12 if row == "VEC3" else 4)
            accessor = {"bufferView": len(tree["bufferViews"]), "componentType": kind}
            tree["accessors"].append(accessor | {"type": row, "count": count})
            tree["bufferViews"].append(view)
            content += data
        primitive = {"attributes": {"POSITION": first}, "indices": first + 1}
        tree["meshes"].append({"primitives": [primitive]})
    tree["buffers"] = [{"byteLength": len(content)}]
    return packed.glb_of(json.dumps(tree | more).encode(), content)


def quaternion(rotation) -> list[float]:
    """x, y, z, w of a rotation (3, 3), as the eigenvector that [horn1987] builds it from."""
    m = rotation
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]],
            [0, m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
            [0, 0, m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
            [0, 0, 0, np.trace(m)],
        ]
    )
    return np.linalg.eigh(k, UPLO="U")[1][:, -1].tolist()


def assert_is_the_whole(scan, vertices=VERTICES, faces=FACES, kind: str = "closed") -> None:
    """The scan is the shape again: closed, with every face once, where it was."""
    assert scan.info.watertight == (kind == "closed")
    assert (len(scan.vertices_mm), len(scan.faces)) == (len(vertices), len(faces))
    # measured 0.00011
    assert np.allclose(np.sort(scan.vertices_mm, axis=0), np.sort(vertices, axis=0), atol=1.7e-4)


@pytest.mark.parametrize("count", [1, 2, 3, 17])
@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("form", ["in place", "matrix", "trs"])
def test_one_surface_in_several_nodes_of_a_glb_is_closed_again(count, scale, form):
    rng = np.random.default_rng(count)
    nodes, meshes = [{"children": list(range(1, count + 1))}], []
    for number, (points, faces) in enumerate(pieces(VERTICES / 1000.0, FACES, count)):
        pose = np.eye(4) if form == "in place" else random_pose(rng, shift_mm=3.0)
        if form != "in place" and SCALES[scale] is not None:
            pose[:3, :3] *= SCALES[scale]
        mirror = np.linalg.det(pose[:3, :3]) < 0
        meshes.append((moved(points, np.linalg.inv(pose)), faces[:, ::-1] if mirror else faces))
        node = {"mesh": number}
        if form == "matrix":
            node["matrix"] = pose.T.ravel().tolist()
        elif form == "trs":
            lengths = np.linalg.norm(pose[:3, :3], axis=0)
            lengths[0] *= -1 if mirror else 1
            node |= {"scale": lengths.tolist(), "translation": pose[:3, 3].tolist()}
            node["rotation"] = quaternion(pose[:3, :3] / lengths)
        nodes.append(node)
    scan = scan_from_bytes(scene_glb(meshes, nodes))
    assert_is_the_whole(scan)
    codes = [notice.code for notice in scan.warnings]
    assert codes == (["objects_joined"] if count > 1 else [])


def test_nested_nodes_apply_from_the_mesh_outwards():
    """Each node stands in its parent's frame, three deep, and a node with a mesh has children."""
    rng = np.random.default_rng(4)
    poses = [random_pose(rng, shift_mm=1.0) for _ in range(3)]
    meshes, nodes, above = [], [], np.eye(4)
    for number, (points, faces) in enumerate(pieces(VERTICES / 1000.0, FACES, 3)):
        above = above @ poses[number]
        meshes.append((moved(points, np.linalg.inv(above)), faces))
        matrix = poses[number].T.ravel().tolist()
        nodes.append({"mesh": number, "matrix": matrix, "children": [number + 1]})
    del nodes[-1]["children"]
    assert_is_the_whole(scan_from_bytes(scene_glb(meshes, nodes)))


def test_a_seam_that_rounding_moved_is_closed_and_a_real_gap_stays():
    halves = pieces(VERTICES, FACES, 2)
    for away_mm, kind in ((0.001, "closed"), (0.5, "open")):
        moved_half = (halves[1][0] + [away_mm, 0.0, 0.0], halves[1][1])
        meshes = [(points / 1000.0, faces) for points, faces in (halves[0], moved_half)]
        scan = scan_from_bytes(scene_glb(meshes, [{"mesh": 0, "children": [1]}, {"mesh": 1}]))
        assert scan.info.watertight == (kind == "closed"), away_mm


SENSORS = [
    {"camera": 0},
    {"name": "empty"},
    {"children": [5]},
    {"camera": 0, "rotation": [0.0] * 4},
]


@pytest.mark.parametrize(
    ("scenes", "nodes", "more"),
    [
        ([{"nodes": [0]}], [{"mesh": 0}], {}),
        ([{"nodes": [0, 2, 3, 4]}], [{"mesh": 0}, {"mesh": 0}, *SENSORS], {}),
        ([{"nodes": [1]}, {"nodes": [0]}], [{"mesh": 0}, {"mesh": 1}], {"scene": 1}),
        ([{"nodes": [0]}, {"nodes": [1]}], [{"mesh": 0}, {"mesh": 1}], {}),
        ([{"nodes": [1]}], [{"mesh": 0}, {"children": [0]}], {}),
    ],
    ids=["one", "cameras", "second scene", "first scene", "child before parent"],
)
def test_what_the_scene_shows_is_read_and_nothing_else(scenes, nodes, more):
    other = (VERTICES / 500.0, FACES)
    data = scene_glb([(VERTICES / 1000.0, FACES), other], nodes, scenes, **more)
    scan = scan_from_bytes(data)
    assert_is_the_whole(scan)
    assert scan.warnings == ()


def test_without_a_scene_the_nodes_without_a_parent_are_read():
    tree = packed.tree() | {"nodes": [{"mesh": 0}, {"children": [0], "translation": [1, 0, 0]}]}
    del tree["scenes"], tree["scene"]
    scan = scan_from_bytes(packed.glb_of(json.dumps(tree).encode(), packed.body()))
    assert_is_the_whole(scan, VERTICES + np.array([1000.0, 0.0, 0.0]))


def test_a_mesh_that_several_nodes_show_stands_in_each_of_their_places():
    nodes = [{"mesh": 0}, {"mesh": 0, "translation": [0.0, 0.3, 0.0]}, {"mesh": 0}]
    data = scene_glb([(VERTICES / 1000.0, FACES)], nodes, [{"nodes": [0, 1, 2]}])
    scan = scan_from_bytes(data)
    assert len(scan.faces) == 2 * len(FACES)  # the third lies in the first, face on face
    # measured 1.5e-06
    assert np.ptp(scan.vertices_mm[:, 1]) == pytest.approx(
        np.ptp(VERTICES[:, 1]) + 300.0, abs=2.3e-6
    )


def test_lines_beside_a_surface_are_passed_over_and_fans_are_read():
    def lines(tree):
        drawn = {"attributes": {"POSITION": 1}, "mode": 1}
        tree["meshes"][0]["primitives"].insert(0, drawn)

    assert_is_the_whole(scan_from_bytes(packed.glb(lines)))
    ring = np.array([[0.0, 0.0, 0.0]] + [[0.2 * np.cos(k), 0.2 * np.sin(k), 0.0] for k in range(6)])
    tree = packed.tree(ring, np.arange(7).reshape(1, 7))
    tree["meshes"][0]["primitives"][0]["mode"] = 6
    content = packed.body(ring, np.arange(7).reshape(1, 7), 1.0)
    fan = scan_from_bytes(packed.glb_of(json.dumps(tree).encode(), content))
    assert sorted(map(sorted, fan.faces.tolist())) == [[0, k, k + 1] for k in range(1, 6)]


# ---------------------------------------------------------------- the JSON chunk


def raw_glb(text: bytes, declared: int, filled: bytes) -> bytes:
    """A GLB whose JSON chunk says ``declared`` bytes, and is filled up with ``filled``."""
    content = packed.body()
    length = 28 + len(text) + len(filled) + len(content)
    head = struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", declared, b"JSON")
    return head + text + filled + struct.pack("<I4s", len(content), b"BIN\0") + content


@pytest.mark.parametrize("spare", [0, 1, 2, 3])
@pytest.mark.parametrize("filling", [b"   ", b"\0\0\0", b" \0\0", b"\n \0", None, "uncounted"])
def test_a_json_chunk_may_be_filled_up_with_anything_or_nothing(spare, filling):
    text = json.dumps(packed.tree()).encode()
    text = text.replace(b"{", b"{" + b" " * ((4 - spare - len(text)) % 4), 1)
    assert -len(text) % 4 == spare
    if filling is None:
        data = raw_glb(text, len(text), b"")
    elif filling == "uncounted":
        data = raw_glb(text, len(text), b"\0" * spare)
    else:
        data = raw_glb(text, len(text) + spare, filling[:spare])
    assert_is_the_whole(scan_from_bytes(data))


def test_a_json_chunk_may_begin_with_a_byte_order_mark():
    text = b"\xef\xbb\xbf" + json.dumps(packed.tree()).encode()
    assert_is_the_whole(scan_from_bytes(packed.glb_of(text, packed.body())))


# ---------------------------------------------------------------- 3MF


def object_3mf(number: int, points, faces) -> str:
    rows = "".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in points.tolist())
    corners = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces.tolist())
    mesh = f"<mesh><vertices>{rows}</vertices><triangles>{corners}</triangles></mesh>"
    return f'<object id="{number}" type="model">{mesh}</object>'


def words(pose) -> str:
    """A (4, 4) transform as a 3MF writes it, rounded as some programs do."""
    return " ".join(f"{value:.9f}" for value in pose[:3].T.ravel())


def model_3mf(objects: str, build: str) -> bytes:
    return packed.threemf(
        f'<model unit="millimeter" xmlns="{packed.CORE}"><resources>{objects}</resources>'
        f"<build>{build}</build></model>"
    )


@pytest.mark.parametrize("count", [2, 3, 17])
@pytest.mark.parametrize("kind", ["items", "components", "nested"])
def test_one_surface_in_several_objects_of_a_3mf_is_closed_again(count, kind):
    rng = np.random.default_rng(count)
    objects, uses = "", []
    around = random_pose(rng) if kind == "nested" else np.eye(4)
    for number, (points, faces) in enumerate(pieces(VERTICES, FACES, count), start=1):
        pose = random_pose(rng)
        objects += object_3mf(number, moved(points, np.linalg.inv(around @ pose)), faces)
        uses.append(f'objectid="{number}" transform="{words(pose)}"')
    build = "".join(f"<item {use}/>" for use in uses)
    if kind != "items":
        components = "".join(f"<component {use}/>" for use in uses)
        objects += f'<object id="900"><components>{components}</components></object>'
        build = f'<item objectid="900" transform="{words(around)}"/>'
    scan = scan_from_bytes(model_3mf(objects, build))
    assert_is_the_whole(scan)
    assert [notice.code for notice in scan.warnings] == ["objects_joined"]


def test_an_object_that_a_3mf_builds_twice_stands_in_both_places():
    beside = np.eye(4)
    beside[1, 3] = 300.0
    build = f'<item objectid="1"/><item objectid="1" transform="{words(beside)}"/>'
    scan = scan_from_bytes(model_3mf(object_3mf(1, VERTICES, FACES), build))
    assert len(scan.faces) == 2 * len(FACES)
    assert np.ptp(scan.vertices_mm[:, 1]) == pytest.approx(np.ptp(VERTICES[:, 1]) + 300.0)


# ---------------------------------------------------------------- feet


def foot_scan():
    return scan_from_bytes((SAMPLES / "feet" / "mh007_R.stl").read_bytes())


def length_mm(footfit, path: Path) -> float:
    return footfit("measure", path, "--json").document["measures"]["length"]["value"]


def test_a_foot_in_pages_is_as_long_as_the_whole_foot(footfit, tmp_path):
    """A scanner writes pages of some thousand faces; a slicer puts objects together."""
    foot = foot_scan()
    whole, glb, threemf = (tmp_path / f"foot.{name}" for name in ("stl", "glb", "3mf"))
    whole.write_bytes(encoded_mesh(foot.vertices_mm, foot.faces, "stl"))
    cut = pieces(foot.vertices_mm, foot.faces, 3)
    rows = [{"mesh": number} for number in range(3)]
    meshes = [(points / 1000.0, faces) for points, faces in cut]
    glb.write_bytes(scene_glb(meshes, [{"children": [1, 2, 3]}, *rows]))
    objects = "".join(object_3mf(k, *part) for k, part in enumerate(cut))
    threemf.write_bytes(model_3mf(objects, "".join(f'<item objectid="{k}"/>' for k in range(3))))
    expected = length_mm(footfit, whole)
    assert expected > 200.0
    for path in (glb, threemf):
        # float32 in metres: 0.00002 mm
        assert length_mm(footfit, path) == pytest.approx(expected, abs=ROUNDING)


def test_two_feet_as_two_objects_are_refused_as_several_feet(footfit, tmp_path):
    foot = foot_scan()
    nodes = [{"mesh": 0}, {"mesh": 0, "translation": [0.0, 0.4, 0.0], "scale": [1.0, -1.0, 1.0]}]
    path = tmp_path / "both.glb"
    meshes = [(foot.vertices_mm / 1000.0, foot.faces)]
    path.write_bytes(scene_glb(meshes, nodes, [{"nodes": [0, 1]}]))
    run = footfit("measure", path, "--json")
    assert run.code == 5
    assert json.loads(run.last_error)["code"] == "several_feet"


def test_a_foot_and_its_platform_as_two_objects_are_the_foot(footfit, tmp_path):
    foot = foot_scan()
    low, high = foot.vertices_mm.min(axis=0), foot.vertices_mm.max(axis=0)  # it stands on z = 0
    low, high = low - [40.0, 40.0, 6.0], np.append(high[:2] + 40.0, low[2] - 1.0)
    path, plain = tmp_path / "platform.glb", tmp_path / "foot.stl"
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    box = low + corners * (high - low)
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = np.array([[a, b, c] for a, b, c, d in sides] + [[a, c, d] for a, b, c, d in sides])
    meshes = [(foot.vertices_mm / 1000.0, foot.faces), (box / 1000.0, faces)]
    path.write_bytes(scene_glb(meshes, [{"mesh": 0}, {"mesh": 1}], [{"nodes": [0, 1]}]))
    plain.write_bytes(encoded_mesh(foot.vertices_mm, foot.faces, "stl"))
    assert length_mm(footfit, path) == pytest.approx(length_mm(footfit, plain), abs=ROUNDING)
