"""``.3dm`` files made by code with rhino3dm: meshes, patches, blocks, hidden objects, any unit."""

from __future__ import annotations

import base64
import io
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
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


RADIUS_MM, HEIGHT_MM = 40.0, 250.0


def grid(u_count: int, v_count: int, place: Callable[..., Any]) -> tuple[np.ndarray, np.ndarray]:
    """A render mesh of quads as Rhino makes it: a seam has its vertices twice, a pole many times.

    ``place`` takes ``u`` and ``v`` from 0 to 1, both included.
    """
    u, v = np.meshgrid(np.linspace(0, 1, u_count), np.linspace(0, 1, v_count), indexing="ij")
    number = np.arange(u.size).reshape(u.shape)
    corners = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    return np.stack(place(u, v), axis=2).reshape(-1, 3), np.stack(corners, axis=2).reshape(-1, 4)


def around(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The unit circle, once around; it ends where it began, to the bit."""
    turn = 2.0 * np.pi * (u % 1.0)
    return np.cos(turn), np.sin(turn)


def render_meshes(kind: str) -> Patches:
    """The render meshes of a whole solid; the caps of a cylinder are coarser than its side.

    An extrusion has one mesh for all its faces, whose edges Rhino divides alike.
    """
    if kind == "sphere":

        def ball(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
            (x, y), ring = around(u), np.sin(np.pi * v) * (v % 1.0 > 0.0)
            return RADIUS_MM * ring * x, RADIUS_MM * ring * y, -RADIUS_MM * np.cos(np.pi * v)

        return [grid(49, 25, ball)]

    def side(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
        x, y = around(u)
        return RADIUS_MM * x, RADIUS_MM * y, HEIGHT_MM * v

    def cap(up: float) -> tuple[np.ndarray, np.ndarray]:
        def disc(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
            x, y = around(u)
            outward = 1.0 - v if up else v
            return RADIUS_MM * outward * x, RADIUS_MM * outward * y, np.full_like(u, up * HEIGHT_MM)

        return grid(65 if kind == "extrusion" else 41, 4, disc)

    return [grid(65, 9, side), cap(0.0), cap(1.0)]


def solid(kind: str) -> Any:
    """A sphere, a cylinder or an extrusion that rhino3dm itself made, with its render meshes."""
    origin = rhino3dm.Point3d(0, 0, 0)
    circle = rhino3dm.Circle(origin, RADIUS_MM)
    meshes = [mesh(*patch) for patch in render_meshes(kind)]
    KEPT.extend(meshes)
    if kind == "extrusion":
        made = rhino3dm.Extrusion.Create(circle.ToNurbsCurve(), HEIGHT_MM, True)
        for part in meshes[1:]:
            meshes[0].Append(part)
        made.SetMesh(meshes[0], rhino3dm.MeshType.Render)
    elif kind == "cylinder":
        whole = rhino3dm.Cylinder(circle, HEIGHT_MM)
        made = rhino3dm.Brep.CreateFromCylinder(whole, True, True)
    else:
        made = rhino3dm.Brep.CreateFromSphere(rhino3dm.Sphere(origin, RADIUS_MM))
    if kind != "extrusion":
        assert len(made.Faces) == len(meshes)
        for index, part in enumerate(meshes):
            made.Faces[index].SetMesh(part, rhino3dm.MeshType.Render)
    KEPT.append(made)
    return made


def solid_model(kind: str) -> bytes:
    """A ``.3dm`` with a solid, made in a process that ends without clearing up."""
    command = [sys.executable, "-m", "tests.rhino_models", "solid", kind]
    return subprocess.run(command, capture_output=True, check=True).stdout


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
    if sys.argv[1] == "solid":
        data = model(solid(sys.argv[2]))
    else:
        with np.load(io.BytesIO(sys.stdin.buffer.read())) as arrays:
            patches = [(arrays[f"v{k}"], arrays[f"f{k}"]) for k in range(len(arrays.files) // 2)]
        data = model(brep(patches), unit=sys.argv[1])
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
