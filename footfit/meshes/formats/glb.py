"""GLB (binary glTF 2.0): the triangles of its one object, in metres as the format says.

trimesh reads it, but only a copy that `_bare` makes: the one mesh, its nodes and the numbers that
they name, every count and offset of which has been held against the bytes that are there. Images,
materials, animations, extensions and addresses of other files never reach it.
"""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Mapping
from typing import Any, NoReturn

import numpy as np

from footfit.errors import DamagedMesh, EmptyMesh, TooLarge, UnknownFormat
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.formats.raw import RawMesh, check_counts
from footfit.meshes.read_limits import Limits
from footfit.results import Notice

Tree = dict[str, Any]
_MAGIC, _VERSION = b"glTF", 2
_JSON, _BIN = b"JSON", b"BIN\0"
_HEAD, _CHUNK = struct.Struct("<4sII"), struct.Struct("<I4s")
_TRIANGLES, _STRIP = 4, 5
_FLOAT = 5126
_INDEX_BYTES = {5121: 1, 5123: 2, 5125: 4}  # unsigned byte, short, int
_MOST_STRIDE = 252
_PLACING = {"matrix": 16, "translation": 3, "rotation": 4, "scale": 3}
_ONLY_LOOKS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp")


def is_glb(data: bytes) -> bool:
    """Whether the content begins as a GLB does."""
    return data.startswith(_MAGIC)


def read_glb(data: bytes, limits: Limits) -> RawMesh:
    """The vertices and faces of a GLB's one object, placed as its nodes say.

    Raises
    ------
    UnknownFormat
        Several objects, other files, or a feature (compression, skinning) that is not read.
    DamagedMesh
        Chunks, counts or offsets that the bytes do not bear out.
    EmptyMesh, TooLarge
        No object, or more than ``limits`` allow.
    """
    header, body, trailing = _chunks(data, limits)
    bare = _bare(header, len(body), limits)
    vertices, faces = _loaded(bare, body)
    said = f"{trailing:,} bytes after the GLB were ignored"
    notices = (Notice("trailing_bytes", said),) if trailing else ()
    return RawMesh(vertices, faces, notices, "m")


def _chunks(data: bytes, limits: Limits) -> tuple[Tree, bytes, int]:
    """The JSON, the binary chunk, and how many bytes follow the declared end."""
    if len(data) < _HEAD.size + _CHUNK.size:
        raise DamagedMesh("the GLB ends within its header: it is cut off, copy it again")
    _, version, length = _HEAD.unpack_from(data)
    if version != _VERSION:
        raise UnknownFormat(f"the GLB is of version {version}, footfit reads 2: export it again")
    if length > len(data):
        raise DamagedMesh(
            f"the GLB promises {length:,} bytes and has {len(data):,}: it is cut off, copy it again"
        )
    text, at = _chunk(data, _HEAD.size, length, _JSON)
    if len(text) > limits.document_bytes:
        raise TooLarge(f"the GLB describes its parts in {len(text):,} bytes: export the foot alone")
    body = _chunk(data, at, length, _BIN)[0] if at + _CHUNK.size <= length else b""
    header = json.loads(text.decode("utf-8"), parse_constant=_no_number)
    if not isinstance(header, dict):
        raise DamagedMesh("the GLB's description is none: export it again")
    return header, body, len(data) - length


def _chunk(data: bytes, at: int, end: int, kind: bytes) -> tuple[bytes, int]:
    size, found = _CHUNK.unpack_from(data, at)
    begin = at + _CHUNK.size
    if found != kind or begin + size > end:
        raise DamagedMesh("the GLB's chunks do not add up: it is damaged, export it again")
    return data[begin : begin + size], begin + size


def _no_number(_word: str) -> NoReturn:
    raise DamagedMesh("the GLB's description has a number that is none: export it again")


