"""How lasts stand, what is known of the trueness of measures, and the sections of each last.

Every new column may be null: the hashes of older rows stay valid, since nulls are not hashed.
``upgrade-catalogue`` fills them from the stored mesh copies.
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"

STATIONS = ("heel", "arch", "instep", "waist", "ball", "toes")


def _sections() -> None:
    kept = [
        sa.Column(f"{station}_{part}", sa.LargeBinary)
        for station in STATIONS
        for part in ("plane", "points_mm")
    ]
    op.create_table(
        "section",
        sa.Column("last_id", sa.Integer, nullable=False),
        *kept,
        sa.Column("toes_outline_mm", sa.LargeBinary),
        sa.Column("sha256", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("last_id", name="pk_section"),
        sa.ForeignKeyConstraint(
            ["last_id"], ["last.id"], name="fk_section_last_id", ondelete="CASCADE"
        ),
    )


def upgrade() -> None:
    """Add the columns and the table."""
    for name in ("toe_spring_mm", "platform_mm"):
        op.add_column("last", sa.Column(name, sa.Float))
    for name in ("total_sd", "bias"):
        op.add_column("measure", sa.Column(name, sa.Float))
    op.add_column("frame", sa.Column("standing_transform", sa.LargeBinary))
    op.add_column("frame", sa.Column("ground_sd_deg", sa.Float))
    op.add_column("frame", sa.Column("stance_by", sa.String))
    _sections()
