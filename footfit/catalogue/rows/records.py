"""From verified rows to the values that other layers know."""

from __future__ import annotations

import math
from collections.abc import Mapping

from footfit.catalogue.file.engine import LACKS
from footfit.catalogue.rows.array_blobs import array_of, definition_of
from footfit.catalogue.rows.verified_rows import Fields, StoredLast
from footfit.errors import CatalogueDamaged
from footfit.geometry.flare.flare_profile import CHANNELS, FlareProfile
from footfit.results import (
    Eigenframe,
    LastLabels,
    LastRecord,
    Measure,
    Measured,
    MeshCopy,
    MeshInfo,
    Notice,
    PoseQuality,
    SideVerdict,
)


def record_of(stored: StoredLast, names: Mapping[int, str]) -> LastRecord:
    """The record of a last whose rows are intact; ``names`` of all lasts, for its parent.

    Raises
    ------
    CatalogueDamaged
        The tables have lost a column: one that is null everywhere is under no hash.
    """
    try:
        return _record(stored, names)
    except KeyError as error:
        raise CatalogueDamaged(LACKS) from error


def _record(stored: StoredLast, names: Mapping[int, str]) -> LastRecord:
    last, frame, flare = stored.last, stored.frame, stored.flare
    assert frame is not None
    assert flare is not None
    return LastRecord(
        labels=_labels(last, names),
        info=_mesh_info(last),
        side=SideVerdict(
            side=last["side"],
            confidence=last["side_confidence"],
            score=last["side_score"],
            source=last["side_source"],
        ),
        pose=_pose(frame),
        eigenframe=eigenframe_of(frame),
        printed_frame=printed_frame_of(frame),
        canonical_transform=array_of(frame["canonical_transform"], 4, 4),
        paper_transform=(
            None if frame["paper_transform"] is None else array_of(frame["paper_transform"], 4, 4)
        ),
        extent_mm=frame["length_mm"],
        flare=_profile(flare),
        measures=tuple(_measure(row) for row in stored.measures),
        warnings=tuple(Notice(row["code"], row["message"]) for row in stored.notices),
        upgraded_from=flare["upgraded_from"],
    )


def definition_of_rows(stored: StoredLast) -> str:
    """The text of the definition that a last's profile follows."""
    return str(stored.flare["definition"]) if stored.flare else ""


def eigenframe_of(frame: Fields) -> Eigenframe:
    """The frame of the exact moments of a ``frame`` row."""
    return Eigenframe(
        centroid_mm=array_of(frame["centroid_mm"]),
        eigenvectors=array_of(frame["eigenvectors"], 3, 3),
        eigenvalues_mm2=array_of(frame["eigenvalues_mm2"]),
    )


def printed_frame_of(frame: Fields) -> Eigenframe:
    """The frame by Eq. 1-4 as printed of a ``frame`` row."""
    return Eigenframe(
        centroid_mm=array_of(frame["printed_centroid_mm"]),
        eigenvectors=array_of(frame["printed_eigenvectors"], 3, 3),
        eigenvalues_mm2=array_of(frame["printed_eigenvalues_mm2"]),
    )


def mesh_copy_of(row: Fields) -> MeshCopy:
    """The mesh copy of its verified row."""
    return MeshCopy(data=row["data"], faces=row["faces"], error_mm=row["error_mm"])


def _labels(last: Fields, names: Mapping[int, str]) -> LastLabels:
    return LastLabels(
        name=last["name"],
        style=last["style"],
        size=last["size"],
        size_system=last["size_system"],
        width_label=last["width_label"],
        heel_height_mm=last["heel_height_mm"],
        family=last["family"],
        parent=None if last["parent_id"] is None else names[last["parent_id"]],
    )


def _mesh_info(last: Fields) -> MeshInfo:
    return MeshInfo(
        path=last["file_name"],
        sha256=last["content_sha256"],
        format=last["format"],
        vertices=last["vertices"],
        faces=last["faces"],
        watertight=bool(last["watertight"]),
        units=last["units"],
        units_source=last["units_source"],
        unit_scale=last["unit_scale"],
    )


def _pose(frame: Fields) -> PoseQuality:
    return PoseQuality(
        cost=frame["pose_cost"],
        margin=frame["pose_margin"],
        support=frame["pose_support"],
        sole=bool(frame["pose_sole"]),
        kind=frame["pose_kind"],
    )


def _profile(flare: Fields) -> FlareProfile:
    channels = {name: flare[f"curvature_{name}"] for name in CHANNELS}
    return FlareProfile(
        definition=definition_of(flare["definition"]),
        angle_deg=_number(flare["angle_deg"]),
        angle_sd_deg=_number(flare["angle_sd_deg"]),
        flare_class=flare["flare_class"],
        stations=array_of(flare["stations"]),
        heading_deg=array_of(flare["heading_deg"]),
        curvature={
            name: None if data is None else array_of(data) for name, data in channels.items()
        },
        centre_line=array_of(flare["centre_line"], -1, 2),
    )


def _number(value: float | None) -> float:
    """SQLite keeps NaN as null."""
    return math.nan if value is None else value


def _measure(row: Fields) -> Measure:
    measured = Measured(value=row["value"], sd=row["sd"], reason=row["reason"])
    return Measure(name=row["name"], measured=measured, definition=row["definition"])
