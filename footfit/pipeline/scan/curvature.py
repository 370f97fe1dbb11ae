"""Curvature of a scan's surface, per vertex."""

from __future__ import annotations

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.curvature.one_ring import one_ring_curvature
from footfit.geometry.curvature.pooled_curvature import longest_radius, pooled_curvature
from footfit.geometry.mesh.topology import edges
from footfit.geometry.pose.extents import principal_extents
from footfit.results import Notice, Scan, SurfaceCurvature

RADIUS_PER_EXTENT = 0.06
"""The scale if none is given, over the longest principal extent."""


def surface_curvature(scan: Scan, radius_mm: float | None = None) -> SurfaceCurvature:
    """The curvature of a scan at a scale, in 1/mm per vertex.

    Parameters
    ----------
    scan : Scan
    radius_mm : float, optional
        The scale of
        :func:`footfit.geometry.curvature.pooled_curvature.pooled_curvature`; 0 is the paper's one
        ring (III.C). None takes 6 % of the longest principal extent.

    Raises
    ------
    BadOption
        The radius is negative or not a number.
    """
    vertices, faces = scan.vertices_mm, scan.faces
    if radius_mm is None:
        radius_mm = RADIUS_PER_EXTENT * float(principal_extents(vertices)[0][0])
    if not 0.0 <= radius_mm < np.inf:
        raise BadOption("the radius must be 0 (one ring) or a length in mm, such as --radius 15")
    if radius_mm > 0.0:
        values = pooled_curvature(vertices, faces, radius_mm)
    else:
        values = one_ring_curvature(vertices, faces)
    source = scan.source_to_vertex
    return SurfaceCurvature(
        info=scan.info,
        radius_mm=radius_mm,
        vertices_mm=vertices,
        faces=faces,
        k1=values.k1,
        k2=values.k2,
        mean=values.mean,
        gaussian=values.gaussian,
        source_to_vertex=np.arange(len(vertices)) if source is None else source,
        warnings=(*scan.warnings, *_notices(scan, radius_mm, int(np.isnan(values.mean).sum()))),
    )


def _notices(scan: Scan, radius_mm: float, undefined: int) -> tuple[Notice, ...]:
    """A radius that is too short or too long for the mesh, and vertices without a value."""
    pairs = scan.vertices_mm[edges(scan.faces)]
    edge_mm = float(np.median(np.linalg.norm(pairs[:, 1] - pairs[:, 0], axis=1)))
    longest_mm = longest_radius(scan.vertices_mm, scan.faces)
    radius = f"the radius of {radius_mm:.3g} mm"
    short = (
        f"{radius} is below the median edge of {edge_mm:.3g} mm, so the curvature is that of the"
        " nearest ring: take a larger --radius"
    )
    long = (
        f"{radius} spans more edges than pooling follows, so the curvature is that of about"
        f" {longest_mm:.3g} mm: take a smaller --radius or a coarser mesh"
    )
    none = (
        f"{undefined} of {len(scan.vertices_mm)} vertices have no curvature (a boundary at radius 0"
        ", or no surface around them): their value is empty"
    )
    notices = (
        (0.0 < radius_mm < edge_mm, Notice("radius_below_edges", short)),
        (radius_mm > longest_mm, Notice("radius_cut", long)),
        (undefined > 0, Notice("curvature_undefined", none)),
    )
    return tuple(notice for applies, notice in notices if applies)
