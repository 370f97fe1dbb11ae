"""Whole copies of a catalogue, and the system's errors in footfit's words."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from footfit import whole_files
from footfit.catalogue.file.engine import connect
from footfit.errors import CatalogueNotWritable


def copy_into(path: Path, target: Path, busy_timeout_s: float) -> None:
    """Write a whole, defragmented copy of one moment; ``target`` must be missing or empty.

    The copy is made in one read transaction: other programs can go on writing, and their
    commits wait until the copy is done.

    Raises
    ------
    sqlite3.Error
        SQLite cannot read the one or write the other; see ``engine.sqlite_errors_in_words``.
    """
    with closing(connect(path, "ro", busy_timeout_s)) as reader:
        reader.execute("VACUUM INTO ?", (str(target),))
    whole_files.sync(target)


@contextmanager
def partial_beside(final: Path) -> Iterator[Path]:
    """`whole_files.partial_beside` for a catalogue.

    Raises
    ------
    CatalogueNotWritable
        The folder is missing or takes no file, or the disk is full; also in the block.
    """
    with system_errors_in_words(final), whole_files.partial_beside(final) as partial:
        yield partial


@contextmanager
def system_errors_in_words(path: Path) -> Iterator[None]:
    """Turn the operating system's errors into footfit's, naming ``path``.

    Raises
    ------
    CatalogueNotWritable
        In place of every OSError of the block.
    """
    try:
        yield
    except OSError as error:
        words = f"could not be written ({error.strerror}); nothing was changed"
        raise CatalogueNotWritable(words, str(path)) from error
