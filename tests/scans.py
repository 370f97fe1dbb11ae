"""Scans for tests, taken through the pipeline."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.clean.triangles import welded_mesh
from footfit.meshes.read import FileMesh
from footfit.pipeline.scan.align import aligned_scan
from footfit.pipeline.scan.cleaning import scan_of
from footfit.pipeline.scan.preparation import prepared_scan, right_copy
from footfit.results import AlignedScan, Alignment, Method, PreparedScan, Reference, Scan


def cleaned(vertices: Floats, faces: Ints) -> Scan:
    """A mesh in mm as it is after reading and cleaning."""
    return scan_of(FileMesh("stl", "0" * 64, "mm", welded_mesh(vertices, faces), ()), None)


def aligned(
    scan: Scan,
    *,
    method: Method = "footfit",
    side: Literal["auto", "left", "right"] = "auto",
    reference: Reference | None = None,
    known_length_mm: float | None = None,
    force_side: bool = False,
) -> AlignedScan:
    """A scan prepared and aligned."""
    prepared = prepared_scan(scan, side, known_length_mm, force_side=force_side)
    return aligned_scan(prepared, method, reference)


def aligned_of(alignment: Alignment, vertices_mm: Floats, faces: Ints) -> AlignedScan:
    """An aligned scan of a canonical mesh that stands on its own side; no hole is closed."""
    right_mm, right_faces = right_copy(vertices_mm, faces, alignment.side.side)
    prepared = PreparedScan(
        info=replace(alignment.info, vertices=len(vertices_mm), faces=len(faces)),
        side=alignment.side,
        pose=alignment.pose,
        canonical_transform=alignment.canonical_transform,
        length=alignment.length,
        extent_mm=alignment.extent_mm,
        stance=alignment.stance,
        standing_transform=alignment.standing_transform,
        file_vertices_mm=vertices_mm,
        shape=Shape(right_mm, right_faces, alignment.pose.kind),
        warnings=alignment.warnings,
    )
    return AlignedScan(alignment, prepared)


def right_shape(aligned: AlignedScan) -> tuple[Floats, Ints]:
    """The right-side copy that is measured, its holes closed."""
    return aligned.prepared.vertices_mm, aligned.prepared.faces
