"""Align a prepared scan: the canonical frame, and the paper's frame beside it."""

from __future__ import annotations

from footfit.errors import NoReference
from footfit.geometry.mesh import moments
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.pose import paper_frame
from footfit.results import AlignedScan, Alignment, Eigenframe, Method, PreparedScan, Reference
from footfit.results.values import fields


def aligned_scan(
    prepared: PreparedScan, method: Method = "footfit", reference: Reference | None = None
) -> AlignedScan:
    """Align a prepared scan.

    Parameters
    ----------
    prepared : PreparedScan
    method : {"footfit", "paper", "paper-literal"}
        What ``transform`` is; the canonical frame is found by footfit's method in any case.
    reference : Reference, optional
        Whose OM_E the paper's methods use.

    Raises
    ------
    NoReference
        If a paper method is asked for without a reference.
    """
    if method != "footfit" and reference is None:
        raise NoReference(
            f"method {method} needs a reference last; ingest one or run footfit set-reference LAST"
        )
    own, printed = _eigenframes(prepared, method)
    alignment = Alignment(
        **fields(prepared, "file_vertices_mm", "shape", "kind_margin"),
        method=method,
        transform=_transform(prepared, method, own, reference),
        eigenframe=own,
        printed_frame=printed,
        reference=reference,
    )
    return AlignedScan(alignment, prepared)


def _eigenframes(prepared: PreparedScan, method: Method) -> tuple[Eigenframe, Eigenframe]:
    """The method's own frame, and the one by Eq. 1-4 as printed, settled."""
    vertices_mm, faces = prepared.file_vertices_mm, prepared.scanned[1]
    rotation = prepared.canonical_transform[:3, :3] / prepared.info.unit_scale
    P_c, C_M, R = paper_frame.printed_axes(vertices_mm, faces)
    printed = _paired(P_c, paper_frame.settled_axes(R, rotation), C_M)
    if method == "paper":
        return printed, printed
    if method == "paper-literal":
        return _paired(P_c, paper_frame.largest_positive(R), C_M), printed
    centroid_mm, moment = moments.surface_moments(vertices_mm, faces)
    rows = paper_frame.settled_axes(moments.principal_axes(moment)[1], rotation)
    return _paired(centroid_mm, rows, moment), printed


def _paired(centroid_mm: Floats, rows: Floats, moment_mm2: Floats) -> Eigenframe:
    return Eigenframe(centroid_mm, rows, moments.moments_along(moment_mm2, rows))


def _transform(
    prepared: PreparedScan, method: Method, frame: Eigenframe, reference: Reference | None
) -> Floats:
    """The transform of the method; it never mirrors, though Eq. 1-8 see a left shape mirrored."""
    if method == "footfit" or reference is None:
        return prepared.canonical_transform
    left = prepared.side.side == "left"
    P_c, R = frame.centroid_mm, frame.eigenvectors
    if left:
        P_c, R = paper_frame.mirrored_frame(P_c, R)
    of_right = paper_frame.paper_transform(
        P_c,
        R,
        reference.om_e,
        reference.centroid_mm,
        prepared.info.unit_scale,
        literal=method == "paper-literal",
    )
    return paper_frame.unmirrored_transform(of_right, mirrored=left)
