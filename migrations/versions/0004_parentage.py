"""Parentage: how a last was made from another one, for which foot, and by which figures."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"


def upgrade() -> None:
    """Add the table."""
    op.create_table(
        "parentage",
        sa.Column("last_id", sa.Integer, nullable=False),
        sa.Column("base", sa.String, nullable=False),
        sa.Column("base_sha256", sa.String, nullable=False),
        sa.Column("made_by", sa.String, nullable=False),
        sa.Column("foot_sha256", sa.String),
        sa.Column("profile", sa.String),
        sa.Column("profile_version", sa.Integer),
        sa.Column("profile_sha256", sa.String),
        sa.Column("rule", sa.String),
        sa.Column("figures", sa.String, nullable=False),
        sa.Column("targets", sa.String, nullable=False),
        sa.Column("sha256", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("last_id", name="pk_parentage"),
        sa.ForeignKeyConstraint(
            ["last_id"], ["last.id"], name="fk_parentage_last_id", ondelete="CASCADE"
        ),
    )
