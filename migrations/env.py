"""Alembic's environment: runs on the connection that footfit hands over, inside its transaction.

footfit.catalogue.file.migrate opens the file, sends BEGIN IMMEDIATE and commits: a kill at any
moment leaves the old schema or the new one, never half of it.
"""

from __future__ import annotations

from alembic import context

from footfit.catalogue.rows.schema import METADATA

connection = context.config.attributes.get("connection")
if connection is None:
    raise SystemExit("migrations run through footfit (see docs/catalogue.md), not by themselves")

context.configure(
    connection=connection,
    target_metadata=METADATA,
    render_as_batch=True,
    transactional_ddl=True,
)
with context.begin_transaction():
    context.run_migrations()
