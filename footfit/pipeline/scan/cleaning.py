"""From a file's mesh to a scan: specks and a floor plate off, faces outward, in mm."""

from __future__ import annotations

import numpy as np

from footfit.errors import EmptyMesh
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import edge_groups, face_components
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Ints, row_lengths
from footfit.geometry.pose.facing import outward_faces
from footfit.geometry.pose.loose_pieces import KeptPieces, kept_pieces
from footfit.meshes.clean.contacts import contact_faces
from footfit.meshes.read import FileMesh
from footfit.meshes.units import settled_units
from footfit.results import MeshInfo, Notice, Scan
from footfit.results.values import count_notice

SLIVER = 1e-12
"""A face whose area is below this share of the mean area has none."""
COVERED = "faces that another body covers, inside the solid, were removed"
PLATE_REMOVED = Notice("plate_removed", "a floor plate was taken off")


def scan_of(
    file: FileMesh, path: str | None, units: str = "auto", known_length_mm: float | None = None
) -> Scan:
    """A file's mesh as a scan in mm: the pieces that matter, faces outward, none without an area.

    The surface may be of any kind: whether there is a foot in it is not asked here. A unit that is
    detected is provisional. ``watertight`` is counted before faces without an area are dropped,
    because those close a surface too.

    Raises
    ------
    EmptyMesh
        No face has an area.
    DamagedMesh
        The surface is in far too many pieces.
    UnknownUnits
        As :func:`footfit.meshes.units.settled_units` does.
    BadOption
        ``units`` or ``known_length_mm`` cannot be carried out.
    """
    vertices, faces = file.mesh.vertices, file.mesh.faces
    vectors = area_vectors(vertices, faces)
    areas = row_lengths(vectors)
    flat = areas <= SLIVER * areas.mean() if len(areas) else areas == 0.0
    if flat.all():
        raise EmptyMesh("no triangle of the file has an area: export the mesh again")
    labels = face_components(faces, len(vertices))
    kept = kept_pieces(vertices, faces, labels, areas)
    if not kept.faces.all():
        faces, vectors = faces[kept.faces], vectors[kept.faces]
        labels, flat = labels[kept.faces], flat[kept.faces]
    faces, turned = outward_faces(vertices, faces, vectors, labels)
    open_notices, inner = _open_notices(faces), np.zeros(len(faces), dtype=bool)
    if any(notice.code == "non_manifold" for notice in open_notices):
        inner = contact_faces(vertices, faces)
    if inner.any():
        faces, flat = faces[~inner], flat[~inner]
        open_notices = _open_notices(faces)
    removed = file.mesh.collapsed + int(flat.sum())
    vertices, faces, number = without_unused_vertices(vertices, faces[~flat])
    unit = settled_units(vertices, units, known_length_mm, file.unit)
    info = MeshInfo(
        path=path,
        sha256=file.sha256,
        format=file.format,
        vertices=len(vertices),
        faces=len(faces),
        watertight=not open_notices,
        units=unit.name,
        units_source=unit.source,
        unit_scale=unit.scale,
        step=file.step,
    )
    notices = (
        *file.notices,
        *file.mesh.notices,
        *count_notice("inner_faces_removed", int(inner.sum()), COVERED),
        *_piece_notices(kept),
        *turned_notices(turned),
        *count_notice(
            "degenerate_removed",
            removed,
            "faces without an area were removed",
            "face without an area was removed",
        ),
        *open_notices,
        *unit.warnings,
    )
    source_to_vertex = number[file.mesh.source_to_vertex]
    return Scan(info, vertices * unit.scale, faces, notices, source_to_vertex)


def _piece_notices(kept: KeptPieces) -> tuple[Notice, ...]:
    """What was taken off, and whether the rest is in pieces."""
    notices = [PLATE_REMOVED] if kept.plates else []
    if kept.loose > 1:
        message = f"the surface is in {kept.loose} pieces that touch nowhere: all are kept"
        notices.append(Notice("many_pieces", message))
    share = f"{100.0 * kept.specks_share:.2g} % of the area"
    words = f"small loose pieces ({share}) were removed"
    return (*notices, *count_notice("specks_removed", kept.specks, words))


def turned_notices(count: int) -> tuple[Notice, ...]:
    """What to say of faces that were turned over, if any."""
    return count_notice(
        "winding_fixed",
        count,
        "faces looked inward and were turned over",
        "face looked inward and was turned over",
    )


def _open_notices(faces: Ints) -> tuple[Notice, ...]:
    """What to say if not every edge has exactly two faces."""
    counts = edge_groups(faces)[2]
    rims, crowded = int((counts == 1).sum()), int((counts - 2).clip(0).sum())
    return (
        *count_notice(
            "non_manifold",
            crowded,
            "faces share an edge that two other faces have already",
            "face shares an edge that two other faces have already",
        ),
        *count_notice(
            "open_mesh",
            rims,
            "edges have only one face: the surface is open",
            "edge has only one face: the surface is open",
        ),
    )
