"""GLB (binary glTF 2.0): the triangles of its scene, in metres as the format says.

Every count, offset and stride is compared with the bytes that are there before an array is made.
Images, materials, animations and addresses of other files are never looked at.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable
from dataclasses import replace
from itertools import islice
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh, EmptyMesh, TooLarge, UnknownFormat
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import rotation_matrices, transform
from footfit.meshes.formats.placed_parts import Part, joined_parts, placed_nodes
from footfit.meshes.formats.raw import RawMesh, check_counts, doubles
from footfit.meshes.read_limits import Limits
from footfit.results.values import count_notice

Tree = dict[str, Any]
Types = dict[int, str]
_MAGIC, _VERSION = b"glTF", 2
_JSON, _BIN = b"JSON", b"BIN\0"
_HEAD, _CHUNK = struct.Struct("<4sII"), struct.Struct("<I4s")
_NO_SURFACE = (0, 1, 2, 3)  # points and lines
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_POINTS = ("VEC3", 3, {5126: "<f4"})
_INDICES = ("SCALAR", 1, {5121: "<u1", 5123: "<u2", 5125: "<u4"})
_MOST_STRIDE = 252
_ONLY_LOOKS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp")


def is_glb(data: bytes) -> bool:
    """Whether the content begins as a GLB does."""
    return data.startswith(_MAGIC)


def read_glb(data: bytes, limits: Limits) -> RawMesh:
    """The vertices and faces of all meshes in a GLB's scene, placed as its nodes say.

    Raises
    ------
    UnknownFormat
        The mesh is in another file, or needs a feature (compression, skinning) that is not read.
    DamagedMesh
        The bytes do not agree with the chunks, counts or offsets that are declared.
    EmptyMesh, TooLarge
        There is no mesh, or more than ``limits`` allow.
    """
    header, body, trailing = _chunks(data, limits)
    _check_extensions(header.get("extensionsRequired", []))
    meshes = _placed_meshes(header, limits)
    if not meshes:
        raise EmptyMesh("the GLB's scene holds no mesh: export a triangle mesh")
    rows = ((row, placing) for mesh, placing in meshes for row in mesh["primitives"])
    listed = list(islice(rows, limits.parts + 1))
    if len(listed) > limits.parts:
        raise TooLarge(f"the GLB's meshes have over {limits.parts:,} parts: export it as one")
    listed = [(row, placing) for row, placing in listed if row.get("mode") not in _NO_SURFACE]
    if not listed:
        raise UnknownFormat("the GLB has points or lines only: export triangles")
    corners = [_corners(header, row, body, limits) for row, _ in listed]
    check_counts(
        sum(len(points) for points, _ in corners),
        sum(len(rows) for _, rows in corners) // 3,
        limits,
    )
    parts = [
        Part(doubles(points), _faces(rows, row.get("mode", _TRIANGLES)), placing)
        for (points, rows), (row, placing) in zip(corners, listed, strict=True)
    ]
    raw = joined_parts(parts, len(meshes), "m")
    notices = count_notice(
        "trailing_bytes",
        trailing,
        "bytes after the GLB were ignored",
        "byte after the GLB was ignored",
    )
    return replace(raw, warnings=notices + raw.warnings)


# ---------------------------------------------------------------- chunks


def _chunks(data: bytes, limits: Limits) -> tuple[Tree, bytes, int]:
    """The JSON, the binary chunk, and how many bytes follow the declared end."""
    if len(data) < _HEAD.size + _CHUNK.size:
        raise DamagedMesh("the GLB ends within its header: it is cut off, copy it again")
    _, version, length = _HEAD.unpack_from(data)
    if version != _VERSION:
        raise UnknownFormat(
            f"the GLB is of version {version}, footfit reads version {_VERSION}: export it again"
        )
    if length > len(data):
        raise DamagedMesh(
            f"the GLB declares {length:,} bytes and has {len(data):,}: it is cut off, copy it again"
        )
    text, at = _chunk(data, _HEAD.size, _JSON)
    if len(text) > limits.document_bytes:
        raise TooLarge(f"the GLB's JSON takes {len(text):,} bytes: export the foot alone")
    body, at = _chunk(data, at, _BIN) if at + _CHUNK.size <= length else (b"", at)
    return _header(text), body, len(data) - max(at, length)


def _chunk(data: bytes, at: int, kind: bytes) -> tuple[bytes, int]:
    """One chunk's content, and where the next chunk begins.

    A chunk begins at a multiple of 4 bytes. Some programs do not count the bytes that fill up the
    chunk before it, and some do not write them.
    """
    if data[at + 4 : at + _CHUNK.size] != kind:
        at += -at % 4
    begin = at + _CHUNK.size
    size, actual = _CHUNK.unpack(data[at:begin].ljust(_CHUNK.size))
    if actual != kind or begin + size > len(data):
        raise DamagedMesh("the GLB's chunks do not add up: it is damaged, export it again")
    return data[begin : begin + size], begin + size


def _header(text: bytes) -> Tree:
    """The JSON; a chunk is filled up with spaces, and some programs use NUL for it."""
    try:
        header = json.loads(text.rstrip(b"\0 ").decode("utf-8-sig"), parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise DamagedMesh("the GLB's JSON is not valid: export it again") from error
    if not isinstance(header, dict):
        raise DamagedMesh("the GLB's JSON is not an object: export it again")
    return header


def _no_number(word: str) -> NoReturn:
    raise ValueError(f"{word} is not a number in JSON")


# ---------------------------------------------------------------- scene


def _placed_meshes(header: Tree, limits: Limits) -> list[tuple[Tree, Floats]]:
    """Each mesh that the scene shows, with the (4, 4) transform to the scene's frame."""

    def node(number: int) -> tuple[Floats, list[int]]:
        row = _row(header, "nodes", number)
        children: list[int] = row.get("children", [])
        if "mesh" in row or children:
            _check_extensions(row.get("extensions", {}))
        return _transform(row), children

    placed = []
    for number, placing in placed_nodes(_roots(header), node, limits):
        row = _row(header, "nodes", number)
        if "mesh" in row:
            if "skin" in row or "weights" in row:
                raise UnknownFormat(
                    "the GLB is a posed character (skin, weights): export the shape alone"
                )
            placed.append((_row(header, "meshes", row["mesh"]), placing))
    return placed


