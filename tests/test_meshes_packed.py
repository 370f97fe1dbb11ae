"""GLB and 3MF: the right shape, in the right place, in the right unit, and nothing from outside."""

from __future__ import annotations

import json
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.errors import InputError
from footfit.geometry.mesh.surface import area_vectors
from footfit.meshes.known_formats import raw_mesh
from footfit.meshes.read_limits import LIMITS
from tests import corpus, packed
from tests.bounds import ROUNDING
from tests.distortions import moved, random_pose
from tests.reading import scan_from_bytes

ROOT = Path(__file__).resolve().parents[1]


def read(data: bytes):
    return raw_mesh(data, None, None, LIMITS)[1]


def turned_x_90(points):
    return points[:, [0, 2, 1]] * [1, -1, 1]


@pytest.mark.parametrize("seed", range(3))
def test_what_trimesh_writes_as_glb_is_read_where_its_node_puts_it(seed):
    pose = random_pose(np.random.default_rng(seed))
    vertices = corpus.VERTICES / 1000.0
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.Trimesh(vertices, corpus.FACES, process=False), transform=pose)
    raw = read(scene.export(file_type="glb"))
    assert raw.unit == "m"
    expected = moved(vertices, pose)
    assert np.allclose(raw.vertices[raw.faces], expected[corpus.FACES], atol=6e-9, rtol=0)


def test_glb_nodes_are_applied_from_the_mesh_outwards():
    raw = read(corpus.ODD["placed.glb"]())
    inner = corpus.VERTICES[:, [1, 0, 2]] * [1, -1, 1] / 1000.0  # the matrix, column by column
    cosine, sine = 0.28, 0.96  # of the angle whose half has the sine .6
    turn = np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])
    assert np.allclose(
        raw.vertices, inner @ turn.T + [1, 2, 3], atol=6e-9, rtol=0
    )  # float32: 3.2e-9


def test_glb_strips_and_interleaved_points():
    strip = read(packed.strip_glb())
    assert strip.faces.shape == (6, 3)
    assert np.ptp(strip.vertices, axis=0).tolist() == pytest.approx([0.6, 0.2, 0.0])
    # every other triangle is turned over, so that all look up
    assert area_vectors(strip.vertices, strip.faces)[:, 2] == pytest.approx([0.02] * 6)
    points = np.zeros((len(packed.VERTICES), 6), dtype="<f4")
    points[:, :3], points[:, 3:] = packed.VERTICES, 7.0
    tree = packed.tree()
    tree["bufferViews"][1] |= {"byteLength": points.nbytes, "byteStride": 24}
    tree["buffers"] = [{"byteLength": packed.FACES.size * 2 + points.nbytes}]
    content = packed.FACES.astype("<u2").tobytes() + points.tobytes()
    raw = read(packed.glb_of(json.dumps(tree).encode(), content))
    assert np.allclose(raw.vertices, packed.VERTICES, rtol=1e-7)


def test_glb_parts_of_one_object_are_one_mesh_and_keep_their_own_counts():
    def two_parts(tree):
        half = packed.FACES.size // 2
        tree["accessors"].append(dict(tree["accessors"][0], count=half, byteOffset=half * 2))
        tree["accessors"][0]["count"] = half
        second = {"attributes": {"POSITION": 1}, "indices": 2}
        tree["meshes"][0]["primitives"].append(second)

    scan = scan_from_bytes(packed.glb(two_parts))
    assert scan.info.watertight
    assert scan.info.faces == len(packed.FACES)


def test_3mf_transforms_are_applied_from_the_mesh_outwards():
    raw = read(corpus.ODD["placed.3mf"]())
    inner = turned_x_90(packed.VERTICES) + np.array([0, 0, 9])
    outer = inner[:, [1, 0, 2]] * [-1, 1, 1] + [5, 6, 7]
    assert np.allclose(raw.vertices, outer)
    assert np.array_equal(raw.faces, packed.FACES)


@pytest.mark.parametrize(
    ("name", "unit", "scale"),
    [
        ("metres.glb", "m", 1000.0),
        ("plain.3mf", "mm", 1.0),
        ("inches.3mf", "in", 25.4),
        ("microns.3mf", "mm", 1.0),
        ("feet.3mf", "in", 25.4),
    ],
)
def test_the_files_own_unit_is_honoured_and_can_be_overruled(name, unit, scale):
    data = corpus.ODD[name]()
    scan = scan_from_bytes(data)
    info = scan.info
    assert (info.units, info.units_source, info.unit_scale) == (unit, "declared", scale)
    assert np.ptp(scan.vertices_mm[:, 0]) == pytest.approx(250.0, rel=ROUNDING)
    other = scan_from_bytes(data, units="cm")
    assert np.ptp(other.vertices_mm[:, 0]) == pytest.approx(250.0 / scale * 10.0, rel=ROUNDING)


