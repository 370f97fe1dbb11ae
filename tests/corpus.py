"""Files that must be refused, or read in spite of what is wrong, made by code.

``BAD`` are bytes with the error that reading them must end in; ``ODD`` are bytes that hold the
reference mesh all the same. ``bad_paths`` makes the special files of a file system.
"""

from __future__ import annotations

import gzip
import io
import os
import struct
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from footfit.errors import (
    DamagedMesh,
    EmptyMesh,
    InputError,
    TooLarge,
    UnknownFormat,
    UnreadableFile,
)
from footfit.meshes.write import encoded_mesh
from tests import packed, rhino_models, shapes

VERTICES, FACES = shapes.ellipsoid((125.0, 50.0, 35.0), subdivisions=2)


@dataclass(frozen=True)
class Bad:
    """A file's name and content, and how reading it must end."""

    name: str
    make: Callable[[], bytes]
    error: type[InputError]

    def __str__(self) -> str:
        return self.name


def stl() -> bytes:
    return encoded_mesh(VERTICES, FACES, "stl")


def ply() -> bytes:
    return encoded_mesh(VERTICES, FACES, "ply")


def obj() -> bytes:
    return encoded_mesh(VERTICES, FACES, "obj")


def off() -> bytes:
    return encoded_mesh(VERTICES, FACES, "off")


def ascii_stl(vertices=VERTICES, faces=FACES) -> bytes:
    lines = ["solid vertex facet"]
    for corners in vertices[faces].tolist():
        lines += ["facet normal nan 0 0", " outer loop"]
        lines += [f"  vertex {x:.17g} {y:.17g} {z:.17g}" for x, y, z in corners]
        lines += [" endloop", "endfacet"]
    return ("\n".join([*lines, "endsolid vertex facet"]) + "\n").encode()


def ascii_ply(vertices=VERTICES, faces=FACES) -> bytes:
    rows = [f"{x!r} {y!r} {z!r} 200" for x, y, z in vertices.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in faces.tolist()]
    header = (
        f"ply\nformat ascii 1.0\ncomment made by code\nelement vertex {len(vertices)}\n"
        "property double x\nproperty double y\nproperty double z\nproperty uchar red\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_index\nend_header\n"
    )
    return (header + "\n".join(rows) + "\n").encode()


def with_count(count: int) -> bytes:
    return stl()[:80] + struct.pack("<I", count) + stl()[84:]


def with_first_coordinate(value: float) -> bytes:
    return with_first_bits(struct.unpack("<I", struct.pack("<f", value))[0])


def with_first_bits(bits: int) -> bytes:
    data = bytearray(stl())
    data[96:100] = struct.pack("<I", bits)
    return bytes(data)


def ply_header(vertex_count: object, face_count: object, list_type: str = "uint") -> bytes:
    return (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {vertex_count}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {face_count}\nproperty list {list_type} int vertex_indices\nend_header\n"
    ).encode()


def ply_bomb(list_length: int) -> bytes:
    triangle = np.eye(3, dtype="<f4").tobytes()
    return ply_header(3, 1) + triangle + struct.pack("<I3i", list_length, 0, 1, 2)


def obj_with(line: str) -> bytes:
    return b"v 0 0 0\nv 200 0 0\nv 0 200 0\n" + line.encode() + b"\n"


def long_face(corners: int) -> bytes:
    return obj_with("f " + " ".join(str(1 + corner % 3) for corner in range(corners)))


def zipped() -> bytes:
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w") as archive:
        archive.writestr("foot.stl", stl())
    return memory.getvalue()


def flat_stl() -> bytes:
    return encoded_mesh(VERTICES * [1.0, 0.0, 0.0], FACES, "stl")


_NOISE = "0123456789" * 5
_P = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"/>'
_TWO = '<item objectid="2"/>'
_LOOP = '<object id="2"><components><component objectid="2"/></components></object>'
_SAME = '<object id="1"><mesh/></object>'


def _part(tree: packed.Tree) -> packed.Tree:
    return tree["meshes"][0]["primitives"][0]


