"""From verified rows to the values that other layers know."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from operator import itemgetter
from typing import TYPE_CHECKING

from footfit.catalogue.file.engine import LACKS
from footfit.catalogue.rows.columns import (
    FIT,
    FLARE,
    FRAME,
    LAST,
    MEASURE,
    MESH_COPY,
    NOTICE,
    PARENTAGE,
    REFERENCE,
    SECTION,
)
from footfit.catalogue.rows.digests import Row
from footfit.catalogue.rows.verified_rows import LastRows
from footfit.errors import CatalogueDamaged
from footfit.geometry.fit.stations import STATIONS, NamedSection
from footfit.geometry.flare.definition import FlareProfile
from footfit.results import (
    Eigenframe,
    LastLabels,
    LastRecord,
    Measure,
    Measured,
    MeshCopy,
    MeshInfo,
    Notice,
    Parentage,
    PoseQuality,
    Reference,
    ShapeSections,
    SideVerdict,
    Target,
)

if TYPE_CHECKING:
    from footfit.results import FitEntry, RatedZone

_labels = LAST.reader("labels", LastLabels, parent=itemgetter("parent"))
_NOT_KEPT = {"step": lambda _: 0.0, "scanner": lambda _: None}  # no column keeps them
_info = LAST.reader("info", MeshInfo, **_NOT_KEPT)
_side = LAST.reader("side", SideVerdict)
_pose = FRAME.reader("pose", PoseQuality, kind_confidence=lambda _row: None)
_eigenframe = FRAME.reader("eigenframe", Eigenframe)
printed_frame_of = FRAME.reader("printed_frame", Eigenframe)
_of_frame = FRAME.fields_reader("")
_curvature = FLARE.fields_reader("flare.curvature")
_profile = FLARE.reader("flare", FlareProfile, curvature=_curvature)
_of_flare = FLARE.fields_reader("")
_measured = MEASURE.reader("measured", Measured)
_measure = MEASURE.reader("", Measure, measured=_measured)
_notice = NOTICE.reader("", Notice, path=lambda _: None)
mesh_copy_of = MESH_COPY.reader("", MeshCopy)
_toes_outline = SECTION.fields_reader("")
_stations = {
    station.name: (
        SECTION.readers(f"sections.{station.name}"),
        f"{station.name}_points_mm",
    )
    for station in STATIONS
}
_parentage = PARENTAGE.reader(
    "", Parentage, targets=lambda row: tuple(Target(**each) for each in json.loads(row["targets"]))
)
_reference = REFERENCE.reader("", Reference, last=itemgetter("last"))


def record_of(stored: LastRows, names: Mapping[int, str]) -> LastRecord:
    """The record of a last whose rows are intact; ``names`` of all lasts, for its parent.

    Raises
    ------
    CatalogueDamaged
        The tables have lost a column: one that is null everywhere is under no hash.
    """
    last, frame, flare = stored.last, stored.frame, stored.flare
    assert frame is not None
    assert flare is not None
    try:
        parent_id = last["parent_id"]
        parent = None if parent_id is None else names[parent_id]
        return LastRecord(
            labels=_labels(last | {"parent": parent}),
            info=_info(last),
            side=_side(last),
            pose=_pose(frame),
            eigenframe=_eigenframe(frame),
            printed_frame=printed_frame_of(frame),
            flare=_profile(flare),
            measures=tuple(map(_measure, stored.measures)),
            warnings=tuple(map(_notice, stored.notices)),
            **_of_frame(frame),
            **_of_flare(flare),
        )
    except KeyError as error:
        raise CatalogueDamaged(LACKS) from error


def sections_of(row: Row) -> ShapeSections:
    """The kept sections of a last of its verified row."""
    kept = {
        name: NamedSection(**{field: read(row) for field, read in readers.items()})
        for name, (readers, column) in _stations.items()
        if row[column] is not None
    }
    return ShapeSections(kept, **_toes_outline(row))


def parentage_of(row: Row) -> Parentage:
    """How a last was made, of its verified row.

    Raises
    ------
    CatalogueDamaged
        The table has lost a column, or the row holds what no last has.
    """
    try:
        return _parentage(row)
    except (KeyError, TypeError, ValueError) as error:
        raise CatalogueDamaged(LACKS) from error


def reference_from(row: Row, name: str) -> Reference:
    """The reference of its verified row, and the name of its last."""
    return _reference(row | {"last": name})


def fit_entry_of(row: Row) -> FitEntry:
    """The entry of the fit log of its verified row.

    Raises
    ------
    CatalogueDamaged
        The table has lost a column, or the row holds what no entry has.
    """
    try:
        return _fit_reader()(row)
    except (KeyError, TypeError, ValueError) as error:
        raise CatalogueDamaged(LACKS) from error


@cache
def _fit_reader() -> Callable[[Row], FitEntry]:
    from footfit.results import FitEntry, RatedZone

    def zones(row: Row) -> tuple[RatedZone, ...]:
        return tuple(RatedZone(**zone) for zone in json.loads(row["zones"]))

    return FIT.reader("", FitEntry, zones=zones)