def _roots(header: Tree) -> list[int]:
    """The nodes at the top of the scene; without a scene, those that are no node's child."""
    if "scenes" in header:
        roots: list[int] = _row(header, "scenes", header.get("scene", 0)).get("nodes", [])
        return roots
    nodes = header.get("nodes", [])
    children = {child for node in nodes for child in node.get("children", [])}
    return [number for number in range(len(nodes)) if number not in children]


def _transform(node: Tree) -> Floats:
    """Where a node puts its mesh and its children, (4, 4)."""
    if "matrix" in node:
        return _numbers(node, "matrix", np.eye(4).ravel()).reshape(4, 4).T  # column by column
    scale = _numbers(node, "scale", np.ones(3))
    turn = _numbers(node, "rotation", np.array([0.0, 0.0, 0.0, 1.0]))
    with np.errstate(all="ignore"):  # `checked_mesh` refuses what is not finite
        length = np.linalg.norm(turn) or 1.0
        turned = rotation_matrices(turn[None] / length)[0] * scale
    return transform(turned, _numbers(node, "translation", np.zeros(3)))


def _numbers(node: Tree, key: str, usual: Floats) -> Floats:
    """A node's finite numbers, as many as there usually are."""
    if key not in node:
        return usual
    values = np.array([float(value) for value in node[key]])
    if values.shape != usual.shape or not np.isfinite(values).all():
        raise DamagedMesh(f"a node of the GLB has no valid {key}: export it again")
    return values


# ---------------------------------------------------------------- triangles


