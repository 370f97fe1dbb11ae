"""Curvature of a scan's surface, per vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.errors import BadOption
from footfit.geometry.curvature.one_ring import one_ring_curvature
from footfit.geometry.curvature.pooled_curvature import longest_radius, pooled_curvature
from footfit.geometry.mesh.topology import edges
from footfit.geometry.pose.extents import principal_extents
from footfit.results import Notice, Scan, SurfaceCurvature


@dataclass(frozen=True, slots=True)
class CurvatureDefaults:
    """``radius_per_extent``: the scale where none is given, over the longest principal extent."""

    radius_per_extent: float = 0.06


DEFAULTS = CurvatureDefaults()


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
        radius_mm = DEFAULTS.radius_per_extent * float(principal_extents(vertices)[0][0])
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
    notices = []
    pairs = scan.vertices_mm[edges(scan.faces)]
    edge_mm = float(np.median(np.linalg.norm(pairs[:, 1] - pairs[:, 0], axis=1)))
    if 0.0 < radius_mm < edge_mm:
        notices.append(
            Notice(
                "radius_below_edges",
                f"the radius of {radius_mm:.3g} mm is below the median edge of {edge_mm:.3g} mm: "
                "the curvature is that of the nearest ring; take a larger --radius",
            )
        )
    longest_mm = longest_radius(scan.vertices_mm, scan.faces)
    if radius_mm > longest_mm:
        notices.append(
            Notice(
                "radius_cut",
                f"the radius of {radius_mm:.3g} mm spans more edges than pooling follows: the "
                f"curvature is that of about {longest_mm:.3g} mm; take a smaller --radius or a "
                "coarser mesh",
            )
        )
    if undefined:
        notices.append(
            Notice(
                "curvature_undefined",
                f"{undefined} of {len(scan.vertices_mm)} vertices have no curvature "
                "(a boundary at radius 0, or no surface around them): their value is empty",
            )
        )
    return tuple(notices)
