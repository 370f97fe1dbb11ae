"""One JSON document per answer about meshes; docs/json.md lists every key.

A document is a dict of plain values; `lines.json_line` writes it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from footfit.report.json.lines import Json, document
from footfit.report.json.lines import error_document as error_document
from footfit.report.json.lines import json_line as json_line
from footfit.report.json.numbers import (
    RATIO_DIGITS,
    degrees,
    millimetres,
    nested,
    ratio,
)
from footfit.report.json.parts import (
    clearance_part,
    eigenframe_part,
    fit_part,
    flare_part,
    measures_part,
    mesh_part,
    pose_part,
    profile_part,
    reference_part,
    side_part,
    sizes_part,
    warnings_part,
)
from footfit.report.json.surface_parts import surfaces_part

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats
    from footfit.results import (
        Alignment,
        Candidate,
        IngestOutcome,
        Match,
        Profiled,
        SurfaceCurvature,
    )

QUANTILES = (0.05, 0.5, 0.95)


def align_document(alignment: Alignment) -> Json:
    """``footfit.align/2``."""
    return document(
        "align",
        {
            "mesh": mesh_part(alignment.info),
            **side_part(alignment.side),
            "method": alignment.method,
            "transform": nested(alignment.transform, RATIO_DIGITS),
            **eigenframe_part(alignment.eigenframe),
            "reference": reference_part(alignment.reference),
            "pose": pose_part(alignment.pose),
            "length_mm": millimetres(alignment.length_mm),
            "extent_mm": millimetres(alignment.extent_mm),
            "warnings": warnings_part(alignment.warnings),
        },
        version=2,
    )


def flare_document(profiled: Profiled) -> Json:
    """``footfit.flare/1``."""
    alignment = profiled.aligned.alignment
    return document(
        "flare",
        {
            "mesh": mesh_part(alignment.info),
            "kind": alignment.pose.kind,
            **side_part(alignment.side),
            **flare_part(profiled.flare),
            "length_mm": millimetres(alignment.length_mm),
            "extent_mm": millimetres(alignment.extent_mm),
            "warnings": warnings_part((*alignment.warnings, *profiled.suspects)),
        },
    )


def match_document(match: Match) -> Json:
    """``footfit.match/1``: one customer, one foot or two."""
    return document(
        "match",
        {
            "feet": [foot_part(foot) for foot in match.feet],
            "by": match.by,
            "profile": match.profile,
            "fit_profile": profile_part(match.fit_profile),
            "size_system": match.size_system,
            "catalogue": {"lasts": match.catalogue_lasts, "reference": match.reference},
            "candidates": [candidate_part(candidate) for candidate in match.candidates],
            "best_verdict": match.best_verdict,
            "nearest": [candidate_part(candidate) for candidate in match.nearest],
            "rejected": {
                "count": sum(count for _, count in match.rejected),
                "by_reason": dict(match.rejected),
            },
            "warnings": warnings_part(match.warnings),
        },
    )


def foot_part(foot: Profiled) -> Json:
    """One foot of a match."""
    alignment = foot.aligned.alignment
    return {
        "mesh": mesh_part(alignment.info),
        "kind": alignment.pose.kind,
        **side_part(alignment.side),
        "measures": measures_part(foot.measures),
        "sizes": sizes_part(foot.length_mm),
        "flare": flare_part(foot.flare),
        "warnings": warnings_part(alignment.warnings),
    }


def candidate_part(candidate: Candidate) -> Json:
    """One last of a match, null where it is not measured."""
    flare = candidate.flare
    return {
        "rank": candidate.rank,
        "last": candidate.last,
        "style": candidate.style,
        "size": candidate.size,
        "size_system": candidate.size_system,
        "width_label": candidate.width_label,
        "side": candidate.side,
        "mirrored": candidate.mirrored,
        "distance": ratio(candidate.distance),
        "distance_sd": ratio(candidate.distance_sd),
        "flare": {
            "distance": ratio(flare.distance),
            "delta_deg": degrees(flare.delta_deg),
            "parts": {name: ratio(part) for name, part in flare.parts},
        },
        "clearance_mm": clearance_part(candidate.clearance_mm),
        "fits": [fit_part(fit) for fit in candidate.fits],
        "surface_clearance": surfaces_part(candidate.surfaces),
        "not_judged": list(candidate.not_judged),
        "verdict": candidate.verdict,
        "why": candidate.why,
        "tied_with": list(candidate.tied_with),
    }


def ingest_document(outcome: IngestOutcome) -> Json:
    """``footfit.ingest-last/1``: what became of one file."""
    return document(
        "ingest-last",
        {
            "path": outcome.path,
            "status": outcome.status,
            "last": outcome.last,
            "side": outcome.side,
            "flare_angle_deg": degrees(outcome.flare_angle_deg),
            "error": outcome.error,
            "code": outcome.code,
            "exit": outcome.exit,
            "reference": outcome.reference,
            "dry_run": outcome.dry_run,
            "warnings": warnings_part(outcome.warnings),
        },
    )


def curvature_document(curvature: SurfaceCurvature, *, output: str | None = None) -> Json:
    """``footfit.curvature/1``: the spread of each curvature; the file holds every vertex."""
    return document(
        "curvature",
        {
            "mesh": mesh_part(curvature.info),
            "radius_mm": millimetres(curvature.radius_mm),
            "defined_vertices": int(np.count_nonzero(np.isfinite(curvature.mean))),
            "k1_per_mm": spread_part(curvature.k1),
            "k2_per_mm": spread_part(curvature.k2),
            "mean_per_mm": spread_part(curvature.mean),
            "gaussian_per_mm2": spread_part(curvature.gaussian),
            "output": output,
            "warnings": warnings_part(curvature.warnings),
        },
    )


def spread_part(values: Floats) -> Json:
    """The 5 %, 50 % and 95 % quantiles over the defined vertices; null where there is none."""
    defined = values[np.isfinite(values)]
    if not len(defined):
        return {f"p{round(100 * level):02d}": None for level in QUANTILES}
    quantiles = np.quantile(defined, QUANTILES)
    return {
        f"p{round(100 * level):02d}": ratio(float(value))
        for level, value in zip(QUANTILES, quantiles, strict=True)
    }