def _without_view(tree: packed.Tree) -> None:
    del tree["accessors"][1]["bufferView"]
    tree["accessors"][1]["count"] = 2_000_000


def _compressed(tree: packed.Tree) -> None:
    tree["extensionsRequired"] = ["KHR_draco_mesh_compression"]


def _compressed_part(tree: packed.Tree) -> None:
    _part(tree)["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0}}


def _ring(tree: packed.Tree) -> None:
    tree["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [2]}, {"children": [0]}]


def _doubling(tree: packed.Tree) -> None:
    """Thirty nodes that show the mesh 2 ** 29 times."""
    tree["nodes"] = [{"children": [k + 1, k + 1]} for k in range(29)] + [{"mesh": 0}]


def _many_objects(tree: packed.Tree) -> None:
    """600 objects of two parts each: more parts than one mesh has."""
    tree["scenes"][0]["nodes"] = [0] * 600
    tree["meshes"][0]["primitives"] *= 2


def _many_parts(tree: packed.Tree) -> None:
    tree["meshes"][0]["primitives"] *= 20_000


def _flipped(data: bytes) -> bytes:
    return data[:500] + bytes([data[500] ^ 255]) + data[501:]


def _encrypted(data: bytes) -> bytes:
    flagged = bytearray(data)
    flagged[data.rfind(b"PK\1\2") + 8] |= 1
    return bytes(flagged)


def _model_around(text: str) -> str:
    return packed.model(build=text)


def loose(xml: str) -> bytes:
    """Stored as it is, so that it is no bomb by its ratio."""
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w") as archive:
        archive.writestr(packed.MODEL, xml)
    return memory.getvalue()


def _doubling_model() -> str:
    """Thirty objects that put the first together 2 ** 29 times."""
    twice = "<object id='{0}'><components><component objectid='{1}'/><component objectid='{1}'/>"
    rows = (twice.format(k + 1, k) + "</components></object>" for k in range(1, 30))
    return packed.model(build='<item objectid="30"/>', more="".join(rows))


def _built(items: str) -> bytes:
    return packed.threemf(packed.model(build=items))


BAD = [
    Bad("empty.stl", lambda: b"", EmptyMesh),
    Bad("header-only.stl", lambda: bytes(84), EmptyMesh),
    Bad("half-a-header.stl", lambda: bytes(50), DamagedMesh),
    Bad("cut-off.stl", lambda: stl()[:-37], DamagedMesh),
    Bad("solid-and-cut-off.stl", lambda: b"solid" + stl()[5:-37], DamagedMesh),
    Bad("count-too-high.stl", lambda: with_count(2**32 - 1), DamagedMesh),
    Bad("count-too-low.stl", lambda: with_count(1), DamagedMesh),
    Bad("count-zero.stl", lambda: with_count(0), DamagedMesh),
    Bad("nan.stl", lambda: with_first_coordinate(float("nan")), DamagedMesh),
    Bad("signalling-nan.stl", lambda: with_first_bits(0x7FA00000), DamagedMesh),
    Bad("infinite.stl", lambda: with_first_coordinate(float("inf")), DamagedMesh),
    Bad("absurd.stl", lambda: with_first_coordinate(3e38), DamagedMesh),
    Bad("no-area.stl", flat_stl, EmptyMesh),
    Bad("cut-off-ascii.stl", lambda: ascii_stl()[: len(ascii_stl()) // 2], DamagedMesh),
    Bad("misspelt-ascii.stl", lambda: ascii_stl().replace(b"loop", b"lopp", 3), DamagedMesh),
    Bad("no-number-ascii.stl", lambda: ascii_stl().replace(b"vertex 1", b"vertex x"), DamagedMesh),
    Bad("two-in-one-ascii.stl", lambda: ascii_stl().replace(b".", b"-.", 9), DamagedMesh),
    Bad("solid-nothing.stl", lambda: b"solid nothing\nendsolid nothing\n", EmptyMesh),
    Bad("random.stl", lambda: np.random.default_rng(5).bytes(5000), DamagedMesh),
    Bad("random", lambda: np.random.default_rng(5).bytes(5000), UnknownFormat),
    Bad("cut-off.ply", lambda: ply()[:-3], DamagedMesh),
    Bad("headless.ply", lambda: ply()[:60], DamagedMesh),
    Bad("count-too-high.ply", lambda: ply_header(10**6, 10**6) + bytes(99), DamagedMesh),
    Bad("count-past-limit.ply", lambda: ply_header(10**9, 1) + bytes(99), TooLarge),
    Bad("count-absurd.ply", lambda: ply_header("9" * 5000, 1) + bytes(99), DamagedMesh),
    Bad("count-negative.ply", lambda: ply_header(-3, 1) + bytes(99), DamagedMesh),
    Bad("list-bomb.ply", lambda: ply_bomb(2**32 - 1), DamagedMesh),
    Bad("list-bomb-2.ply", lambda: ply_bomb(2**20), DamagedMesh),
    Bad("list-of-floats.ply", lambda: ply_header(3, 1, "float") + b"\xff" * 60, DamagedMesh),
    Bad("index-past-end.ply", lambda: ply()[:-4] + struct.pack("<i", 10**6), DamagedMesh),
    Bad("index-negative.ply", lambda: ply()[:-4] + struct.pack("<i", -1), DamagedMesh),
    Bad("points-only.ply", lambda: ply_header(3, 0) + bytes(36), EmptyMesh),
    Bad("no-z.ply", lambda: ply().replace(b" z\n", b" w\n"), DamagedMesh),
    Bad("no-such-type.ply", lambda: ply().replace(b"double x", b"quad32 x"), DamagedMesh),
    Bad("cut-off-ascii.ply", lambda: ascii_ply()[:-60], DamagedMesh),
    Bad("half-an-index.ply", lambda: ascii_ply().replace(b"\n3 0 ", b"\n3 0.5 "), DamagedMesh),
    Bad("index-zero.obj", lambda: obj_with("f 0 1 2"), DamagedMesh),
    Bad("index-past-end.obj", lambda: obj_with("f 1 2 4"), DamagedMesh),
    Bad("index-too-far-back.obj", lambda: obj_with("f -1 -2 -4"), DamagedMesh),
    Bad("index-no-number.obj", lambda: obj_with("f 1 2 three"), DamagedMesh),
    Bad("index-huge.obj", lambda: obj_with("f 1 2 99999999999999999999999"), DamagedMesh),
    Bad("index-fraction.obj", lambda: obj_with("f 1 2 2.5"), DamagedMesh),
    Bad("faces-only.obj", lambda: b"# v 1\n f 1 2 3\nf 1 2 3\nv\n", UnknownFormat),
    Bad("faces-only.off", lambda: b"OFF\n0 1 0\n3 0 1 2\n", DamagedMesh),
    Bad("points-only.obj", lambda: obj_with("p 1 2 3"), EmptyMesh),
    Bad("two-coordinates.obj", lambda: obj_with("v 1 2\nf 1 2 3"), DamagedMesh),
    Bad("nan.obj", lambda: obj_with("v nan 2 3\nf 1 2 4"), DamagedMesh),
    Bad("overflow.obj", lambda: obj_with("v 1e999 2 3\nf 1 2 4"), DamagedMesh),
    Bad("one-point-faces.obj", lambda: obj_with("f 1 1 1"), EmptyMesh),
    Bad("edges-only.obj", lambda: obj_with("f 1 2"), EmptyMesh),
    Bad("long-face.obj", lambda: long_face(700_000), TooLarge),
    Bad("cut-off.off", lambda: off()[: len(off()) // 2], DamagedMesh),
    Bad("no-counts.off", lambda: b"OFF\n", DamagedMesh),
    Bad("count-too-high.off", lambda: b"OFF\n900 900 0\n0 0 0\n", DamagedMesh),
    Bad("count-past-limit.off", lambda: b"OFF\n1e15 1 0\n0 0 0\n", TooLarge),
    Bad("count-negative.off", lambda: b"OFF\n-1 1 0\n0 0 0\n", DamagedMesh),
    Bad("count-nan.off", lambda: b"OFF\nnan 1 0\n0 0 0\n", DamagedMesh),
    Bad("corner-missing.off", lambda: off().replace(b"\n3 0 ", b"\n4 0 ", 1), DamagedMesh),
    Bad("corner-count-nan.off", lambda: off().replace(b"\n3 0 ", b"\nnan 0 ", 1), DamagedMesh),
    Bad("picture.stl", lambda: b"\x89PNG\r\n\x1a\n" + bytes(300), UnknownFormat),
    Bad("archive.stl", zipped, UnknownFormat),
    Bad("packed.stl", lambda: gzip.compress(stl()), UnknownFormat),
    Bad("page.stl", lambda: b"\n<!DOCTYPE HTML><html><p>404</p></html>", UnknownFormat),
    Bad("page.obj", lambda: b"<html>\nv 1 2 3\nf 1 2 3\n</html>", UnknownFormat),
    Bad("pointer.stl", lambda: b"version https://git-lfs.github.com/spec/v1\n", UnknownFormat),
    Bad("document.stl", lambda: b"%PDF-1.7\n" + bytes(200), UnknownFormat),
    Bad("letter.stl", lambda: b"Dear last maker,\nthe foot is attached.\n", UnknownFormat),
    Bad("letter.obj", lambda: b"Dear last maker,\nthe foot is attached.\n", UnknownFormat),
    Bad("table.ply", lambda: b"x,y,z\n1,2,3\n", UnknownFormat),
    Bad("wide.stl", lambda: ascii_stl().decode().encode("utf-16"), UnknownFormat),
    Bad("zeros", lambda: bytes(1000), UnknownFormat),
    Bad("cut-off.glb", lambda: packed.glb()[:-50], DamagedMesh),
    Bad("header-only.glb", lambda: packed.glb()[:16], DamagedMesh),
    Bad("version-1.glb", lambda: b"glTF\1" + packed.glb()[5:], UnknownFormat),
    Bad("no-body.glb", lambda: packed.glb(content=b""), DamagedMesh),
    Bad("no-json.glb", lambda: packed.glb_of(b"[1,", b""), DamagedMesh),
    Bad("deep-json.glb", lambda: packed.glb_of(b"[" * 200_000, b""), DamagedMesh),
    Bad("long-json.glb", lambda: packed.glb_of(b" " * 5_000_000, b""), TooLarge),
    Bad("array-json.glb", lambda: packed.glb_of(b"[1, 2]", b""), DamagedMesh),
    Bad("nan-json.glb", lambda: packed.glb_of(b'{"scene": NaN}', b""), DamagedMesh),
    Bad("wrong-types.glb", lambda: packed.glb_of(b'{"meshes": 3, "nodes": {}}', b""), EmptyMesh),
    Bad("no-mesh.glb", lambda: packed.glb_of(b"{}", b""), EmptyMesh),
    Bad("count-bomb.glb", lambda: packed.glb_with("accessors", 1, count=10**9), TooLarge),
    Bad("count-high.glb", lambda: packed.glb_with("accessors", 1, count=10**5), DamagedMesh),
    Bad("count-half.glb", lambda: packed.glb_with("accessors", 1, count=1.5), DamagedMesh),
    Bad("count-zero.glb", lambda: packed.glb_with("accessors", 1, count=0), DamagedMesh),
    Bad("no-view.glb", lambda: packed.glb(_without_view), UnknownFormat),
    Bad("sparse.glb", lambda: packed.glb_with("accessors", 1, sparse={"count": 1}), UnknownFormat),
    Bad("two-corners.glb", lambda: packed.glb_with("accessors", 0, count=959), DamagedMesh),
    Bad("far-offset.glb", lambda: packed.glb_with("accessors", 1, byteOffset=9), DamagedMesh),
    Bad("below-zero.glb", lambda: packed.glb_with("bufferViews", 1, byteOffset=-4), DamagedMesh),
    Bad("stride.glb", lambda: packed.glb_with("bufferViews", 1, byteStride=10**9), DamagedMesh),
    Bad("stride-zero.glb", lambda: packed.glb_with("bufferViews", 1, byteStride=0), DamagedMesh),
    Bad("loop.glb", lambda: packed.glb_with("nodes", 0, children=[0]), DamagedMesh),
    Bad("no-such-node.glb", lambda: packed.glb_with("nodes", 0, children=[7]), DamagedMesh),
    Bad("other-file.glb", lambda: packed.glb_with("buffers", 0, uri="../secret"), UnknownFormat),
    Bad("other-site.glb", lambda: packed.glb_with("buffers", 0, uri="http://a/b"), UnknownFormat),
    Bad("compressed.glb", lambda: packed.glb(_compressed), UnknownFormat),
    Bad("compressed-part.glb", lambda: packed.glb(_compressed_part), UnknownFormat),
    Bad("posed.glb", lambda: packed.glb_with("nodes", 0, skin=0), UnknownFormat),
    Bad("lines.glb", lambda: packed.glb(lambda t: _part(t).update(mode=1)), UnknownFormat),
    Bad("mode.glb", lambda: packed.glb(lambda t: _part(t).update(mode=7)), UnknownFormat),
    Bad("empty-scene.glb", lambda: packed.glb_with("scenes", 0, nodes=[]), EmptyMesh),
    Bad("ring.glb", lambda: packed.glb(_ring), DamagedMesh),
    Bad("doubling.glb", lambda: packed.glb(_doubling), DamagedMesh),
    Bad("many-objects.glb", lambda: packed.glb(_many_objects), TooLarge),
    Bad("many-parts.glb", lambda: packed.glb(_many_parts), TooLarge),
    Bad("matrix-short.glb", lambda: packed.glb_with("nodes", 0, matrix=[1] * 15), DamagedMesh),
    Bad("matrix-huge.glb", lambda: packed.glb_with("nodes", 0, scale=[1e300] * 3), DamagedMesh),
    Bad("index-past.glb", lambda: packed.glb(content=b"\xff" * 3864), DamagedMesh),
    Bad("nan.glb", lambda: packed.glb(content=packed.body()[:-4] + b"\0\0\xc0\x7f"), DamagedMesh),
    Bad("cut-off.3dm", lambda: rhino_models.model()[:-90], DamagedMesh),
    Bad("head-alone.3dm", lambda: b"3D Geometry File Format       80", DamagedMesh),
    Bad("flipped.3dm", lambda: _flipped(rhino_models.model()), DamagedMesh),
    Bad("hidden.3dm", lambda: rhino_models.hidden_model(), EmptyMesh),
    Bad("leagues.3dm", lambda: rhino_models.model(unit="LightYears"), UnknownFormat),
    Bad("cut-off.3mf", lambda: packed.threemf()[:-90], DamagedMesh),
    Bad("flipped.3mf", lambda: _flipped(packed.threemf()), DamagedMesh),
    Bad("half-xml.3mf", lambda: packed.threemf(packed.model()[:-300]), DamagedMesh),
    Bad("no-xml.3mf", lambda: packed.threemf("not a model"), DamagedMesh),
    Bad("entity-bomb.3mf", lambda: packed.threemf(packed.entity_bomb()), DamagedMesh),
    Bad(
        "outside-entity.3mf",
        lambda: packed.threemf(packed.outside_entity("file:///etc/hostname")),
        DamagedMesh,
    ),
    Bad("zip-bomb.3mf", lambda: packed.threemf(bytes(300_000_000)), TooLarge),
    Bad("blank-bomb.3mf", lambda: packed.threemf(_model_around(" " * 190_000_000)), TooLarge),
    Bad("element-bomb.3mf", lambda: packed.threemf(_model_around("<a/>" * 400_000)), TooLarge),
    Bad("nested-bomb.3mf", lambda: packed.threemf(_model_around("<a>" * 300_000)), TooLarge),
    Bad("long-tag.3mf", lambda: loose(_model_around(f'<a b="{_NOISE * 130_000}"/>')), TooLarge),
    Bad("many-parts.3mf", lambda: packed.many_parts(1_200), TooLarge),
    Bad("very-many-parts.3mf", lambda: packed.many_parts(66_000), TooLarge),
    Bad("size-too-low.3mf", lambda: packed.lying_size(100), DamagedMesh),
    Bad("size-too-high.3mf", lambda: packed.lying_size(2**31), TooLarge),
    Bad("rarely-packed.3mf", lambda: packed.packed_with(zipfile.ZIP_LZMA), UnknownFormat),
    Bad("encrypted.3mf", lambda: _encrypted(packed.threemf()), UnknownFormat),
    Bad("no-model.3mf", lambda: packed.threemf(name="foot.xml"), UnknownFormat),
    Bad("climbing.3mf", lambda: packed.threemf(name="../../other.txt"), UnknownFormat),
    Bad(
        "two-models.3mf", lambda: packed.threemf(name="a.model", **{"b.model": b""}), UnknownFormat
    ),
    Bad("other-part.3mf", lambda: _built('<item objectid="1" p:path="/b" ' + _P), UnknownFormat),
    Bad(
        "needs-more.3mf",
        lambda: packed.threemf(packed.model(unit='requiredextensions="b"')),
        UnknownFormat,
    ),
    Bad("leagues.3mf", lambda: packed.threemf(packed.model(unit='unit="league"')), DamagedMesh),
    Bad("many-objects.3mf", lambda: _built('<item objectid="1"/>' * 1_200), DamagedMesh),
    Bad("doubling.3mf", lambda: packed.threemf(_doubling_model()), DamagedMesh),
    Bad("no-object.3mf", lambda: _built(""), EmptyMesh),
    Bad("no-such-object.3mf", lambda: _built('<item objectid="7"/>'), DamagedMesh),
    Bad("loop.3mf", lambda: packed.threemf(packed.model(build=_TWO, more=_LOOP)), DamagedMesh),
    Bad("same-id.3mf", lambda: packed.threemf(packed.model(more=_SAME)), DamagedMesh),
    Bad("transform.3mf", lambda: _built('<item objectid="1" transform="1 0 0"/>'), DamagedMesh),
    Bad("word.3mf", lambda: packed.threemf(packed.model().replace('"0"', '"x"')), DamagedMesh),
    Bad("no-x.3mf", lambda: packed.threemf(packed.model().replace(" x=", " u=", 1)), DamagedMesh),
    Bad(
        "nan.3mf",
        lambda: packed.threemf(packed.model().replace('x="', 'x="nan" u="', 1)),
        DamagedMesh,
    ),
    Bad(
        "index-past.3mf",
        lambda: packed.threemf(packed.model().replace('v1="0"', 'v1="999"')),
        DamagedMesh,
    ),
    Bad("collada.dae", lambda: b"<?xml version='1.0'?><COLLADA/>", UnknownFormat),
    Bad("text.gltf", lambda: b'{"asset": {"version": "2.0"}}', UnknownFormat),
]

_SECOND = '<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 5 6 7"/>'
_AROUND = (
    '<object id="2"><components><component objectid="1" transform="1 0 0 0 0 1 0 -1 0 0 0 9"/>'
    "</components></object>"
)


def _placed(tree: packed.Tree) -> None:
    tree["nodes"] = [
        {"children": [1], "rotation": [0.6, 0.0, 0.0, 0.8], "translation": [1, 2, 3]},
        {"mesh": 0, "matrix": [0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
    ]


def _pictured(tree: packed.Tree) -> None:
    """An image elsewhere is never looked at: the materials play no part."""
    tree["images"] = [{"uri": "http://example.invalid/skin.png"}, {"uri": "/dev/zero"}]
    tree["textures"] = [{"source": 0}, {"source": 1}]
    tree["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}]
    _part(tree)["material"] = 0


ODD = {
    "solid-header.stl": lambda: b"solid foot" + stl()[10:],
    "trailing.stl": lambda: stl() + b"made by a scanner",
    "ascii.stl": ascii_stl,
    "ascii-upper.STL": lambda: ascii_stl().upper(),
    "ascii-crlf.stl": lambda: ascii_stl().replace(b"\n", b"\r\n"),
    "ascii-cr.stl": lambda: ascii_stl().replace(b"\n", b"\r"),
    "ascii-bom.stl": lambda: b"\xef\xbb\xbf" + ascii_stl(),
    "ascii-solids.stl": lambda: ascii_stl(faces=FACES[:99]) + ascii_stl(faces=FACES[99:]),
    "ascii-no-end.stl": lambda: ascii_stl().rpartition(b"endsolid")[0],
    "ascii.ply": ascii_ply,
    "ascii-crlf.ply": lambda: ascii_ply().replace(b"\n", b"\r\n"),
    "called-otherwise.obj": ply,
    "no-extension": off,
    "comments.off": lambda: (
        off().replace(b"OFF\n", b"OFF # a foot\n#\n\n").replace(b"\n3", b" # x\n3")
    ),
    "coloured.off": lambda: off().replace(b"OFF", b"COFF").replace(b"\n3 0", b"  .1 .2 .3 1\n3 0"),
    "one-line.off": lambda: off().replace(b"OFF\n", b"OFF ", 1),
    "materials.obj": lambda: (
        b"mtllib /dev/stdin\nusemtl x\ng a\n" + obj().replace(b"\nf", b"\ns 1\nf")
    ),
    "coloured.obj": lambda: obj().replace(b"\nv", b" .5 .5 .5 # grey\nv"),
    "continued.obj": lambda: obj().replace(b"f ", b"f \\\n"),
    "metres.glb": packed.glb,
    "placed.glb": lambda: packed.glb(_placed),
    "with-picture.glb": lambda: packed.glb(_pictured),
    "trailing.glb": lambda: packed.glb() + b"made by a scanner",
    "plain.3dm": rhino_models.model,
    "inches.3dm": lambda: rhino_models.model(rhino_models.mesh(VERTICES / 25.4), unit="Inches"),
    "plain.3mf": packed.threemf,
    "inches.3mf": lambda: packed.threemf(packed.model(VERTICES / 25.4, unit='unit="inch"')),
    "microns.3mf": lambda: packed.threemf(packed.model(VERTICES * 1000.0, unit='unit="micron"')),
    "feet.3mf": lambda: packed.threemf(packed.model(VERTICES / 304.8, unit='unit="foot"')),
    "placed.3mf": lambda: packed.threemf(packed.model(build=_SECOND, more=_AROUND)),
    "named.3mf": lambda: packed.threemf(name="3D/other.MODEL"),
    "called-otherwise.stl": packed.threemf,
    "faces-first.obj": lambda: b"".join(sorted(obj().splitlines(keepends=True), key=_faces_first)),
}


def _faces_first(line: bytes) -> bool:
    return not line.startswith(b"f")


def bad_paths(folder: Path) -> list[tuple[Path, type[InputError]]]:
    """Paths that are no readable regular file of a bearable size, made in ``folder``."""
    pipe, inner, loop, huge = (
        folder / name for name in ("pipe.stl", "inner.stl", "loop", "huge.stl")
    )
    os.mkfifo(pipe)
    inner.mkdir()
    loop.symlink_to(loop)
    with huge.open("wb") as stream:
        stream.truncate(10**12)  # sparse: it takes no room
    return [
        (pipe, UnreadableFile),
        (inner, UnreadableFile),
        (loop, UnreadableFile),
        (folder / "missing.stl", UnreadableFile),
        (folder / "nul\0.stl", UnreadableFile),
        (Path("/dev/zero"), UnreadableFile),
        (huge, TooLarge),
    ]
