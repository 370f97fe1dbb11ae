"""From the bytes of a ``.3dm`` to the surface of its visible objects, in the model's unit."""

from __future__ import annotations

import io
import json
import struct
from dataclasses import replace
from typing import Any, NoReturn

import numpy as np

from footfit.errors import DamagedMesh, EmptyMesh, TooLarge, UnknownFormat
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.quantiles import median
from footfit.meshes.formats.placed_parts import Part, joined_parts
from footfit.meshes.formats.raw import RawMesh, check_counts
from footfit.meshes.read_limits import SIMPLIFY, Limits
from footfit.meshes.rhino.seams import Patches, closed_gaps
from footfit.meshes.rhino.watched_process import INSTALL, RhinoFailed, is_installed, run
from footfit.results.values import Notice

_MAGIC = b"3D Geometry File Format "
_HEADER_BYTES = 32
_WIDE_FROM = 50
"""From this version of the format on, lengths have 8 bytes."""
_SHORT, _END = 0x80000000, 0x7FFF
_UNITS = {  # the unit that footfit reports, and how many of it each unit of the format has
    "Microns": ("mm", 0.001),
    "Millimeters": ("mm", 1.0),
    "Centimeters": ("cm", 1.0),
    "Decimeters": ("cm", 10.0),
    "Meters": ("m", 1.0),
    "Mils": ("in", 0.001),
    "Inches": ("in", 1.0),
    "Feet": ("in", 12.0),
}
_NO_UNIT = ("None", "Unset", "CustomUnits")
GAP_MM = 0.5
"""Surfaces whose edges are no farther apart are joined."""
WIDE_MM = 3.0
"""An open edge that is so near to another surface is a gap, and no rim of the model."""
_MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}
_USUAL_MM = 250.0
"""About the length of a last, for the gaps of a file without a unit."""
_AGAIN = "open it in Rhino and save it again, or export STL"


def is_3dm(data: bytes) -> bool:
    """Whether the content begins as a ``.3dm`` does."""
    return data.startswith(_MAGIC)


def read_3dm(data: bytes, limits: Limits) -> RawMesh:
    """The visible meshes of a ``.3dm``, and its surfaces by their render meshes, as one surface.

    Raises
    ------
    UnknownFormat
        rhino3dm is not installed, a surface has no render mesh, or the unit is not one of a last.
    DamagedMesh
        The file is damaged.
    EmptyMesh, TooLarge
        No visible object has a surface, or there is more than ``limits`` allow.
    """
    if not is_installed():
        raise UnknownFormat(f"footfit reads .3dm only with rhino3dm: {INSTALL}, or export STL")
    if not _is_whole(data, limits.elements):
        raise DamagedMesh(f"the .3dm is cut off or damaged: {_AGAIN}")
    try:
        answer = run("read", data, limits)
    except RhinoFailed as error:
        raise DamagedMesh(f"the .3dm is damaged and cannot be read: {_AGAIN}") from error
    with np.load(io.BytesIO(answer), allow_pickle=False) as arrays:
        facts: dict[str, Any] = json.loads(arrays["facts"].tobytes())
        if "error" in facts:
            _refuse(facts, limits)
        unit = _unit(facts)
        parts = _parts(arrays["vertices"], arrays["faces"], arrays["counts"], arrays["transforms"])
        objects = len(np.unique(arrays["object"]))
    if facts["unmeshed"]:
        raise UnknownFormat(
            f"{facts['unmeshed']} surfaces of the .3dm have no render mesh: show them shaded in"
            " Rhino, save without Save Small, or export STL"
        )
    if not parts:
        hidden = f" ({facts['hidden']} objects are hidden)" if facts["hidden"] else ""
        raise EmptyMesh(f"the .3dm shows no mesh and no surface{hidden}: show the last and save it")
    return _joined(parts, objects, facts, unit)


def _joined(
    parts: list[Part], objects: int, facts: dict[str, Any], unit: tuple[str | None, float]
) -> RawMesh:
    """All parts as one surface without gaps, with the notices of what was done."""
    name, scale = unit
    scaled = np.diag([scale, scale, scale, 1.0])
    placed = [replace(part, transform=scaled @ part.transform) for part in parts]
    raw = joined_parts(placed, objects, name or "")
    notices = list(raw.warnings)
    if facts["hidden"]:
        words = f"{facts['hidden']} hidden objects of the .3dm are left out"
        notices.append(Notice("hidden_objects", words))
    vertices, faces = raw.vertices, raw.faces
    if len(parts) > 1 and np.isfinite(vertices).all():
        mm = _MM[name] if name else _USUAL_MM / (float(np.ptp(vertices, axis=0).max()) or 1.0)
        patch = np.repeat(np.arange(len(parts)), [len(part.faces) for part in parts])
        closed = closed_gaps(vertices, faces, patch, GAP_MM / mm)
        vertices, faces, widest_mm = closed.vertices, closed.faces, closed.widest * mm
        if widest_mm > 0.0:
            words = f"gaps of up to {widest_mm:.2f} mm between surfaces of the .3dm were closed"
            notices.append(Notice("gaps_closed", words))
        notices += _open_notices(closed, mm)
    return RawMesh(vertices, faces, tuple(notices), name)


