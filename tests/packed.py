"""GLB and 3MF files made by code, sound or with something changed in them."""

from __future__ import annotations

import io
import json
import struct
import zipfile
from collections.abc import Callable
from typing import Any

import numpy as np

from tests import shapes

VERTICES, FACES = shapes.ellipsoid((125.0, 50.0, 35.0), subdivisions=2)
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL = "3D/3dmodel.model"

Tree = dict[str, Any]


def tree(vertices=VERTICES, faces=FACES) -> Tree:
    """The description of a GLB whose body is the corners as shorts, then the points in metres."""
    points, corners = 12 * len(vertices), 2 * faces.size
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5123, "type": "SCALAR", "count": faces.size},
            {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": len(vertices)},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": corners},
            {"buffer": 0, "byteOffset": corners, "byteLength": points},
        ],
        "buffers": [{"byteLength": corners + points}],
    }


def body(vertices=VERTICES, faces=FACES, scale: float = 0.001) -> bytes:
    return faces.astype("<u2").tobytes() + (vertices * scale).astype("<f4").tobytes()


def glb(change: Callable[[Tree], object] | None = None, content: bytes | None = None) -> bytes:
    """A GLB in metres; ``change`` alters its description."""
    description = tree()
    if change is not None:
        change(description)
    return glb_of(json.dumps(description).encode(), body() if content is None else content)


def glb_of(text: bytes, content: bytes) -> bytes:
    text += b" " * (-len(text) % 4)
    length = 28 + len(text) + len(content)
    head = struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(content), b"BIN\0") + content


def glb_with(table: str, row: int, **values: Any) -> bytes:
    """A GLB with keys of one row changed."""
    return glb(lambda description: description[table][row].update(values))


def model(
    vertices=VERTICES,
    faces=FACES,
    unit: str = 'unit="millimeter"',
    build: str = '<item objectid="1"/>',
    more: str = "",
) -> str:
    """The XML of a 3MF's model."""
    points = "".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in vertices.tolist())
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces.tolist())
    mesh = f"<mesh><vertices>{points}</vertices><triangles>{triangles}</triangles></mesh>"
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<model {unit} xmlns="{CORE}">'
        f'<resources><object id="1" type="model">{mesh}</object>{more}</resources>'
        f"<build>{build}</build></model>"
    )


def threemf(xml: str | bytes | None = None, name: str = MODEL, **parts: bytes) -> bytes:
    """A 3MF with this model, and other parts beside it."""
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w", zipfile.ZIP_DEFLATED) as zipped:
        zipped.writestr("[Content_Types].xml", "<Types/>")
        for other, content in parts.items():
            zipped.writestr(other, content)
        zipped.writestr(name, model() if xml is None else xml)
    return memory.getvalue()


def packed_with(method: int) -> bytes:
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w", method) as zipped:
        zipped.writestr(MODEL, model())
    return memory.getvalue()


def many_parts(count: int) -> bytes:
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w") as zipped:
        for number in range(count):
            zipped.writestr(f"{number}.model", "")
    return memory.getvalue()


def lying_size(size: int) -> bytes:
    """A model part whose directory entry claims another size than it expands to."""
    data = bytearray(threemf())
    entry = data.rfind(b"PK\1\2")
    data[entry + 24 : entry + 28] = struct.pack("<I", size)
    return bytes(data)


def entity_bomb() -> str:
    steps = "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefghi", "bcdefghij", strict=True)
    )
    return f'<!DOCTYPE model [<!ENTITY a "aaaaaaaaaa">{steps}]>' + model(build="&j;")


def outside_entity(target: str) -> str:
    return f'<!DOCTYPE model [<!ENTITY a SYSTEM "{target}">]>' + model(build="&a;")


def strip_glb() -> bytes:
    """Three squares in a row as a triangle strip, 200 mm a side, lying in the node's plane."""
    points = np.array([[k // 2, 1 - k % 2, 0] for k in range(8)], dtype=float)
    description = tree(points, np.zeros((1, 8), dtype=int))
    description["meshes"][0]["primitives"][0] |= {"mode": 5}
    content = body(points, np.arange(8).reshape(1, 8), 0.2)
    return glb_of(json.dumps(description).encode(), content)