def _bare(header: Tree, body_bytes: int, limits: Limits) -> Tree:
    """The same document with nothing but the one object, all of it checked."""
    _no_extensions(dict.fromkeys(header.get("extensionsRequired", [])))
    placed = _placed(header, limits)
    if not placed:
        raise EmptyMesh("the GLB holds no mesh: export a triangle mesh")
    if len(placed) > 1:
        raise UnknownFormat(f"the GLB holds {len(placed)} objects: export the foot alone")
    chain = placed[0]
    mesh = _row(header, "meshes", chain[-1]["mesh"])
    nodes: list[Tree] = [_placing(node) for node in chain]
    for place, node in enumerate(nodes[:-1]):
        node["children"] = [place + 1]
    nodes[-1]["mesh"] = 0
    bare: Tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}]}
    bare |= {"nodes": nodes, "meshes": [{"name": "foot", "primitives": []}]}
    bare |= {"accessors": [], "bufferViews": [], "buffers": [{"byteLength": body_bytes}]}
    if len(mesh["primitives"]) > limits.parts:
        raise TooLarge(f"the GLB's mesh has over {limits.parts:,} parts: export it as one")
    for primitive in mesh["primitives"]:
        bare["meshes"][0]["primitives"].append(_primitive(header, primitive, bare, limits))
    counted = [_row(bare, "accessors", p["attributes"]["POSITION"])["count"] for p in _parts(bare)]
    corners = [
        _row(bare, "accessors", p["indices"])["count"] for p in _parts(bare) if "indices" in p
    ]
    check_counts(sum(counted), sum(corners) // 3, limits)
    return bare


def _parts(bare: Tree) -> list[Tree]:
    primitives: list[Tree] = bare["meshes"][0]["primitives"]
    return primitives


def _placed(header: Tree, limits: Limits) -> list[list[Tree]]:
    """For each mesh in the scene the nodes that lead to it, from the root."""
    waiting: list[tuple[Any, list[Tree]]] = [(node, []) for node in _roots(header)]
    placed: list[list[Tree]] = []
    seen: set[int] = set()
    while waiting:
        number, above = waiting.pop()
        if number in seen or len(seen) > limits.parts:
            raise DamagedMesh("the GLB's nodes form a loop, or there are too many: export it again")
        seen.add(number)
        node = _row(header, "nodes", number)
        chain = [*above, node]
        if "mesh" in node:
            placed.append(chain)
        waiting += [(child, chain) for child in node.get("children", [])]
    return placed


def _roots(header: Tree) -> list[int]:
    if "scenes" in header:
        roots: list[int] = _row(header, "scenes", header.get("scene", 0)).get("nodes", [])
        return roots
    nodes = header.get("nodes", [])
    children = {child for node in nodes for child in node.get("children", [])}
    return [number for number in range(len(nodes)) if number not in children]


def _placing(node: Tree) -> Tree:
    """Where a node puts its mesh."""
    _no_extensions(node.get("extensions", {}))
    if "skin" in node or "weights" in node:
        raise UnknownFormat("the GLB is a posed character (skin, weights): export the bare shape")
    kept = {}
    for key, size in _PLACING.items():
        if key in node:
            kept[key] = [float(value) for value in node[key]]
            if len(kept[key]) != size or not np.isfinite(kept[key]).all():
                raise DamagedMesh(f"a node of the GLB has no valid {key}: export it again")
    return kept


def _primitive(header: Tree, primitive: Tree, bare: Tree, limits: Limits) -> Tree:
    """One part of the mesh, its accessors copied into ``bare``."""
    _no_extensions(primitive.get("extensions", {}))
    mode = primitive.get("mode", _TRIANGLES)
    if mode not in (_TRIANGLES, _STRIP) or primitive.get("targets"):
        raise UnknownFormat("the GLB has points, lines, fans or morphs: export triangles")
    position = _accessor(header, primitive["attributes"]["POSITION"], bare, {_FLOAT: 12}, limits)
    kept = {"mode": mode, "attributes": {"POSITION": position}}
    if "indices" in primitive:
        kept["indices"] = _accessor(header, primitive["indices"], bare, _INDEX_BYTES, limits)
    count = bare["accessors"][kept.get("indices", position)]["count"]
    if mode == _TRIANGLES and count % 3:
        raise DamagedMesh("the GLB's corners are not three a triangle: export it again")
    return kept


def _accessor(
    header: Tree, number: int, bare: Tree, row_bytes: Mapping[int, int], limits: Limits
) -> int:
    """Copy one accessor and its view, and return its new number."""
    found = _row(header, "accessors", number)
    width = row_bytes.get(found["componentType"])
    kind = "VEC3" if _FLOAT in row_bytes else "SCALAR"
    if width is None or found["type"] != kind or "sparse" in found or "bufferView" not in found:
        raise UnknownFormat("the GLB stores its numbers in a way that is not read: export as STL")
    view = _row(header, "bufferViews", found["bufferView"])
    _no_extensions(view.get("extensions", {}))
    if "uri" in _row(header, "buffers", view["buffer"]) or view["buffer"] != 0:
        raise UnknownFormat("the GLB keeps its mesh in another file, and footfit opens none")
    count, start = _whole(found["count"]), _whole(found.get("byteOffset", 0))
    offset, size = _whole(view.get("byteOffset", 0)), _whole(view["byteLength"])
    stride = _whole(view.get("byteStride", width))
    check_counts(count if kind == "VEC3" else 0, count // 3 if kind == "SCALAR" else 0, limits)
    used = start + (count - 1) * stride + width
    held = bare["buffers"][0]["byteLength"]
    if not (count and width <= stride <= _MOST_STRIDE and used <= size and offset + size <= held):
        raise DamagedMesh("the GLB promises more numbers than it holds: it is damaged or cut off")
    bare["bufferViews"].append(
        {"buffer": 0, "byteOffset": offset + start, "byteLength": used - start}
    )
    if stride != width:
        bare["bufferViews"][-1]["byteStride"] = stride
    kept = {"bufferView": len(bare["bufferViews"]) - 1, "count": count, "type": kind}
    bare["accessors"].append(kept | {"componentType": found["componentType"]})
    return len(bare["accessors"]) - 1


def _row(header: Tree, table: str, number: Any) -> Tree:
    rows = header.get(table, [])
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(rows):
        raise DamagedMesh(f"the GLB names one of its {table} that is not there: export it again")
    row = rows[number]
    if not isinstance(row, dict):
        raise DamagedMesh(f"one of the GLB's {table} is none: export it again")
    return row


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise DamagedMesh("the GLB has a count or offset that is none: export it again")
    return value


def _no_extensions(named: Mapping[str, Any]) -> None:
    """Refuse extensions that may change the shape; those of its looks are passed over."""
    for name in named:
        if not name.startswith(_ONLY_LOOKS):
            raise UnknownFormat(
                f"the GLB needs {name[:40]!a}, which is not read: export it without compression"
            )


def _loaded(bare: Tree, body: bytes) -> tuple[Floats, Ints]:
    """Vertices (n, 3) and faces (m, 3) by trimesh, from a document that refers to nothing else."""
    import trimesh

    text = json.dumps(bare).encode()
    text += b" " * (-len(text) % 4)
    length = _HEAD.size + 2 * _CHUNK.size + len(text) + len(body)
    head = _HEAD.pack(_MAGIC, _VERSION, length) + _CHUNK.pack(len(text), _JSON) + text
    stream = io.BytesIO(head + _CHUNK.pack(len(body), _BIN) + body)
    with np.errstate(all="ignore"):  # what is not finite is refused by `sound`
        scene = trimesh.load(stream, file_type="glb", process=False, skip_materials=True)
        parts = [_part(scene, name) for name in scene.graph.nodes_geometry]
    first = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    faces = [faces + known for (_, faces), known in zip(parts, first, strict=False)]
    return np.concatenate([vertices for vertices, _ in parts]), np.concatenate(faces)


def _part(scene: Any, node: str) -> tuple[Floats, Ints]:
    """One part of the mesh where its node puts it, its indices held against its own vertices."""
    placing, geometry = scene.graph[node]
    vertices = np.asarray(scene.geometry[geometry].vertices, dtype=np.float64)
    faces = np.asarray(scene.geometry[geometry].faces, dtype=np.int64)
    if faces.size and not 0 <= faces.min() <= faces.max() < len(vertices):
        raise DamagedMesh("a face of the GLB names a vertex that is not there: export it again")
    return vertices @ placing[:3, :3].T + placing[:3, 3], faces
