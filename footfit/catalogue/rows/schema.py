"""The catalogue's tables, and the marks by which a file is known to be one.

Only writing and migrating import this module: reading asks SQLite itself which columns a row
has (``docs/decisions/0060-reading-without-the-orm.md``).
"""

from __future__ import annotations

from typing import ClassVar

from sqlalchemy import (
    CheckConstraint,
    Float,
    ForeignKey,
    Integer,
    LargeBinary,
    MetaData,
    UniqueConstraint,
)
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column

_NAMING = {
    "ix": "ix_%(table_name)s_%(column_0_name)s",
    "uq": "uq_%(table_name)s_%(column_0_name)s",
    "ck": "ck_%(table_name)s_%(constraint_name)s",
    "fk": "fk_%(table_name)s_%(column_0_name)s",
    "pk": "pk_%(table_name)s",
}


class Base(DeclarativeBase):
    """All tables; constraints are named, since SQLite's batch migrations need their names."""

    metadata = MetaData(naming_convention=_NAMING)
    # Said, since SQLAlchemy's own choice for float changed from FLOAT to DOUBLE in 2.1.
    type_annotation_map: ClassVar[dict[type, type]] = {bytes: LargeBinary, float: Float}


def _owner() -> Mapped[int]:
    """The key of a table that has one row per last and dies with it."""
    return mapped_column(Integer, ForeignKey("last.id", ondelete="CASCADE"), primary_key=True)


class Last(Base):
    """One last: what people say of it, what its file was, which side it is."""

    __tablename__ = "last"
    __table_args__ = (UniqueConstraint("name"), UniqueConstraint("content_sha256"))

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str]
    style: Mapped[str | None]
    size: Mapped[str | None]
    size_system: Mapped[str | None]
    width_label: Mapped[str | None]
    heel_height_mm: Mapped[float | None]
    family: Mapped[str | None]
    parent_id: Mapped[int | None] = mapped_column(ForeignKey("last.id", ondelete="RESTRICT"))
    content_sha256: Mapped[str]
    file_name: Mapped[str | None]
    format: Mapped[str]
    units: Mapped[str]
    units_source: Mapped[str]
    unit_scale: Mapped[float]
    vertices: Mapped[int]
    faces: Mapped[int]
    watertight: Mapped[bool]
    side: Mapped[str | None]
    side_confidence: Mapped[str]
    side_score: Mapped[float]
    side_source: Mapped[str]
    footfit_version: Mapped[str]
    record_sha256: Mapped[str]


class Frame(Base):
    """Where the last lies: its exact and its printed eigenframe, both transforms; blobs."""

    __tablename__ = "frame"

    last_id: Mapped[int] = _owner()
    centroid_mm: Mapped[bytes]
    eigenvectors: Mapped[bytes]
    eigenvalues_mm2: Mapped[bytes]
    printed_centroid_mm: Mapped[bytes]
    printed_eigenvectors: Mapped[bytes]
    printed_eigenvalues_mm2: Mapped[bytes]
    canonical_transform: Mapped[bytes]
    paper_transform: Mapped[bytes | None]
    pose_cost: Mapped[float]
    pose_margin: Mapped[float]
    pose_support: Mapped[float]
    pose_sole: Mapped[bool]
    pose_kind: Mapped[str]
    length_mm: Mapped[float]


class Flare(Base):
    """The flare profile with the definition it follows; a null channel was not measurable."""

    __tablename__ = "flare"

    last_id: Mapped[int] = _owner()
    angle_deg: Mapped[float | None]
    angle_sd_deg: Mapped[float | None]
    flare_class: Mapped[str]
    definition_version: Mapped[str]
    definition: Mapped[str]
    stations: Mapped[bytes]
    heading_deg: Mapped[bytes]
    centre_line: Mapped[bytes]
    curvature_plan: Mapped[bytes | None]
    curvature_bottom_20: Mapped[bytes | None]
    curvature_bottom_50: Mapped[bytes | None]
    curvature_bottom_80: Mapped[bytes | None]
    curvature_bottom_surface: Mapped[bytes | None]
    upgraded_from: Mapped[str | None]


class Measure(Base):
    """One measure of one last: a new measure is a new row, never a new column."""

    __tablename__ = "measure"

    last_id: Mapped[int] = _owner()
    name: Mapped[str] = mapped_column(primary_key=True)
    position: Mapped[int]
    value: Mapped[float | None]
    sd: Mapped[float | None]
    reason: Mapped[str | None]
    definition: Mapped[str]


class Notice(Base):
    """One warning that was given when the last was ingested."""

    __tablename__ = "notice"

    last_id: Mapped[int] = _owner()
    position: Mapped[int] = mapped_column(primary_key=True)
    code: Mapped[str]
    message: Mapped[str]


class MeshCopy(Base):
    """The last's compact mesh; a table of its own, so that ranking reads no mesh."""

    __tablename__ = "mesh_copy"

    last_id: Mapped[int] = _owner()
    faces: Mapped[int]
    error_mm: Mapped[float]
    data: Mapped[bytes]
    sha256: Mapped[str]


class Reference(Base):
    """The one reference last, OM_E (Eq. 6) and its centroid in its canonical frame."""

    __tablename__ = "reference"
    __table_args__ = (CheckConstraint("id = 1", name="single"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    last_id: Mapped[int] = mapped_column(ForeignKey("last.id", ondelete="RESTRICT"))
    om_e: Mapped[bytes]
    centroid_mm: Mapped[bytes]
    sha256: Mapped[str]
