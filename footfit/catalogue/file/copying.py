"""Whole copies of a catalogue: a copy gets its name once it is complete and on the disk."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from footfit.catalogue.file.descriptors import DESCRIPTORS
from footfit.catalogue.file.engine import connect
from footfit.errors import CatalogueNotWritable, OutputExists


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
    sync(target)


def sync(path: Path) -> None:
    """Wait until a file, or the list of names in a folder, is on the disk.

    Raises
    ------
    OSError
        The disk does not take it.
    """
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        DESCRIPTORS.close(descriptor)


def give_name(partial: Path, final: Path, *, replace: bool) -> None:
    """Give a complete file its final name, so that it also has it after a power cut.

    Raises
    ------
    OutputExists
        There is a file of that name, and it may not be replaced.
    OSError
        The system refuses.
    """
    try:
        if replace:
            partial.replace(final)
        else:  # link refuses to replace a file that was made meanwhile; rename does not
            os.link(partial, final)
    except FileExistsError as error:
        raise OutputExists("exists; add --force to replace it", str(final)) from error
    sync(final.parent)


@contextmanager
def partial_beside(final: Path) -> Iterator[Path]:
    """Make an empty file with a name of its own beside ``final``; remove it after the block.

    Raises
    ------
    CatalogueNotWritable
        The folder is missing or takes no file, or the disk is full; also in the block.
    """
    with system_errors_in_words(final):
        descriptor, name = tempfile.mkstemp(
            dir=final.parent, prefix=f".{final.name}.", suffix=".partial"
        )
        os.close(descriptor)
        partial = Path(name)
        try:
            partial.chmod(0o666 & ~_umask())
            yield partial
        finally:
            for left in (partial, partial.with_name(f"{partial.name}-journal")):
                left.unlink(missing_ok=True)


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


def _umask() -> int:
    """The process's umask; it can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
