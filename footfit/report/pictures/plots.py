"""Every picture as the bytes of a file; ``kind`` is "svg" or "png"."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.report.pictures.figures import picture_bytes

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats
    from footfit.report.pictures.curvature_figure import Quantity
    from footfit.results import AlignedScan, Comparison, Profiled, SurfaceCurvature

HEAT_KINDS = ("ply", "svg", "png")


def frames_plot(scan: AlignedScan, kind: str) -> bytes:
    """A mesh with its eigenvectors before and after: the paper's figures 1 and 2."""
    from footfit.report.pictures.frames_figure import frames_figure

    return picture_bytes(frames_figure(scan), kind)


def flare_plot(profiled: Profiled, kind: str) -> bytes:
    """The sole in plan with its centre line, the heading, and the curvature along it."""
    from footfit.report.pictures.flare_figure import flare_figure

    return picture_bytes(flare_figure(profiled), kind)


def curvature_plot(
    curvature: SurfaceCurvature,
    kind: str,
    canonical_transform: Floats | None = None,
    quantity: Quantity = "mean",
) -> bytes:
    """A surface coloured by its curvature, from four sides."""
    from footfit.report.pictures.curvature_figure import curvature_figure

    return picture_bytes(curvature_figure(curvature, canonical_transform, quantity), kind)


def sections_plot(comparison: Comparison, kind: str) -> bytes:
    """Every section of a foot and its last."""
    from footfit.report.pictures.section_figure import section_figure

    return picture_bytes(section_figure(comparison), kind)


def heat_plot(comparison: Comparison, kind: str) -> bytes:
    """A foot in the last's frame, coloured by its clearance; "ply" gives the mesh.

    The mesh is on the foot's own side and carries ``room_mm`` at every vertex, NaN where nothing
    is compared.
    """
    from footfit.meshes.write import COLOUR, encoded_mesh
    from footfit.report.pictures.heat import heat_colours
    from footfit.report.pictures.heat_figure import heat_figure
    from footfit.report.pictures.sides import own_side

    if kind != "ply":
        return picture_bytes(heat_figure(comparison), kind)
    (vertices, faces), _ = own_side(comparison)
    clearance = comparison.clearance_mm
    colours = np.rint(255.0 * heat_colours(clearance)).astype(np.uint8)
    return encoded_mesh(vertices, faces, "ply", {"room_mm": clearance, COLOUR: colours})
