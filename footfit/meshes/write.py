"""A mesh as the bytes of a file; the same mesh gives the same bytes, except as ``.3dm``."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import numpy as np
from numpy.typing import NDArray

from footfit.errors import BadOption
from footfit.geometry.mesh.surface import face_normals
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.formats.stl import FACET, HEADER_BYTES
from footfit.meshes.formats.threemf import CORE
from footfit.meshes.rhino.to_3dm import encoded_3dm

VertexData = Mapping[str, NDArray[np.generic]]
COLOUR = "colour"
_STL_HEADER = b"footfit"
_COLOUR_CHANNELS = ("red", "green", "blue")
_PACKAGE = "http://schemas.openxmlformats.org/package/2006/"
_THREEMF_PARTS = (
    (
        "[Content_Types].xml",
        f'<Types xmlns="{_PACKAGE}content-types"><Default Extension="rels"'
        ' ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        '<Default Extension="model"'
        ' ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
    ),
    (
        "_rels/.rels",
        f'<Relationships xmlns="{_PACKAGE}relationships"><Relationship Id="model"'
        ' Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"'
        ' Target="/3D/3dmodel.model"/></Relationships>',
    ),
)
_XML = '<?xml version="1.0" encoding="UTF-8"?>\n'


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
        In mm. STL keeps 24 bits of each coordinate (0.00002 mm of a foot), OBJ, OFF and 3MF keep
        nine digits, PLY and 3DM keep every bit. 3MF and 3DM say that the unit is mm.
    faces : (m, 3) int64
    format : str
        "stl" (binary), "ply" (binary little-endian), "obj", "off", "3mf" or "3dm"; it may begin
        with a dot.
    vertex_data : mapping of str to (n,) or (n, 3) arrays, optional
        Only for PLY. Each (n,) array becomes a float property of its name, in the mapping's order.
        ``"colour"`` (n, 3) uint8 becomes red, green and blue.

    Returns
    -------
    bytes

    Raises
    ------
    BadOption
        The format is not written, it has no place for vertex data, or it is "3dm" and rhino3dm is
        not installed.
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


def _threemf(vertices: Floats, faces: Ints, _: VertexData) -> bytes:
    corners = _rows('<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', vertices)
    triangles = _rows('<triangle v1="%d" v2="%d" v3="%d"/>\n', faces)
    model = (
        f'<model unit="millimeter" xmlns="{CORE}"><resources><object id="1" type="model"><mesh>\n'
        f"<vertices>\n{corners}</vertices>\n<triangles>\n{triangles}</triangles>\n"
        '</mesh></object></resources><build><item objectid="1"/></build></model>\n'
    )
    memory = io.BytesIO()
    with ZipFile(memory, "w") as zipped:  # ZipInfo without a date: the bytes are always the same
        for name, content in (*_THREEMF_PARTS, ("3D/3dmodel.model", model)):
            zipped.writestr(ZipInfo(name), _XML + content, ZIP_DEFLATED)
    return memory.getvalue()


def _3dm(vertices: Floats, faces: Ints, _: VertexData) -> bytes:
    return encoded_3dm(vertices, faces)


def _rows(pattern: str, values: NDArray[np.generic]) -> str:
    """One line for each row; adding 0 turns -0.0 into 0."""
    return (pattern * len(values)) % tuple((values + 0).ravel().tolist())


WRITERS: dict[str, Callable[[Floats, Ints, VertexData], bytes]] = {
    "stl": _stl,
    "ply": _ply,
    "obj": _obj,
    "off": _off,
    "3mf": _threemf,
    "3dm": _3dm,
}
