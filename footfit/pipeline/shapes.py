"""The meshes that pictures are drawn of."""

from __future__ import annotations

from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.errors import CatalogueDamaged, FootfitError, UnknownLast
from footfit.geometry.arrays import Floats, Ints
from footfit.meshes.copies import expanded
from footfit.pipeline.align import aligned
from footfit.results import Match, Scan, SurfaceCurvature

DRAWN = 3
"""Lasts that are drawn beside a foot: more lines than that are not told apart."""


def candidate_shapes(path: Path, match: Match) -> dict[str, tuple[Floats, Ints]]:
    """The mesh copies of the best lasts by name, canonical mm, each on its own side; a last
    without a sound copy is left out.
    """
    shapes = {}
    with open_catalogue(path) as catalogue:
        for candidate in match.candidates[:DRAWN]:
            try:
                shapes[candidate.last] = expanded(catalogue.mesh_copy(candidate.last).data)
            except (UnknownLast, CatalogueDamaged):
                continue
    return shapes


def canonical_view(curvature: SurfaceCurvature) -> Floats | None:
    """The transform (4, 4) that lays a surface into the canonical frame; None where it is no
    foot and no last: curvature is asked of any surface.
    """
    scan = Scan(curvature.info, curvature.vertices_mm, curvature.faces, ())
    try:
        return aligned(scan).alignment.canonical_transform
    except FootfitError:
        return None