def test_a_hidden_and_unbuilt_object_plays_no_part():
    more = (
        '<object id="7"><mesh><vertices><vertex x="1" y="2" z="3"/></vertices>'
        "<triangles/></mesh></object>"
    )
    raw = read(packed.threemf(packed.model(more=more)))
    assert np.array_equal(raw.vertices, packed.VERTICES)


def test_nothing_but_the_bytes_is_touched():
    """Opening a file or a socket ends the process, whatever the model names."""
    program = (
        "import sys, trimesh, zipfile, xml.parsers.expat\n"
        "from footfit.errors import InputError\n"
        "from tests.reading import scan_from_bytes\n"
        "from tests import corpus\n"
        "names = ('other-file.glb', 'other-site.glb', 'outside-entity.3mf', 'other-part.3mf')\n"
        "files = [bad.make() for bad in corpus.BAD if bad.name in names]\n"
        "files += [corpus.ODD[name]() for name in ('with-picture.glb', 'plain.3mf')]\n"
        "scan_from_bytes(corpus.ODD['metres.glb']())\n"
        "touched = []\n"
        "def guard(event, args):\n"
        "    if event.split('.')[0] in ('socket', 'open', 'os', 'subprocess'):\n"
        "        if not str(args[0]).endswith(('.py', '.pyc')): touched.append(event)\n"
        "sys.addaudithook(guard)\n"
        "for data in files:\n"
        "    try: scan_from_bytes(data)\n"
        "    except InputError: pass\n"
        "with open('/dev/null'): pass  # so that the guard is seen to work\n"
        "print(len(files), touched)\n"
    )
    command = [sys.executable, "-c", program]
    run = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert run.stdout.strip() == "6 ['open']", run.stderr


@st.composite
def changed_trees(draw):
    """A GLB whose description has a few values replaced by others of any kind."""
    tree = packed.tree()
    values = st.sampled_from([-1, 0, 1, 2, 5, 999, 10**12, 0.5, None, True, "x", [], {}, [0], "0"])
    for _ in range(draw(st.integers(1, 3))):
        table = draw(st.sampled_from([name for name in tree if isinstance(tree[name], list)]))
        if not tree[table]:
            continue
        row = tree[table][draw(st.integers(0, len(tree[table]) - 1))]
        if isinstance(row, dict) and row:
            row[draw(st.sampled_from([*row, "children", "byteStride", "mode"]))] = draw(values)
        if draw(st.booleans()):
            tree[table] = draw(values | st.just(tree[table]))
    return json.dumps(tree).encode()


@given(text=changed_trees(), cut=st.integers(0, 400))
@settings(max_examples=200, deadline=None)
def test_any_description_gives_a_mesh_or_footfits_own_error(text, cut):
    body = packed.body()
    try:
        scan = scan_from_bytes(packed.glb_of(text, body[: len(body) - cut]), units="m")
    except InputError:
        return
    assert np.isfinite(scan.vertices_mm).all()


@given(data=st.data())
@settings(max_examples=150, deadline=None)
def test_any_flips_in_a_3mf_give_a_mesh_or_footfits_own_error(data):
    changed = bytearray(packed.threemf())
    for _ in range(data.draw(st.integers(1, 5))):
        near_end = st.integers(len(changed) - 250, len(changed) - 1)
        place = data.draw(st.integers(0, len(changed) - 1) | near_end)
        changed[place] = data.draw(st.integers(0, 255))
    try:
        scan_from_bytes(bytes(changed), path="foot.3mf", units="mm")
    except InputError:
        return


def test_a_bomb_of_declared_counts_asks_for_no_memory():
    """One kilobyte that asks for gigabytes: refused from its description alone."""
    text = json.dumps(packed.tree() | {"accessors": [
        {"componentType": 5125, "type": "SCALAR", "count": 6_000_000},
        {"componentType": 5126, "type": "VEC3", "count": 8_000_000},
    ]}).encode()  # fmt: skip
    data = packed.glb_of(text, struct.pack("<3f", 0, 0, 0))
    assert len(data) < 900  # measured 490
    with pytest.raises(InputError):
        read(data)
