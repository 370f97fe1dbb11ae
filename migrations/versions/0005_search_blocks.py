"""Search blocks: what ranking reads of the lasts, packed. footfit fills them after migrating."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Add the table."""
    op.create_table(
        "search_block",
        sa.Column("block", sa.Integer, nullable=False),
        sa.Column("part", sa.String, nullable=False),
        sa.Column("layout", sa.String, nullable=False),
        sa.Column("data", sa.LargeBinary, nullable=False),
        sa.Column("hash", sa.String, nullable=False),
        sa.PrimaryKeyConstraint("block", "part", name="pk_search_block"),
    )