def _open_notices(closed: Patches, mm: float) -> list[Notice]:
    """What to say of the gaps between surfaces that stay open; the vertices are in ``mm`` units."""
    gaps_mm = mm * closed.open_gaps(WIDE_MM / mm)
    if not len(gaps_mm):
        return []
    middle_mm = median(gaps_mm)
    why = f"gaps of about {middle_mm:.1f} mm, and footfit closes {GAP_MM} mm"
    if middle_mm <= GAP_MM:
        why = "their seams run zigzag along short edges"
    words = (
        f"{len(gaps_mm):,} places between surfaces of the .3dm stay open ({why}): join the surfaces"
        " in Rhino, mesh them as one and save again"
    )
    return [Notice("gaps_open", words)]


def _parts(vertices: Floats, faces: Ints, counts: Ints, transforms: Floats) -> list[Part]:
    """The parts, each with its triangles."""
    ends = np.cumsum(counts, axis=0)
    return [
        Part(
            vertices[last - count : last],
            _triangles(vertices[last - count : last], faces[end - number : end]),
            transform,
        )
        for (last, end), (count, number), transform in zip(ends, counts, transforms, strict=True)
    ]


def _triangles(vertices: Floats, faces: Ints) -> Ints:
    """The triangles of faces (m, 4); a quad is cut along its shorter diagonal."""
    if faces.size and not 0 <= faces.min() <= faces.max() < len(vertices):
        raise DamagedMesh("a face names a vertex that is not there: export the mesh again")
    quads = faces[faces[:, 2] != faces[:, 3]]
    a, b, c, d = (vertices[quads[:, corner]] for corner in range(4))
    with np.errstate(all="ignore"):  # `checked_mesh` refuses what is not finite
        across = np.linalg.norm(c - a, axis=1) <= np.linalg.norm(d - b, axis=1)
    first = np.where(across[:, None], quads[:, [0, 1, 2]], quads[:, [0, 1, 3]])
    second = np.where(across[:, None], quads[:, [0, 2, 3]], quads[:, [1, 2, 3]])
    return np.concatenate([faces[faces[:, 2] == faces[:, 3], :3], first, second])


def _unit(facts: dict[str, Any]) -> tuple[str | None, float]:
    """The unit that footfit reports, and its scale."""
    name = facts["unit"]
    if name in _NO_UNIT:
        return None, 1.0
    if name not in _UNITS:
        raise UnknownFormat(
            f"the unit of the .3dm is {name[:20].lower()}: set it to millimetres in Rhino"
        )
    return _UNITS[name]


def _refuse(facts: dict[str, Any], limits: Limits) -> NoReturn:
    """Raise the error that the process names."""
    if facts["error"] == "counts":
        vertices, faces = facts["counts"]
        check_counts(vertices, faces, limits)
    if facts["error"] == "parts":
        raise DamagedMesh(
            f"the blocks of the .3dm contain each other, or it has over {limits.parts:,} objects:"
            " export the last alone"
        )
    if facts["error"] == "memory":
        raise TooLarge(f"the .3dm does not fit in memory: {SIMPLIFY}")
    raise DamagedMesh(f"the .3dm is damaged and cannot be read: {_AGAIN}")


def _is_whole(data: bytes, most_chunks: int) -> bool:
    """Whether the chunks of the file follow each other to its end mark.

    A chunk is a number for its kind, and the length of what follows; a short one has a value in
    the place of the length. rhino3dm looks for minutes through a file that is cut off.
    """
    try:
        version = int(data[len(_MAGIC) : _HEADER_BYTES])
        head = struct.Struct("<Iq" if version >= _WIDE_FROM else "<Ii")
        at = _HEADER_BYTES
        for _ in range(most_chunks):  # a model has some twenty at this level
            kind, length = head.unpack_from(data, at)
            at += head.size + (0 if kind & _SHORT else length)
            if length < 0 and not kind & _SHORT:
                return False
            if kind == _END:
                return at <= len(data)
    except (ValueError, struct.error):
        return False
    return False
