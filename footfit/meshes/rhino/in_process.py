"""What runs in a process of its own: ``.3dm`` bytes to arrays and back, with rhino3dm.

rhino3dm is native code. On a damaged file it can work for minutes, and it can end its process. So
footfit starts this file as a program and watches it (``watched_process.py``). It imports nothing
of footfit. Standard input and output carry the data.
"""

from __future__ import annotations

import base64
import io
import json
import os
import sys
from collections import Counter
from collections.abc import Iterator
from importlib import import_module
from typing import Any

import numpy as np

Placed = tuple[Any, np.ndarray]  # a geometry of rhino3dm, and the (4, 4) transform to the model


class TooManyParts(Exception):
    """The model has more objects than are read, or its blocks contain each other."""


def read(data: bytes, limits: dict[str, int]) -> bytes:
    """The meshes in a ``.3dm`` as an .npz: ``vertices`` (n, 3), ``faces`` (m, 4) with the fourth
    corner equal to the third in a triangle, the ``counts`` (p, 2) of each part's vertices and
    faces, its ``object`` (p,) and its ``transforms`` (p, 4, 4), and ``facts`` as JSON.
    """
    rhino3dm = _rhino()
    file = rhino3dm.File3dm.FromByteArray(data)
    if file is None:
        return _packed({"error": "damaged"})
    facts: dict[str, Any] = {"unit": str(file.Settings.ModelUnitSystem).rpartition(".")[2]}
    hidden: Counter[str] = Counter()
    other: Counter[str] = Counter()
    vertices, faces, counts, objects, transforms = [], [], [], [], []
    total, unmeshed = np.zeros(2, dtype=np.int64), 0
    for number, (geometry, transform) in enumerate(_placed(file, limits["parts"], hidden)):
        meshes, missing = _meshes(geometry)
        unmeshed += missing
        if not meshes and not missing:
            other[type(geometry).__name__] += 1
        for mesh in meshes:
            sizes = len(mesh.Vertices), len(mesh.Faces)
            total += sizes
            if total[0] > limits["vertices"] or total[1] > limits["faces"]:
                return _packed({"error": "counts", "counts": total.tolist()})
            points = mesh.Vertices.ToPoint3dArray()
            vertices += [(point.X, point.Y, point.Z) for point in points]
            faces += [mesh.Faces[index] for index in range(sizes[1])]
            counts.append(sizes)
            objects.append(number)
            transforms.append(transform)
    facts |= {"hidden": sum(hidden.values()), "unmeshed": unmeshed, "other": dict(other)}
    return _packed(
        facts,
        vertices=np.array(vertices, dtype=np.float64).reshape(-1, 3),
        faces=np.array(faces, dtype=np.int64).reshape(-1, 4),
        counts=np.array(counts, dtype=np.int64).reshape(-1, 2),
        object=np.array(objects, dtype=np.int64),
        transforms=np.array(transforms, dtype=np.float64).reshape(-1, 4, 4),
    )


def _rhino() -> Any:
    """The module, whose stubs say too little of it for mypy."""
    return import_module("rhino3dm")


def _placed(file: Any, most: int, hidden: Counter[str]) -> Iterator[Placed]:
    """Each visible object of the model in its place; blocks are taken apart.

    ``hidden`` counts the objects that are not shown.
    """
    layers = {layer.Index: layer for layer in file.Layers}
    by_id = {layer.Id: layer for layer in file.Layers}
    blocks = {block.Id: block.GetObjectIds() for block in file.InstanceDefinitions}

    def shown(thing: Any) -> bool:
        layer, depth = layers.get(thing.Attributes.LayerIndex), 0
        while layer is not None and depth < len(layers):
            if not layer.Visible:
                return False
            layer, depth = by_id.get(layer.ParentLayerId), depth + 1
        return bool(thing.Attributes.Visible)

    waiting = [(thing, np.eye(4)) for thing in file.Objects]
    waiting = [pair for pair in waiting if not pair[0].Attributes.IsInstanceDefinitionObject][::-1]
    visited = 0
    while waiting:
        visited += 1
        if visited > most:
            raise TooManyParts
        thing, above = waiting.pop()
        geometry = thing.Geometry
        if geometry is None:
            continue
        if not shown(thing):
            hidden[type(geometry).__name__] += 1
        elif type(geometry).__name__ == "InstanceReference":
            own = np.array(geometry.Xform.ToFloatArray(True), dtype=np.float64).reshape(4, 4)
            parts = [file.Objects.FindId(part) for part in blocks.get(geometry.ParentIdefId, ())]
            waiting += [(part, above @ own) for part in reversed(parts) if part is not None]
        else:
            yield geometry, above


def _meshes(geometry: Any) -> tuple[list[Any], int]:
    """The meshes of an object, and how many of its surfaces have none."""
    any_mesh, kind = _rhino().MeshType.Any, type(geometry).__name__
    if kind == "Mesh":
        return [geometry], 0
    if kind == "Brep":
        kept = [geometry.Faces[index].GetMesh(any_mesh) for index in range(len(geometry.Faces))]
    elif kind == "Extrusion":
        kept = [geometry.GetMesh(any_mesh)]
    elif kind in ("SubD", "Surface", "NurbsSurface"):
        kept = [None]
    else:
        return [], 0
    meshes = [mesh for mesh in kept if mesh is not None and len(mesh.Faces)]
    return meshes, len(kept) - len(meshes)


def write(data: bytes) -> bytes:
    """A ``.3dm`` in mm with one mesh object, from an .npz of ``vertices`` and ``faces`` (m, 3)."""
    rhino3dm = _rhino()
    with np.load(io.BytesIO(data), allow_pickle=False) as arrays:
        vertices, faces = arrays["vertices"].tolist(), arrays["faces"].tolist()
    mesh = rhino3dm.Mesh()
    mesh.Vertices.UseDoublePrecisionVertices = True
    for corner in vertices:
        mesh.Vertices.AddPoint3d(*corner)
    for face in faces:
        mesh.Faces.AddFace(*face)
    file = rhino3dm.File3dm()
    file.Settings.ModelUnitSystem = rhino3dm.UnitSystem.Millimeters
    file.Settings.ModelAbsoluteTolerance = 0.01
    file.Objects.AddMesh(mesh)
    return base64.b64decode(file.Encode())


def _packed(facts: dict[str, Any], **arrays: np.ndarray) -> bytes:
    memory = io.BytesIO()
    text = np.frombuffer(json.dumps(facts).encode(), dtype=np.uint8)
    np.savez(memory, facts=text, **arrays)  # type: ignore[arg-type]
    return memory.getvalue()


def _limit_memory(most_bytes: int) -> None:
    try:
        import resource
    except ImportError:  # not POSIX
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    if soft == resource.RLIM_INFINITY or soft > most_bytes:
        resource.setrlimit(resource.RLIMIT_AS, (most_bytes, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def main() -> None:
    """Read the data, do what the first argument says, write the answer, and end at once."""
    limits: dict[str, int] = json.loads(sys.argv[2])
    _limit_memory(limits["memory_bytes"])
    data = sys.stdin.buffer.read()
    try:
        answer = read(data, limits) if sys.argv[1] == "read" else write(data)
    except TooManyParts:
        answer = _packed({"error": "parts"})
    except MemoryError:
        answer = _packed({"error": "memory"})
    sys.stdout.buffer.write(answer)
    sys.stdout.buffer.flush()
    os._exit(0)  # rhino3dm may fail when its objects are taken down


if __name__ == "__main__":
    main()
