"""A mesh as the bytes of a file; the same mesh gives the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from footfit.errors import BadOption
from footfit.geometry.mesh.surface import face_normals
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.formats.stl import FACET, HEADER_BYTES

VertexData = Mapping[str, NDArray[np.generic]]
COLOUR = "colour"
_STL_HEADER = b"footfit"
_COLOUR_CHANNELS = ("red", "green", "blue")


def encoded_mesh(
    vertices: Floats,
    faces: Ints,
    format: str,  # noqa: A002  the option's name
    vertex_data: VertexData | None = None,
) -> bytes:
    """The mesh in a file format.

    Parameters
    ----------
    vertices : (n, 3) float64
        STL keeps 24 bits of each coordinate (0.00002 mm of a foot), OBJ and OFF keep nine digits,
        PLY keeps every bit.
    faces : (m, 3) int64
    format : str
        "stl" (binary), "ply" (binary little-endian), "obj" or "off"; it may begin with a dot.
    vertex_data : mapping of str to (n,) or (n, 3) arrays, optional
        Only for PLY. Each (n,) array becomes a float property of its name, in the mapping's order.
        ``"colour"`` (n, 3) uint8 becomes red, green and blue.

    Returns
    -------
    bytes

    Raises
    ------
    BadOption
        The format is not written, or it has no place for vertex data.
    """
    extension = format.lower().removeprefix(".")
    if extension not in WRITERS:
        raise BadOption(f"footfit writes no {format!a} files: use {', '.join(WRITERS)}")
    if vertex_data and extension != "ply":
        raise BadOption(f"{extension.upper()} files have no place for values per vertex: use .ply")
    return WRITERS[extension](vertices, faces, vertex_data or {})


def _stl(vertices: Floats, faces: Ints, _: VertexData) -> bytes:
    facets = np.zeros(len(faces), dtype=FACET)
    facets["normal"] = face_normals(vertices, faces)
    facets["corners"] = vertices[faces].reshape(-1, 9)
    header = _STL_HEADER.ljust(HEADER_BYTES - 4, b"\0") + len(faces).to_bytes(4, "little")
    return header + facets.tobytes()


def _ply(vertices: Floats, faces: Ints, vertex_data: VertexData) -> bytes:
    fields: dict[str, NDArray[np.generic]] = {
        axis: vertices[:, place].astype("<f8") for place, axis in enumerate("xyz")
    }
    for name, values in vertex_data.items():
        if name == COLOUR:
            channels = zip(_COLOUR_CHANNELS, values.T, strict=True)
            fields |= {channel: value.astype("u1") for channel, value in channels}
        else:
            fields[name] = values.astype("<f4")
    types = {"<f8": "double", "<f4": "float", "|u1": "uchar"}
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property {types[column.dtype.str]} {name}" for name, column in fields.items()]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    table = np.empty(len(vertices), dtype=[(name, fields[name].dtype) for name in fields])
    for name, column in fields.items():
        table[name] = column
    triangles = np.empty(len(faces), dtype=[("corners", "u1"), ("vertices", "<i4", (3,))])
    triangles["corners"] = 3
    triangles["vertices"] = faces
    return "\n".join(header).encode() + b"\n" + table.tobytes() + triangles.tobytes()


def _obj(vertices: Floats, faces: Ints, _: VertexData) -> bytes:
    return (_rows("v %.9g %.9g %.9g\n", vertices) + _rows("f %d %d %d\n", faces + 1)).encode()


def _off(vertices: Floats, faces: Ints, _: VertexData) -> bytes:
    counts = f"OFF\n{len(vertices)} {len(faces)} 0\n"
    return (counts + _rows("%.9g %.9g %.9g\n", vertices) + _rows("3 %d %d %d\n", faces)).encode()


def _rows(pattern: str, values: NDArray[np.generic]) -> str:
    """One line for each row; adding 0 turns -0.0 into 0."""
    return (pattern * len(values)) % tuple((values + 0).ravel().tolist())


WRITERS: dict[str, Callable[[Floats, Ints, VertexData], bytes]] = {
    "stl": _stl,
    "ply": _ply,
    "obj": _obj,
    "off": _off,
}
