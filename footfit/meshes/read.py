"""From a path or bytes to a scan in mm, or to one line that says why not."""

from __future__ import annotations

import hashlib
import os
from typing import BinaryIO

from footfit.errors import FootfitError
from footfit.meshes.clean.cleaning import cleaned
from footfit.meshes.file_bytes import file_bytes, stream_bytes
from footfit.meshes.formats.known_formats import raw_mesh
from footfit.meshes.read_limits import LIMITS, Limits
from footfit.meshes.units import checked_options, settled_units
from footfit.results import MeshInfo, Scan


def read_scan(
    path: str | os.PathLike[str],
    *,
    units: str = "auto",
    known_length_mm: float | None = None,
    format: str | None = None,  # noqa: A002  the option's name
    limits: Limits = LIMITS,
) -> Scan:
    """Read one mesh file.

    Parameters
    ----------
    path : path
        A regular file, STL, OBJ, PLY, OFF, GLB or 3MF by its content; nothing else is ever opened.
    units : str
        "mm", "cm", "m", "in", or "auto": the one that makes the longest extent a foot's or last's.
    known_length_mm : float, optional
        The length of the foot, for a scan without a true scale. The scale is provisional (the
        longest extent) until the alignment settles it.
    format : str, optional
        "stl", "obj", "ply", "off", "glb" or "3mf"; refused where the content is another.
    limits : Limits

    Returns
    -------
    Scan
        mm, welded, cleaned, wound outward, with what was found as warnings.

    Raises
    ------
    InputError
        UnreadableFile, UnknownFormat, DamagedMesh, EmptyMesh, TooLarge or UnknownUnits, each
        naming the path.
    BadOption
        ``units``, ``known_length_mm`` or ``format`` cannot be carried out.
    """
    name = os.fspath(path)
    checked_options(units, known_length_mm)
    try:
        data = file_bytes(name, limits)
        return scan_from_bytes(
            data,
            path=name,
            format=format,
            units=units,
            known_length_mm=known_length_mm,
            limits=limits,
        )
    except FootfitError as error:
        raise error.at(name) from error


def read_stream(stream: BinaryIO, limits: Limits = LIMITS) -> bytes:
    """The bytes of standard input for :func:`scan_from_bytes`, no more than a file may have.

    Raises
    ------
    TooLarge, EmptyMesh
        Too many bytes, or none.
    """
    return stream_bytes(stream, limits)


def scan_from_bytes(
    data: bytes,
    *,
    path: str | None = None,
    format: str | None = None,  # noqa: A002  the option's name
    units: str = "auto",
    known_length_mm: float | None = None,
    limits: Limits = LIMITS,
) -> Scan:
    """A scan from the content of a file; see :func:`read_scan`.

    ``path`` is only recorded, and its extension breaks ties; None for standard input.

    Raises
    ------
    InputError, BadOption
        As :func:`read_scan` does.
    """
    checked_options(units, known_length_mm)
    name, raw = raw_mesh(data, path, format, limits)
    mesh = cleaned(raw.vertices, raw.faces)
    unit = settled_units(mesh.vertices, units, known_length_mm, raw.unit)
    info = MeshInfo(
        path=path,
        sha256=hashlib.sha256(data).hexdigest(),
        format=name,
        vertices=len(mesh.vertices),
        faces=len(mesh.faces),
        watertight=mesh.watertight,
        units=unit.name,
        units_source=unit.source,
        unit_scale=unit.scale,
    )
    warnings = raw.warnings + mesh.warnings + unit.warnings
    scaled = mesh.vertices * unit.scale
    return Scan(info, scaled, mesh.faces, warnings, mesh.source_to_vertex)
