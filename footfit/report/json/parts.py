"""The pieces that several JSON documents share."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING

import numpy as np

from footfit.geometry.fit.sizes import SYSTEMS, foot_sizes, label_check, label_words
from footfit.geometry.flare.flare_profile import CHANNELS
from footfit.geometry.pose import paper_frame
from footfit.report.json.lines import Json
from footfit.report.json.numbers import (
    MILLIMETRE_DIGITS,
    RATIO_DIGITS,
    degrees,
    measured_value,
    millimetres,
    nested,
    ratio,
)
from footfit.results import Measured

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from footfit.geometry.flare.flare_profile import FlareProfile
    from footfit.results import (
        Eigenframe,
        FitProfile,
        FootFit,
        LastRecord,
        Measure,
        MeshInfo,
        Notice,
        PoseQuality,
        Reference,
        SideVerdict,
    )

FIT_NAMES = ("length", "ball_width", "ball_girth", "heel_width", "instep_girth")
"""The measures and clearances that every document names, measured or not."""

NOT_YET = Measured(None, reason="this version does not measure it")


def mesh_part(info: MeshInfo) -> Json:
    """What the file was."""
    return {
        "path": info.path,
        "sha256": info.sha256,
        "vertices": info.vertices,
        "faces": info.faces,
        "watertight": info.watertight,
        "units": info.units,
        "units_source": info.units_source,
    }


def side_part(side: SideVerdict) -> Json:
    """Left or right, how surely, and who said so: three keys of the document itself."""
    return {
        "side": side.side,
        "side_confidence": {"word": side.confidence, "score": ratio(side.score)},
        "side_source": side.source,
    }


def pose_part(pose: PoseQuality) -> Json:
    """How well the pose is settled."""
    return {
        "cost": ratio(pose.cost),
        "margin": ratio(pose.margin),
        "support": ratio(pose.support),
        "sole": pose.sole,
    }


def reference_part(reference: Reference | None) -> Json | None:
    """The reference last and its OM_E (Eq. 6), or null."""
    if reference is None:
        return None
    return {"last": reference.last, "om_e": nested(reference.om_e, RATIO_DIGITS)}


def warnings_part(warnings: Iterable[Notice]) -> list[Json]:
    """Every warning as a code for scripts and a message for people."""
    return [{"code": notice.code, "message": notice.message} for notice in warnings]


def flare_part(flare: FlareProfile) -> Json:
    """The flare profile with its whole definition."""
    curvature: Json = {}
    for channel in CHANNELS:
        values = flare.curvature.get(channel)
        curvature[channel] = None if values is None else nested(values, RATIO_DIGITS)
    return {
        "flare_angle_deg": degrees(flare.angle_deg),
        "flare_angle_sd_deg": degrees(flare.angle_sd_deg),
        "class": flare.flare_class,
        "definition": finite(asdict(flare.definition)),
        "stations": nested(flare.stations, RATIO_DIGITS),
        "heading_deg": nested(flare.heading_deg, 3),
        "curvature": curvature,
    }


def measures_part(measures: Iterable[Measure]) -> Json:
    """Every measure by its name; the ones every document names are never missing."""
    taken = {measure.name: measure.measured for measure in measures}
    return measured_parts(taken)


def clearance_part(clearance_mm: Sequence[tuple[str, Measured]]) -> Json:
    """Every clearance by its zone; the ones every document names are never missing."""
    return measured_parts(dict(clearance_mm))


def measured_parts(taken: dict[str, Measured]) -> Json:
    """``taken`` as JSON values, completed with the names that every document has."""
    complete = dict.fromkeys(FIT_NAMES, NOT_YET) | taken
    return {name: measured_value(measured) for name, measured in complete.items()}


def sizes_part(foot_length_mm: float | None) -> Json:
    """A foot's size in every system, null where its length is not known."""
    if foot_length_mm is None:
        return dict.fromkeys(SYSTEMS)
    return {
        size.system: {
            "exact": ratio(size.exact),
            "nearest": ratio(size.nearest),
            "words": size.words,
            "beside": list(size.beside),
            "child": size.child,
            "within": size.within,
        }
        for size in foot_sizes(foot_length_mm)
    }


