"""``.3dm`` files made by code with rhino3dm: meshes, patches, blocks, hidden objects, any unit."""

from __future__ import annotations

import base64
import io
import os
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import rhino3dm

from tests import shapes

KEPT: list[Any] = []
"""rhino3dm frees a mesh that was given to a face twice, unless both are kept to the end."""
Patches = Sequence[tuple[np.ndarray, np.ndarray]]
VERTICES, FACES = shapes.ellipsoid((125.0, 50.0, 35.0), subdivisions=2)


def mesh(vertices=VERTICES, faces=FACES) -> Any:
    """A mesh object; faces (m, 3) or (m, 4)."""
    made = rhino3dm.Mesh()
    made.Vertices.UseDoublePrecisionVertices = True
    for corner in vertices.tolist():
        made.Vertices.AddPoint3d(*corner)
    for face in faces.tolist():
        made.Faces.AddFace(*face)
    return made


def brep(patches: Patches) -> Any:
    """A Brep of up to six faces whose render meshes are the patches; the others have none."""
    box = rhino3dm.Box(rhino3dm.BoundingBox(0, 0, 0, 1, 1, 1))
    made = rhino3dm.Brep.CreateFromBox(box)
    for index, patch in enumerate(patches):
        KEPT.append(mesh(*patch))
        made.Faces[index].SetMesh(KEPT[-1], rhino3dm.MeshType.Render)
    KEPT.append(made)
    return made


def brep_model(patches: Patches, unit: str = "Millimeters") -> bytes:
    """A ``.3dm`` with a Brep of these patches, made in a process that ends without clearing up."""
    memory = io.BytesIO()
    arrays = {
        f"{kind}{number}": value
        for number, patch in enumerate(patches)
        for kind, value in zip("vf", patch, strict=True)
    }
    np.savez(memory, **arrays)
    command = [sys.executable, "-m", "tests.rhino_models", unit]
    return subprocess.run(command, input=memory.getvalue(), capture_output=True, check=True).stdout


def attributes(layer: int = -1, *, visible: bool = True) -> Any:
    made = rhino3dm.ObjectAttributes()
    made.LayerIndex, made.Visible = layer, visible
    return made


class Model:
    """A ``.3dm`` to which objects are added."""

    def __init__(self, unit: str = "Millimeters") -> None:
        self.file = rhino3dm.File3dm()
        self.file.Settings.ModelUnitSystem = getattr(rhino3dm.UnitSystem, unit)

    def layer(self, *, visible: bool = True, inside: int | None = None) -> int:
        made = rhino3dm.Layer()
        made.Name, made.Visible = f"layer {len(self.file.Layers)}", visible
        if inside is not None:
            made.ParentLayerId = self.file.Layers[inside].Id
        return int(self.file.Layers.Add(made))

    def add(self, geometry: Any, layer: int = -1, *, visible: bool = True) -> Model:
        self.file.Objects.Add(geometry, attributes(layer, visible=visible))
        return self

    def block(self, *geometries: Any) -> Any:
        """The id of a block of these objects."""
        several = tuple(attributes() for _ in geometries)
        point = rhino3dm.Point3d(0, 0, 0)
        name = f"block {len(self.file.InstanceDefinitions)}"
        index = self.file.InstanceDefinitions.Add(name, "", "", "", point, geometries, several)
        return self.file.InstanceDefinitions.FindIndex(index).Id

    def place(self, block: Any, shift=(0.0, 0.0, 0.0), turn_deg: float = 0.0) -> Any:
        """A block at a place: shifted after it was turned about Z."""
        angle = np.radians(turn_deg)
        up, origin = rhino3dm.Vector3d(0, 0, 1), rhino3dm.Point3d(0, 0, 0)
        turn = rhino3dm.Transform.Rotation(float(angle), up, origin)
        move = rhino3dm.Transform.Translation(rhino3dm.Vector3d(*shift))
        return rhino3dm.InstanceReference(block, rhino3dm.Transform.Multiply(move, turn))

    def data(self, version: int = 8) -> bytes:
        options = rhino3dm.File3dmWriteOptions()
        options.Version = version
        return base64.b64decode(self.file.Encode(options))


def model(*geometries: Any, unit: str = "Millimeters") -> bytes:
    """A ``.3dm`` of these objects; without any, of the ellipsoid."""
    made = Model(unit)
    for geometry in geometries or (mesh(),):
        made.add(geometry)
    return made.data()


def triangles_of(data: bytes) -> np.ndarray:
    """The corners (m, 3, 3) of the only mesh of a ``.3dm`` in millimetres."""
    file = rhino3dm.File3dm.FromByteArray(data)
    assert file.Settings.ModelUnitSystem == rhino3dm.UnitSystem.Millimeters
    (thing,) = file.Objects
    points = np.array([(p.X, p.Y, p.Z) for p in thing.Geometry.Vertices.ToPoint3dArray()])
    faces = [thing.Geometry.Faces[index][:3] for index in range(len(thing.Geometry.Faces))]
    return points[np.array(faces)]


def hidden_model() -> bytes:
    """A ``.3dm`` whose only mesh is hidden."""
    return Model().add(mesh(), visible=False).data()


def main() -> None:
    with np.load(io.BytesIO(sys.stdin.buffer.read())) as arrays:
        patches = [(arrays[f"v{k}"], arrays[f"f{k}"]) for k in range(len(arrays.files) // 2)]
    sys.stdout.buffer.write(model(brep(patches), unit=sys.argv[1]))
    sys.stdout.buffer.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