def _corners(
    header: Tree, primitive: Tree, body: bytes, limits: Limits
) -> tuple[NDArray[Any], NDArray[Any] | range]:
    """The points (n, 3) of one part of a mesh, and the corners (k,) of its triangles, in order.

    Both are views of the binary chunk, so no memory is taken before the counts are checked.
    """
    _check_extensions(primitive.get("extensions", {}))
    mode = primitive.get("mode", _TRIANGLES)
    if mode not in (_TRIANGLES, _STRIP, _FAN) or primitive.get("targets"):
        raise UnknownFormat("the GLB has morphs or an unknown primitive: export triangles")
    points = _rows(header, primitive["attributes"]["POSITION"], body, _POINTS, limits)
    corners: NDArray[Any] | range = range(len(points))
    if "indices" in primitive:
        corners = _rows(header, primitive["indices"], body, _INDICES, limits)[:, 0]
    if mode == _TRIANGLES and len(corners) % 3:
        raise DamagedMesh("the GLB's number of corners is not a multiple of 3: export it again")
    return points, corners


def _faces(corners: NDArray[Any] | range, mode: int) -> Ints:
    """The triangles (m, 3) that corners in order make."""
    if isinstance(corners, range):
        corners = np.arange(len(corners))
    corners = corners.astype(np.int64)
    if mode == _TRIANGLES:
        return corners.reshape(-1, 3)
    step = np.arange(len(corners) - 2)
    if mode == _FAN:
        return corners[np.stack([0 * step, step + 1, step + 2], axis=1)]
    odd = step % 2  # every other triangle of a strip is wound the other way
    return corners[np.stack([step, step + 1 + odd, step + 2 - odd], axis=1)]


def _rows(
    header: Tree, number: int, body: bytes, kind: tuple[str, int, Types], limits: Limits
) -> NDArray[Any]:
    """An accessor's numbers (count, width) in the binary chunk, after a check against its bytes."""
    name, width, types = kind
    accessor = _row(header, "accessors", number)
    number_type = types.get(accessor["componentType"])
    readable = accessor["type"] == name and "sparse" not in accessor and "bufferView" in accessor
    if number_type is None or not readable:
        raise UnknownFormat(
            "footfit cannot read how the GLB stores its numbers: export the foot as STL"
        )
    view = _row(header, "bufferViews", accessor["bufferView"])
    _check_extensions(view.get("extensions", {}))
    if "uri" in _row(header, "buffers", view["buffer"]) or view["buffer"] != 0:
        raise UnknownFormat("the GLB keeps its mesh in another file: export everything in one file")
    row_bytes = width * np.dtype(number_type).itemsize
    count, start = _whole(accessor["count"]), _whole(accessor.get("byteOffset", 0))
    offset, size = _whole(view.get("byteOffset", 0)), _whole(view["byteLength"])
    stride = _whole(view.get("byteStride", row_bytes))
    check_counts(count if kind == _POINTS else 0, count // 3 if kind == _INDICES else 0, limits)
    inside = start + (count - 1) * stride + row_bytes <= size and offset + size <= len(body)
    if not (count and row_bytes <= stride <= _MOST_STRIDE and inside):
        raise DamagedMesh(
            "the GLB declares more numbers than it holds: it is cut off, copy or export it again"
        )
    strides = (stride, row_bytes // width)
    return np.ndarray((count, width), number_type, body, offset + start, strides)


def _row(header: Tree, table: str, number: Any) -> Tree:
    """One row of one of the JSON's tables."""
    rows = header.get(table, [])
    if type(number) is not int or not 0 <= number < len(rows):
        raise DamagedMesh(f"the GLB names one of its {table} that is not there: export it again")
    row = rows[number]
    if not isinstance(row, dict):
        raise DamagedMesh(f"one of the GLB's {table} is not an object: export it again")
    return row


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise DamagedMesh("a count or offset of the GLB is not a whole number: export it again")
    return value


def _check_extensions(names: Iterable[str]) -> None:
    """Refuse extensions that may change the shape; those for its looks are ignored."""
    for name in names:
        if not name.startswith(_ONLY_LOOKS):
            raise UnknownFormat(
                f"the GLB needs the extension {name[:40]!a}, which footfit does not read:"
                " export it without compression"
            )
