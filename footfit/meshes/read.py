"""From the bytes of a file to a welded mesh, or to one line that says why not."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from footfit.errors import DamagedMesh
from footfit.meshes.clean.triangles import WeldedMesh, welded_mesh
from footfit.meshes.formats.raw import RawMesh, checked_mesh
from footfit.meshes.known_formats import raw_mesh
from footfit.meshes.read_limits import LIMITS, Limits
from footfit.meshes.resolution import coordinate_step
from footfit.results.values import Notice


@dataclass(frozen=True, slots=True)
class FileMesh:
    """What a mesh file holds, welded, in the file's numbers.

    ``format`` and ``sha256`` are as in ``MeshInfo``; ``unit`` is the one that the file declares,
    None where it declares none; ``notices`` are the reader's. ``step`` is the step in which the
    file keeps its coordinates, 0 if there is none.
    """

    format: str
    sha256: str
    unit: str | None
    mesh: WeldedMesh
    notices: tuple[Notice, ...]
    step: float = 0.0


def file_mesh(
    data: bytes,
    path: str | None = None,
    format: str | None = None,  # noqa: A002  the option's name
    limits: Limits = LIMITS,
) -> FileMesh:
    """The mesh in the content of a file.

    Parameters
    ----------
    data : bytes
        STL, OBJ, PLY, OFF, GLB or 3MF by its content; no other file is ever opened.
    path : str, optional
        Its extension breaks ties; None for standard input.
    format : str, optional
        "stl", "obj", "ply", "off", "glb" or "3mf"; refused where the content is another.
    limits : Limits

    Raises
    ------
    InputError
        UnknownFormat, DamagedMesh, EmptyMesh or TooLarge.
    BadOption
        No format is called ``format``.
    """
    name, raw = raw_mesh(data, path, format, limits)
    sha256 = hashlib.sha256(data).hexdigest()
    mesh = welded_mesh(raw.vertices, raw.faces)
    step = coordinate_step(raw.vertices)
    return FileMesh(name, sha256, raw.unit, mesh, raw.warnings, step)


def array_mesh(vertices: ArrayLike, faces: ArrayLike, limits: Limits = LIMITS) -> FileMesh:
    """The mesh in two arrays, as if a file without a unit had held them.

    Parameters
    ----------
    vertices : (n, 3) numbers
    faces : (m, 3) integers
        Rows of ``vertices``.
    limits : Limits

    Raises
    ------
    InputError
        DamagedMesh, EmptyMesh or TooLarge.
    """
    try:
        points, rows = np.asarray(vertices, dtype=np.float64), np.asarray(faces)
    except (TypeError, ValueError) as error:
        raise DamagedMesh(f"these are no arrays of numbers: {error}") from error
    if points.ndim != 2 or points.shape[1] != 3:
        raise DamagedMesh(f"vertices must be (n, 3) numbers; these are {points.shape}")
    if rows.ndim != 2 or rows.shape[1] != 3 or not np.issubdtype(rows.dtype, np.integer):
        raise DamagedMesh(f"faces must be (m, 3) integers; these are {rows.shape} {rows.dtype}")
    raw = checked_mesh(RawMesh(points, rows.astype(np.int64)), limits)
    sha256 = hashlib.sha256(raw.vertices.tobytes() + raw.faces.tobytes()).hexdigest()
    mesh = welded_mesh(raw.vertices, raw.faces)
    return FileMesh("arrays", sha256, None, mesh, (), coordinate_step(raw.vertices))
