"""Later schemas for tests: the released migrations and three more, each of another kind."""

from __future__ import annotations

import atexit
import shutil
import tempfile
from functools import lru_cache
from pathlib import Path

from footfit.catalogue.file.migrate import Schema, migrations_folder

DATA = Path(__file__).resolve().parents[1] / "data"
OLD_FILES = tuple(sorted(DATA.glob("catalogue-*.footfit")))
"""A catalogue of four lasts as each released schema has it (``old_file.py``)."""
OLD_FILE = OLD_FILES[0]
HEAD = Schema().head

_BODIES = (
    """
    with op.batch_alter_table("last", recreate="always") as batch:
        batch.add_column(sa.Column("colour", sa.String))
""",
    """
    op.create_table(
        "shelf",
        sa.Column("last_id", sa.Integer, sa.ForeignKey("last.id", name="fk_shelf_last_id")),
        sa.Column("place", sa.String),
    )
    op.execute("INSERT INTO shelf SELECT id, 'shelf ' || name FROM last")
""",
    """
    with op.batch_alter_table("frame", recreate="always") as batch:
        batch.add_column(sa.Column("seat_mm", sa.Float))
    op.create_index("ix_shelf_place", "shelf", ["place"])
""",
)
_SCRIPT = """
import sqlalchemy as sa
from alembic import op

revision = {revision!r}
down_revision = {down!r}


def upgrade():
    {body}
"""


@lru_cache(maxsize=1)
def later_schema() -> Schema:
    """The schema three revisions on, in a copy of the migrations that lives as long as this run."""
    folder = Path(tempfile.mkdtemp(prefix="footfit-migrations-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return schema_in(folder / "migrations")


def schema_in(folder: Path) -> Schema:
    """The same in a folder of one's own."""
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(migrations_folder(), folder, ignore=ignored)
    revisions = list(Schema().revisions)
    for body in _BODIES:
        down, revision = revisions[-1], f"{int(revisions[-1]) + 1:04d}"
        text = _SCRIPT.format(revision=revision, down=down, body=body.strip())
        (folder / "versions" / f"{revision}_later.py").write_text(text)
        revisions.append(revision)
    return Schema(tuple(revisions), folder)
