"""Every picture as the bytes of a file; ``kind`` is "svg" or "png"."""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.report.pictures.figures import picture_bytes

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from footfit.geometry.numeric.arrays import Floats
    from footfit.report.pictures.curvature_figure import Quantity
    from footfit.results import AlignedScan, Profiled, SurfaceCurvature


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


def curvature_colours(curvature: SurfaceCurvature) -> NDArray[np.uint8]:
    """The colours (n, 3) of that picture, for a file of the mesh."""
    from footfit.report.pictures.curvature_figure import vertex_colours

    return vertex_colours(curvature)
