"""From records to the catalogue's rows, and the hashes that seal them."""

from __future__ import annotations

import math
import sqlite3
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from sqlalchemy import delete, insert, update

from footfit import __version__
from footfit.catalogue.rows import schema
from footfit.catalogue.rows.array_blobs import blob, definition_text
from footfit.catalogue.rows.verified_rows import Fields, hashed_row, rows, stored_lasts
from footfit.geometry.flare.flare_profile import CHANNELS, FlareProfile
from footfit.results import LastRecord, Measure, MeshCopy, Notice

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sqlalchemy.orm import Session

_CHILDREN = (schema.Frame, schema.Flare, schema.Measure, schema.Notice, schema.MeshCopy)


def driver_of(session: Session) -> sqlite3.Connection:
    """The driver's connection under a session, inside the same transaction."""
    connection: Any = session.connection().connection.driver_connection
    assert isinstance(connection, sqlite3.Connection)
    return connection


def insert_last(
    session: Session, record: LastRecord, copy: MeshCopy | None, parent_id: int | None
) -> int:
    """Write every row of a new last, not yet sealed; return its key."""
    values = _last_fields(record, parent_id)
    added = session.execute(insert(schema.Last).returning(schema.Last.id), [values])
    key = added.scalar_one()
    _insert_children(session, key, record, copy)
    return key


def overwrite_last(
    session: Session, key: int, record: LastRecord, copy: MeshCopy | None, parent_id: int | None
) -> None:
    """Write every row of a last anew, not yet sealed; its key stays, for those that name it."""
    for table in _CHILDREN:
        session.execute(delete(table).where(table.last_id == key))
    values = _last_fields(record, parent_id)
    session.execute(update(schema.Last).where(schema.Last.id == key).values(**values))
    _insert_children(session, key, record, copy)


def overwrite_flare(
    session: Session,
    key: int,
    flare: FlareProfile,
    measures: Sequence[Measure] | None,
    upgraded_from: str | None,
) -> None:
    """Write a last's profile anew, and its measures where some are given; not yet sealed."""
    session.execute(delete(schema.Flare).where(schema.Flare.last_id == key))
    session.execute(insert(schema.Flare), [_flare_fields(key, flare, upgraded_from)])
    if measures is not None:
        session.execute(delete(schema.Measure).where(schema.Measure.last_id == key))
        _insert_all(session, schema.Measure, _measure_fields(key, measures))


def seal(session: Session, key: int) -> None:
    """Store the hash of a last's rows as SQLite now gives them back.

    Of what is read back, not of what was sent: SQLite keeps -0.0 as 0.0, for one.
    """
    (stored,) = stored_lasts(driver_of(session), key)
    values = {"record_sha256": stored.content_digest}
    session.execute(update(schema.Last).where(schema.Last.id == key).values(**values))


def seal_row(session: Session, table: type[schema.MeshCopy | schema.Reference], key: int) -> None:
    """Store the hash of the row that ``table`` has for one last."""
    (row,) = rows(driver_of(session), table.__tablename__, key)
    session.execute(update(table).where(table.last_id == key).values(sha256=hashed_row(row)))


def _insert_children(session: Session, key: int, record: LastRecord, copy: MeshCopy | None) -> None:
    session.execute(insert(schema.Frame), [_frame_fields(key, record)])
    session.execute(insert(schema.Flare), [_flare_fields(key, record.flare, record.upgraded_from)])
    _insert_all(session, schema.Measure, _measure_fields(key, record.measures))
    _insert_all(session, schema.Notice, _notice_fields(key, record.warnings))
    if copy is not None:
        session.execute(insert(schema.MeshCopy), [_copy_fields(key, copy)])
        seal_row(session, schema.MeshCopy, key)


def _insert_all(session: Session, table: type[schema.Base], values: list[Fields]) -> None:
    if values:
        session.execute(insert(table), values)


