"""The reference last: every stored ``paper_transform`` is computed with its OM_E (Eq. 6).

Everything here works on stored values: no mesh is needed to change the reference.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from footfit.catalogue.file.dialect import driver_of
from footfit.catalogue.rows.array_blobs import blob
from footfit.catalogue.rows.columns import FRAME, REFERENCE
from footfit.catalogue.rows.records import printed_frame_of, record_of, reference_from
from footfit.catalogue.rows.verified_rows import (
    last_names,
    row_digest,
    rows,
    shown_name,
    stored_lasts,
)
from footfit.catalogue.rows.writing import seal, update_row, write_reference
from footfit.errors import CatalogueDamaged
from footfit.geometry.pose.paper_frame import (
    canonical_centroid_mm,
    mirrored_frame,
    om_e,
    paper_transform,
)
from footfit.results import Reference

if TYPE_CHECKING:
    import sqlalchemy as sa

    from footfit.catalogue.file.dialect import Driver
    from footfit.catalogue.rows.verified_rows import LastRows
    from footfit.geometry.numeric.arrays import Floats
    from footfit.results import LastRecord


def stored_reference(connection: Driver) -> tuple[int, Reference] | None:
    """The reference and its last's key; None in an empty catalogue.

    Raises
    ------
    CatalogueDamaged
        Its row is not what was stored.
    """
    single = rows(connection, REFERENCE)
    if not single:
        return None
    row = single[0]
    select = "SELECT name FROM last NOT INDEXED WHERE id = ?"
    names = connection.execute(select, (row["last_id"],)).fetchall()
    if not names or row.get("sha256") != row_digest(REFERENCE, row):
        raise CatalogueDamaged(
            "has a damaged reference; type: footfit set-reference LAST, which makes it anew"
        )
    return row["last_id"], reference_from(row, shown_name(names[0][0]))


def reference_of(record: LastRecord) -> Reference:
    """What a last would be as the reference; a left last is mirrored to a right one first."""
    mirrored = record.side.side == "left"
    printed, canonical = record.printed_frame, record.canonical_transform
    return Reference(
        last=record.labels.name,
        om_e=om_e(printed.eigenvectors, canonical, mirrored=mirrored),  # Eq. 6
        centroid_mm=canonical_centroid_mm(
            printed.centroid_mm, canonical, record.info.unit_scale, mirrored=mirrored
        ),
    )


def transform_by(reference: Reference, stored: LastRows) -> Floats:
    """A last's ``paper_transform`` (4, 4) to the frame of a reference (Eq. 8).

    It needs few columns, so that a catalogue of an older schema can be checked too.
    """
    assert stored.frame is not None
    printed, scale = printed_frame_of(stored.frame), stored.last["unit_scale"]
    P_c, R = printed.centroid_mm, printed.eigenvectors
    if stored.last["side"] == "left":
        P_c, R = mirrored_frame(P_c, R)
    return paper_transform(P_c, R, reference.om_e, reference.centroid_mm, scale)


def expressed(record: LastRecord, reference: Reference) -> Floats:
    """The ``paper_transform`` (4, 4) of a record to the frame of a reference (Eq. 8)."""
    P_c, R = record.printed_frame.centroid_mm, record.printed_frame.eigenvectors
    if record.side.side == "left":
        P_c, R = mirrored_frame(P_c, R)
    return paper_transform(P_c, R, reference.om_e, reference.centroid_mm, record.info.unit_scale)


def express(connection: sa.Connection, key: int) -> None:
    """Seal a last that was just written, with its ``paper_transform``; the first last of a
    catalogue becomes the reference.
    """
    driver = driver_of(connection)
    reference = stored_reference(driver)
    if reference is None or reference[0] == key:
        seal(connection, key)
        make_reference(connection, key)
        return
    (stored,) = stored_lasts(driver, key)
    _write_transform(connection, stored, reference[1])


def make_reference(connection: sa.Connection, key: int) -> Reference:
    """Make a last the reference, and rewrite every last's ``paper_transform``.

    Raises
    ------
    CatalogueDamaged
        A last is damaged: a new seal would make the damage look sound.
    """
    driver = driver_of(connection)
    lasts = stored_lasts(driver)
    _require_intact(lasts)
    (chosen,) = (stored for stored in lasts if stored.id == key)
    reference = reference_of(record_of(chosen, last_names(driver)))
    write_reference(connection, key, reference)
    for stored in lasts:
        _write_transform(connection, stored, reference)
    return reference


def _require_intact(lasts: list[LastRows]) -> None:
    damaged = [stored.name for stored in lasts if not stored.intact]
    if damaged:
        raise CatalogueDamaged(
            f"has damaged lasts ({', '.join(map(repr, damaged))}); remove them or ingest them"
            " again with --replace first"
        )


def _write_transform(connection: sa.Connection, stored: LastRows, reference: Reference) -> None:
    """Write a last's ``paper_transform``, and seal the last."""
    transform = blob(transform_by(reference, stored))
    update_row(connection, FRAME, stored.id, {"paper_transform": transform})
    seal(connection, stored.id)
