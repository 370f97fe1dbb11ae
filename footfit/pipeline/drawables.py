"""The meshes that pictures are drawn of."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged, FootfitError, UnknownLast
from footfit.geometry.mesh.nearest import nearest_on_surface
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.copies.compact_copy import expanded
from footfit.meshes.copies.lighter import lighter_mesh
from footfit.pipeline.fit.compare import best_comparison
from footfit.pipeline.scan.align import aligned
from footfit.results import Comparison, Match, Scan, SurfaceCurvature

DRAWN = 3
"""Lasts that are drawn beside a foot: more lines than that are not told apart."""
DRAWN_FACES = 10_000
"""Of each mesh on a page: 0.3 mm from the scan, a tenth of its bytes."""


def candidate_shapes(path: Path, match: Match) -> dict[str, tuple[Floats, Ints]]:
    """The mesh copies of the best lasts by name, or of the nearest where none fits, canonical mm,
    each on its own side; a last without a sound copy is left out.
    """
    shapes = {}
    with open_catalogue(path) as catalogue:
        for candidate in (match.candidates or match.nearest)[:DRAWN]:
            try:
                shapes[candidate.last] = expanded(catalogue.mesh_copy(candidate.last).data)
            except (UnknownLast, CatalogueDamaged):
                continue
    return shapes


def best_comparisons(path: Path, match: Match) -> tuple[Comparison, ...]:
    """Each foot of a match in the best last, as it is drawn; a foot that cannot be laid into it
    is left out.
    """
    found = (best_comparison(path, match, foot) for foot in range(len(match.feet)))
    return tuple(drawable(comparison) for comparison in found if comparison is not None)


def drawable(comparison: Comparison, faces: int = DRAWN_FACES) -> Comparison:
    """The same figures with lighter meshes; the clearance is that of the whole surface."""
    around = lighter_mesh(comparison.last_vertices_mm, comparison.last_faces, faces)
    inside = lighter_mesh(comparison.vertices_mm, comparison.faces, faces)
    clearance_mm = comparison.clearance_mm
    if len(inside[1]) < len(comparison.faces):
        found = nearest_on_surface(inside[0], comparison.vertices_mm, comparison.faces)
        corners = clearance_mm[comparison.faces[found.face]]
        felt = np.where(found.weights > 0.0, corners, 0.0)  # an unknown corner without weight
        clearance_mm = np.einsum("pj,pj->p", found.weights, felt)
    return replace(
        comparison,
        vertices_mm=inside[0],
        faces=inside[1],
        last_vertices_mm=around[0],
        last_faces=around[1],
        clearance_mm=clearance_mm,
    )


def canonical_view(curvature: SurfaceCurvature) -> Floats | None:
    """The transform (4, 4) that lays a surface into the canonical frame; None where it is no
    foot and no last: curvature is asked of any surface.
    """
    scan = Scan(curvature.info, curvature.vertices_mm, curvature.faces, ())
    try:
        return aligned(scan).alignment.canonical_transform
    except FootfitError:
        return None