def profile_part(profile: FitProfile | None) -> Json | None:
    """The fit profile with every rule, or null."""
    if profile is None:
        return None
    known: Json = finite(asdict(profile))  # type: ignore[assignment]
    rules = {rule.zone: finite(asdict(rule)) for rule in profile.zones}
    for rule in rules.values():
        rule.pop("zone")  # type: ignore[attr-defined]
    return known | {"zones": rules}


def fit_part(fit: FootFit) -> Json:
    """One foot in one last, zone by zone."""
    zones: Json = {
        zone.zone: {
            "clearance": measured_value(zone.clearance),
            "unit": zone.unit,
            "target": zone.target,
            "score": ratio(zone.score),
            "verdict": zone.verdict,
            "counts": zone.counts,
        }
        for zone in fit.zones
    }
    return {"side": fit.side, "verdict": fit.verdict, "zones": zones}


def label_part(record: LastRecord) -> Json | None:
    """A last's label against its length; null where the label says no number."""
    check = label_check(record.labels.size, record.labels.size_system, record.length_mm)
    if check is None:
        return None
    return {
        "size_by_length": ratio(check.by_length),
        "off_sizes": ratio(check.off),
        "flagged": check.flagged,
        "words": label_words(check) if check.flagged else None,
    }


def finite(value: object) -> object:
    """A definition's parameters as JSON can carry them: unrounded, and finite or null.

    Examples
    --------
    >>> finite({"sd": 0.1, "limit": float("inf"), "windows": ((0.08, 0.3),)})
    {'sd': 0.1, 'limit': None, 'windows': [[0.08, 0.3]]}
    """
    if isinstance(value, dict):
        return {str(key): finite(item) for key, item in value.items()}
    if isinstance(value, tuple | list | np.ndarray):
        return [finite(item) for item in value]
    if isinstance(value, float | np.floating):
        return float(value) if math.isfinite(value) else None
    return int(value) if isinstance(value, np.integer) else value


def paper_frame_angle_deg(record: LastRecord) -> float | None:
    """How far the paper's frame is turned from footfit's, for one last; None without one."""
    if record.paper_transform is None:
        return None
    return paper_frame.paper_frame_angle_deg(
        record.paper_transform,
        record.canonical_transform,
        mirrored=record.side.side == "left",
    )


def eigenframe_part(frame: Eigenframe) -> Json:
    """The eigenvectors with their values: listed descending, and paired with the rows."""
    values = frame.eigenvalues_mm2
    return {
        "eigenvalues_mm2": nested(np.sort(values)[::-1], MILLIMETRE_DIGITS),
        "row_eigenvalues_mm2": nested(values, MILLIMETRE_DIGITS),
        "eigenvectors": nested(frame.eigenvectors, RATIO_DIGITS),
        "centroid_mm": nested(frame.centroid_mm, MILLIMETRE_DIGITS),
    }


def last_part(record: LastRecord, *, reference: str | None) -> Json:
    """One line of the library: the labels as given, the geometry as measured."""
    labels = record.labels
    return {
        "last": labels.name,
        "style": labels.style,
        "size": labels.size,
        "size_system": labels.size_system,
        "width_label": labels.width_label,
        "heel_height_mm": millimetres(labels.heel_height_mm),
        "family": labels.family,
        "parent": labels.parent,
        "side": record.side.side,
        "length_mm": millimetres(record.length_mm),
        "extent_mm": millimetres(record.extent_mm),
        "label_check": label_part(record),
        "flare_angle_deg": degrees(record.flare.angle_deg),
        "class": record.flare.flare_class,
        "reference": labels.name == reference,
    }
