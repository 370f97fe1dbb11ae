"""Lasts with their frames, flare profiles, measures, notices, mesh copies; the reference."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def _owner() -> sa.Column[int]:
    return sa.Column("last_id", sa.Integer, nullable=False)


def _dies_with_its_last(table: str) -> sa.ForeignKeyConstraint:
    return sa.ForeignKeyConstraint(
        ["last_id"], ["last.id"], name=f"fk_{table}_last_id", ondelete="CASCADE"
    )


def _last() -> None:
    op.create_table(
        "last",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("name", sa.String, nullable=False),
        sa.Column("style", sa.String),
        sa.Column("size", sa.String),
        sa.Column("size_system", sa.String),
        sa.Column("width_label", sa.String),
        sa.Column("heel_height_mm", sa.Float),
        sa.Column("family", sa.String),
        sa.Column("parent_id", sa.Integer),
        sa.Column("content_sha256", sa.String, nullable=False),
        sa.Column("file_name", sa.String),
        sa.Column("format", sa.String, nullable=False),
        sa.Column("units", sa.String, nullable=False),
        sa.Column("units_source", sa.String, nullable=False),
        sa.Column("unit_scale", sa.Float, nullable=False),
        sa.Column("vertices", sa.Integer, nullable=False),
        sa.Column("faces", sa.Integer, nullable=False),
        sa.Column("watertight", sa.Boolean, nullable=False),
        sa.Column("side", sa.String),
        sa.Column("side_confidence", sa.String, nullable=False),
        sa.Column("side_score", sa.Float, nullable=False),
        sa.Column("side_source", sa.String, nullable=False),
        sa.Column("footfit_version", sa.String, nullable=False),
        sa.Column("record_sha256", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_last"),
        sa.UniqueConstraint("name", name="uq_last_name"),
        sa.UniqueConstraint("content_sha256", name="uq_last_content_sha256"),
        sa.ForeignKeyConstraint(
            ["parent_id"], ["last.id"], name="fk_last_parent_id", ondelete="RESTRICT"
        ),
    )


def _frame() -> None:
    op.create_table(
        "frame",
        _owner(),
        sa.Column("centroid_mm", sa.LargeBinary, nullable=False),
        sa.Column("eigenvectors", sa.LargeBinary, nullable=False),
        sa.Column("eigenvalues_mm2", sa.LargeBinary, nullable=False),
        sa.Column("printed_centroid_mm", sa.LargeBinary, nullable=False),
        sa.Column("printed_eigenvectors", sa.LargeBinary, nullable=False),
        sa.Column("printed_eigenvalues_mm2", sa.LargeBinary, nullable=False),
        sa.Column("canonical_transform", sa.LargeBinary, nullable=False),
        sa.Column("paper_transform", sa.LargeBinary),
        sa.Column("pose_cost", sa.Float, nullable=False),
        sa.Column("pose_margin", sa.Float, nullable=False),
        sa.Column("pose_support", sa.Float, nullable=False),
        sa.Column("pose_sole", sa.Boolean, nullable=False),
        sa.Column("pose_kind", sa.String, nullable=False),
        sa.Column("length_mm", sa.Float, nullable=False),
        sa.PrimaryKeyConstraint("last_id", name="pk_frame"),
        _dies_with_its_last("frame"),
    )


def _flare() -> None:
    op.create_table(
        "flare",
        _owner(),
        sa.Column("angle_deg", sa.Float),
        sa.Column("angle_sd_deg", sa.Float),
        sa.Column("flare_class", sa.String, nullable=False),
        sa.Column("definition_version", sa.String, nullable=False),
        sa.Column("definition", sa.String, nullable=False),
        sa.Column("stations", sa.LargeBinary, nullable=False),
        sa.Column("heading_deg", sa.LargeBinary, nullable=False),
        sa.Column("centre_line", sa.LargeBinary, nullable=False),
        sa.Column("curvature_plan", sa.LargeBinary),
        sa.Column("curvature_bottom_20", sa.LargeBinary),
        sa.Column("curvature_bottom_50", sa.LargeBinary),
        sa.Column("curvature_bottom_80", sa.LargeBinary),
        sa.Column("curvature_bottom_surface", sa.LargeBinary),
        sa.Column("upgraded_from", sa.String),
        sa.PrimaryKeyConstraint("last_id", name="pk_flare"),
        _dies_with_its_last("flare"),
    )


def _rows() -> None:
    op.create_table(
        "measure",
        _owner(),
        sa.Column("name", sa.String, nullable=False),
        sa.Column("position", sa.Integer, nullable=False),
        sa.Column("value", sa.Float),
        sa.Column("sd", sa.Float),
        sa.Column("reason", sa.String),
        sa.Column("definition", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("last_id", "name", name="pk_measure"),
        _dies_with_its_last("measure"),
    )
    op.create_table(
        "notice",
        _owner(),
        sa.Column("position", sa.Integer, nullable=False),
        sa.Column("code", sa.String, nullable=False),
        sa.Column("message", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("last_id", "position", name="pk_notice"),
        _dies_with_its_last("notice"),
    )


def _mesh_copy_and_reference() -> None:
    op.create_table(
        "mesh_copy",
        _owner(),
        sa.Column("faces", sa.Integer, nullable=False),
        sa.Column("error_mm", sa.Float, nullable=False),
        sa.Column("data", sa.LargeBinary, nullable=False),
        sa.Column("sha256", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("last_id", name="pk_mesh_copy"),
        _dies_with_its_last("mesh_copy"),
    )
    op.create_table(
        "reference",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("last_id", sa.Integer, nullable=False),
        sa.Column("om_e", sa.LargeBinary, nullable=False),
        sa.Column("centroid_mm", sa.LargeBinary, nullable=False),
        sa.Column("sha256", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_reference"),
        sa.ForeignKeyConstraint(
            ["last_id"], ["last.id"], name="fk_reference_last_id", ondelete="RESTRICT"
        ),
        sa.CheckConstraint("id = 1", name="ck_reference_single"),
    )


def upgrade() -> None:
    _last()
    _frame()
    _flare()
    _rows()
    _mesh_copy_and_reference()
