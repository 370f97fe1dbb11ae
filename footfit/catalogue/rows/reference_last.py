"""The reference last: whose OM_E (Eq. 6) every stored ``paper_transform`` is expressed by.

All of it works on stored values: no mesh is needed to change the reference.
"""

from __future__ import annotations

import sqlite3
from typing import TYPE_CHECKING

from footfit.catalogue.rows.array_blobs import array_of, blob
from footfit.catalogue.rows.records import printed_frame_of
from footfit.catalogue.rows.verified_rows import (
    Fields,
    StoredLast,
    hashed_row,
    last_names,
    rows,
    stored_lasts,
)
from footfit.errors import CatalogueDamaged
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.pose.paper_frame import (
    canonical_centroid_mm,
    mirrored_frame,
    om_e,
    paper_transform,
)
from footfit.results import Reference

if TYPE_CHECKING:
    from sqlalchemy.orm import Session


def stored_reference(connection: sqlite3.Connection) -> tuple[int, Reference] | None:
    """The reference and its last's key; None in an empty catalogue.

    Raises
    ------
    CatalogueDamaged
        Its row is not what was stored.
    """
    found = rows(connection, "reference")
    if not found:
        return None
    row = found[0]
    name = last_names(connection).get(row["last_id"])
    if name is None or row.get("sha256") != hashed_row(row):
        raise CatalogueDamaged(
            "has a damaged reference; type: footfit set-reference LAST, which makes it anew"
        )
    return row["last_id"], Reference(
        name, array_of(row["om_e"], 3, 3), array_of(row["centroid_mm"])
    )


def reference_id(connection: sqlite3.Connection) -> int | None:
    """The key of the reference last, whatever the state of its OM_E."""
    row = connection.execute("SELECT last_id FROM reference").fetchone()
    return None if row is None else int(row[0])


def reference_of(stored: StoredLast) -> Reference:
    """What a last would be as the reference; a left one is mirrored to a right one first."""
    frame, mirrored = _frame(stored), stored.last["side"] == "left"
    printed = printed_frame_of(frame)
    canonical = array_of(frame["canonical_transform"], 4, 4)
    return Reference(
        last=stored.last["name"],
        om_e=om_e(printed.eigenvectors, canonical, mirrored=mirrored),  # Eq. 6
        centroid_mm=canonical_centroid_mm(
            printed.centroid_mm, canonical, stored.last["unit_scale"], mirrored=mirrored
        ),
    )


def expressed(stored: StoredLast, reference: Reference) -> Floats:
    """A last's ``paper_transform`` (4, 4) by a reference (Eq. 8), from stored values only."""
    printed = printed_frame_of(_frame(stored))
    P_c, R = printed.centroid_mm, printed.eigenvectors
    if stored.last["side"] == "left":
        P_c, R = mirrored_frame(P_c, R)
    scale = stored.last["unit_scale"]
    return paper_transform(P_c, R, reference.om_e, reference.centroid_mm, scale)


def _frame(stored: StoredLast) -> Fields:
    assert stored.frame is not None
    return stored.frame


def express_new(session: Session, key: int) -> None:
    """Express a last that was just written, and seal it; the first one becomes the reference."""
    from footfit.catalogue.rows.writing import driver_of, seal

    connection = driver_of(session)
    (stored,) = stored_lasts(connection, key)
    found = stored_reference(connection)
    if found is None or found[0] == key:
        seal(session, key)
        make_reference(session, key)
        return
    _write_transform(session, stored, found[1])
    seal(session, key)


def make_reference(session: Session, key: int) -> Reference:
    """Make a last the reference and express every last by it, in the caller's transaction.

    Raises
    ------
    CatalogueDamaged
        A last is damaged: sealing it anew would call the damage sound.
    """
    from sqlalchemy import delete, insert

    from footfit.catalogue.rows import schema
    from footfit.catalogue.rows.writing import driver_of, seal, seal_row

    lasts = stored_lasts(driver_of(session))
    _require_intact(lasts)
    (chosen,) = (stored for stored in lasts if stored.id == key)
    reference = reference_of(chosen)
    values = {"id": 1, "last_id": key, "sha256": ""}
    arrays = {"om_e": blob(reference.om_e), "centroid_mm": blob(reference.centroid_mm)}
    session.execute(delete(schema.Reference))
    session.execute(insert(schema.Reference), [values | arrays])
    seal_row(session, schema.Reference, key)
    for stored in lasts:
        _write_transform(session, stored, reference)
        seal(session, stored.id)
    return reference


def _require_intact(lasts: list[StoredLast]) -> None:
    damaged = [stored.name for stored in lasts if not stored.intact]
    if damaged:
        raise CatalogueDamaged(
            f"has damaged lasts ({', '.join(map(repr, damaged))}); remove them or ingest them"
            " again with --replace first"
        )


def _write_transform(session: Session, stored: StoredLast, reference: Reference) -> None:
    from sqlalchemy import update

    from footfit.catalogue.rows.schema import Frame

    values = {"paper_transform": blob(expressed(stored, reference))}
    session.execute(update(Frame).where(Frame.last_id == stored.id).values(**values))