def _text(value: str | None) -> str | None:
    """Text that UTF-8 can hold: a file name may be made of any bytes."""
    return None if value is None else value.encode("utf-8", "backslashreplace").decode("utf-8")


def _last_fields(record: LastRecord, parent_id: int | None) -> Fields:
    labels, info, side = record.labels, record.info, record.side
    heel = labels.heel_height_mm
    return {
        "name": labels.name,
        "style": _text(labels.style),
        "size": _text(labels.size),
        "size_system": _text(labels.size_system),
        "width_label": _text(labels.width_label),
        "heel_height_mm": None if heel is None else float(heel),
        "family": _text(labels.family),
        "parent_id": parent_id,
        "content_sha256": info.sha256,
        "file_name": None if info.path is None else _text(PurePath(info.path).name),
        "format": info.format,
        "units": info.units,
        "units_source": info.units_source,
        "unit_scale": float(info.unit_scale),
        "vertices": int(info.vertices),
        "faces": int(info.faces),
        "watertight": bool(info.watertight),
        "side": side.side,
        "side_confidence": side.confidence,
        "side_score": float(side.score),
        "side_source": side.source,
        "footfit_version": __version__,
        "record_sha256": "",
    }


def _frame_fields(key: int, record: LastRecord) -> Fields:
    frame, printed, pose = record.eigenframe, record.printed_frame, record.pose
    return {
        "last_id": key,
        "centroid_mm": blob(frame.centroid_mm),
        "eigenvectors": blob(frame.eigenvectors),
        "eigenvalues_mm2": blob(frame.eigenvalues_mm2),
        "printed_centroid_mm": blob(printed.centroid_mm),
        "printed_eigenvectors": blob(printed.eigenvectors),
        "printed_eigenvalues_mm2": blob(printed.eigenvalues_mm2),
        "canonical_transform": blob(record.canonical_transform),
        "paper_transform": None,
        "pose_cost": float(pose.cost),
        "pose_margin": float(pose.margin),
        "pose_support": float(pose.support),
        "pose_sole": bool(pose.sole),
        "pose_kind": pose.kind,
        "length_mm": float(record.extent_mm),
    }


def _flare_fields(key: int, flare: FlareProfile, upgraded_from: str | None) -> Fields:
    channels = {name: flare.curvature.get(name) for name in CHANNELS}
    return {
        "last_id": key,
        "angle_deg": _number(flare.angle_deg),
        "angle_sd_deg": _number(flare.angle_sd_deg),
        "flare_class": flare.flare_class,
        "definition_version": flare.definition.version,
        "definition": definition_text(flare.definition),
        "stations": blob(flare.stations),
        "heading_deg": blob(flare.heading_deg),
        "centre_line": blob(flare.centre_line),
        **{
            f"curvature_{name}": None if values is None else blob(values)
            for name, values in channels.items()
        },
        "upgraded_from": upgraded_from,
    }


def _measure_fields(key: int, measures: Sequence[Measure]) -> list[Fields]:
    return [
        {
            "last_id": key,
            "name": measure.name,
            "position": position,
            "value": _number(measure.measured.value),
            "sd": _number(measure.measured.sd),
            "reason": _text(measure.measured.reason),
            "definition": measure.definition,
        }
        for position, measure in enumerate(measures)
    ]


def _notice_fields(key: int, notices: Sequence[Notice]) -> list[Fields]:
    return [
        {
            "last_id": key,
            "position": position,
            "code": notice.code,
            "message": _text(notice.message),
        }
        for position, notice in enumerate(notices)
    ]


def _copy_fields(key: int, copy: MeshCopy) -> Fields:
    return {
        "last_id": key,
        "faces": int(copy.faces),
        "error_mm": float(copy.error_mm),
        "data": copy.data,
        "sha256": "",
    }


def _number(value: float | None) -> float | None:
    """SQLite has no NaN: it keeps one as null, and so do we, by name."""
    return None if value is None or math.isnan(value) else float(value)
