"""Whole copies of a catalogue, named once they are complete and on the disk."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from footfit.catalogue.file.descriptors import HANDLES
from footfit.catalogue.file.engine import connected
from footfit.errors import CatalogueNotWritable, OutputExists


def copy_into(path: Path, target: Path, busy_timeout_s: float) -> None:
    """A whole, defragmented copy of one moment; ``target`` must be missing or empty.

    One read transaction: writers go on, and wait with their commit until it is done.

    Raises
    ------
    sqlite3.Error
        Where SQLite cannot read the one or write the other; see ``engine.worded``.
    """
    with closing(connected(path, "ro", busy_timeout_s)) as reader:
        reader.execute("VACUUM INTO ?", (str(target),))
    synced(target)


def synced(path: Path) -> None:
    """Wait until a file, or what a folder lists, is on the disk.

    Raises
    ------
    OSError
        The disk does not take it.
    """
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        HANDLES.close(handle)


def settled(partial: Path, final: Path, *, replace: bool) -> None:
    """Give a complete file its final name, for good: also after a power cut.

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
        else:  # link refuses a file that came meanwhile; rename does not
            os.link(partial, final)
    except FileExistsError as error:
        raise OutputExists("exists; add --force to replace it", str(final)) from error
    synced(final.parent)


@contextmanager
def partial_beside(final: Path) -> Iterator[Path]:
    """An empty file of a name of its own beside ``final``; gone with its journal afterwards.

    Raises
    ------
    CatalogueNotWritable
        The folder is not there or takes no file, or the disk is full.
    """
    with said_of(final):
        handle, name = tempfile.mkstemp(
            dir=final.parent, prefix=f".{final.name}.", suffix=".partial"
        )
        os.close(handle)
        partial = Path(name)
        try:
            partial.chmod(0o666 & ~_umask())
            yield partial
        finally:
            for left in (partial, partial.with_name(f"{partial.name}-journal")):
                left.unlink(missing_ok=True)


@contextmanager
def said_of(path: Path) -> Iterator[None]:
    """Say the system's refusals in footfit's words, naming ``path``.

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
    """The process's umask, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
