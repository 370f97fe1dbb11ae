"""The meshes that pictures show."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np

from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged, FootfitError, UnknownLast
from footfit.geometry.mesh.nearest import nearest_on_surface
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.locations import Location
from footfit.meshes.copies.compact_copy import expanded_mesh
from footfit.meshes.copies.lighter import lighter_mesh
from footfit.pipeline.fit.compare import best_comparison
from footfit.pipeline.scan.preparation import prepared_scan
from footfit.results import Comparison, Match, Scan, SurfaceCurvature

DRAWN_LASTS = 3
"""How many lasts are drawn beside a foot: nobody can tell more lines apart."""
DRAWN_FACES = 10_000
"""The faces of each mesh on a page: it is 0.3 mm from the scan, and has a tenth of its bytes."""


def candidate_shapes(path: Location, match: Match) -> dict[str, tuple[Floats, Ints]]:
    """The mesh copies of the best lasts by name, or of the nearest if no last fits.

    They are in mm in the canonical frame, each on its own side. A last without a sound copy is
    left out.
    """
    shapes = {}
    with open_catalogue(path) as catalogue:
        for candidate in (match.candidates or match.nearest)[:DRAWN_LASTS]:
            with suppress(UnknownLast, CatalogueDamaged):
                shapes[candidate.last] = expanded_mesh(catalogue.mesh_copy(candidate.last).data)
    return shapes


def foot_meshes(match: Match) -> tuple[tuple[Floats, Ints], ...]:
    """The feet of a match as light meshes, in mm in the canonical frame, each on its own side."""
    scans = (foot.aligned for foot in match.feet)
    return tuple(lighter_mesh(scan.vertices_mm, scan.faces, DRAWN_FACES) for scan in scans)


def best_comparisons(path: Location, match: Match) -> tuple[Comparison, ...]:
    """Each foot of a match in the best last, with drawable meshes; a foot that cannot be placed
    in it is left out.
    """
    comparisons = (best_comparison(path, match, foot) for foot in range(len(match.feet)))
    return tuple(drawable(comparison) for comparison in comparisons if comparison is not None)


def drawable(comparison: Comparison, faces: int = DRAWN_FACES) -> Comparison:
    """The same figures with lighter meshes; the clearance is that of the whole surface."""
    around = lighter_mesh(comparison.last_vertices_mm, comparison.last_faces, faces)
    inside = lighter_mesh(comparison.vertices_mm, comparison.faces, faces)
    clearance_mm = comparison.clearance_mm
    if len(inside[1]) < len(comparison.faces):
        nearest = nearest_on_surface(inside[0], comparison.vertices_mm, comparison.faces)
        corners = clearance_mm[comparison.faces[nearest.face]]
        # A corner without weight counts as 0: it may be NaN, and NaN times 0 is NaN.
        corners = np.where(nearest.weights > 0.0, corners, 0.0)
        clearance_mm = np.einsum("pj,pj->p", nearest.weights, corners)
    return replace(
        comparison,
        vertices_mm=inside[0],
        faces=inside[1],
        last_vertices_mm=around[0],
        last_faces=around[1],
        clearance_mm=clearance_mm,
    )


def canonical_view(curvature: SurfaceCurvature) -> Floats | None:
    """The transform (4, 4) of a surface to the canonical frame.

    It is None if the surface is neither a foot nor a last: curvature takes any surface.
    """
    scan = Scan(curvature.info, curvature.vertices_mm, curvature.faces, ())
    try:
        return prepared_scan(scan).canonical_transform
    except FootfitError:
        return None
