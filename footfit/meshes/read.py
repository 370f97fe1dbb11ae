"""From the bytes of a mesh file to a scan in mm, or to one line that says why not."""

from __future__ import annotations

import hashlib

from footfit.errors import FootfitError
from footfit.meshes.clean.cleaning import cleaned
from footfit.meshes.formats.known_formats import raw_mesh
from footfit.meshes.read_limits import LIMITS, Limits
from footfit.meshes.units import checked_options, settled_units
from footfit.results import MeshInfo, Scan


def scan_from_bytes(
    data: bytes,
    *,
    path: str | None = None,
    format: str | None = None,  # noqa: A002  the option's name
    units: str = "auto",
    known_length_mm: float | None = None,
    limits: Limits = LIMITS,
) -> Scan:
    """A scan from the content of a mesh file.

    Parameters
    ----------
    data : bytes
        STL, OBJ, PLY, OFF, GLB or 3MF by its content; no other file is ever opened.
    path : str, optional
        Where the bytes come from; None for standard input. It is recorded, errors name it, and its
        extension decides where the content does not.
    format : str, optional
        "stl", "obj", "ply", "off", "glb" or "3mf"; refused where the content is of another format.
    units : str
        "mm", "cm", "m", "in", or "auto": the one that makes the longest extent a foot's or last's.
    known_length_mm : float, optional
        The length of the foot, for a scan without a true scale. The scale is provisional (the
        longest extent) until the alignment settles it.
    limits : Limits

    Returns
    -------
    Scan
        mm, welded, cleaned, wound outward, with a warning for everything that was changed.

    Raises
    ------
    InputError
        UnknownFormat, DamagedMesh, EmptyMesh, TooLarge or UnknownUnits, each naming the path.
    BadOption
        ``units``, ``known_length_mm`` or ``format`` cannot be carried out.
    """
    try:
        checked_options(units, known_length_mm)
        name, raw = raw_mesh(data, path, format, limits)
        mesh = cleaned(raw.vertices, raw.faces)
        unit = settled_units(mesh.vertices, units, known_length_mm, raw.unit)
    except FootfitError as error:
        raise error.at(path) from error
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
    return Scan(info, mesh.vertices * unit.scale, mesh.faces, warnings, mesh.source_to_vertex)
