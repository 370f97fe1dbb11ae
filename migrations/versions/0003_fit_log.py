"""The fit log: what wearers said of worn shoes. An entry outlives the last that it names."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Add the table."""
    op.create_table(
        "fit",
        sa.Column("number", sa.Integer, nullable=False),
        sa.Column("id", sa.String, nullable=False),
        sa.Column("recorded", sa.String, nullable=False),
        sa.Column("wearer", sa.String),
        sa.Column("last", sa.String, nullable=False),
        sa.Column("last_sha256", sa.String, nullable=False),
        sa.Column("foot_sha256", sa.String, nullable=False),
        sa.Column("side", sa.String),
        sa.Column("profile", sa.String, nullable=False),
        sa.Column("profile_version", sa.Integer, nullable=False),
        sa.Column("profile_sha256", sa.String, nullable=False),
        sa.Column("worn", sa.String, nullable=False),
        sa.Column("zones", sa.String, nullable=False),
        sa.Column("ratings", sa.String, nullable=False),
        sa.Column("comfort", sa.Float),
        sa.Column("outcome", sa.String),
        sa.Column("alteration", sa.String),
        sa.Column("hours", sa.Float),
        sa.Column("days", sa.Float),
        sa.Column("footfit_version", sa.String, nullable=False),
        sa.Column("sha256", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("number", name="pk_fit"),
        sa.UniqueConstraint("id", name="uq_fit_id"),
    )
