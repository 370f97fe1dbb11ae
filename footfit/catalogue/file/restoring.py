"""Put a whole catalogue in the place of another one, which is kept.

This uses SQLite's own locks and journal, and does not move files about. So a program that has
the old catalogue open goes on with the new one, a journal of the old one cannot be played into
the new one, and a kill or a power cut leaves the old one or the new one.
"""

from __future__ import annotations

import shutil
import sqlite3
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import BinaryIO

from footfit.catalogue.file.copying import partial_beside, system_errors_in_words
from footfit.catalogue.file.descriptors import byte_reader
from footfit.catalogue.file.engine import (
    HELD,
    connect,
    connect_for_reading,
    sqlite_errors_in_words,
)
from footfit.catalogue.file.file_signature import NOT_A_CATALOGUE
from footfit.catalogue.file.migrate import Schema, stored_revision
from footfit.catalogue.file.opening import recovered_kind
from footfit.errors import CatalogueDamaged, CatalogueLocked, NewerCatalogue, NotACatalogue
from footfit.whole_files import give_name, sync

KEPT = "before-restore"
MOVE_AWAY = "move the file away, then try again"
PAGES_PER_STEP = 1
"""The first step takes the lock and is not the last one, since no catalogue has a single page.
With more pages a step, a small catalogue would be overwritten before the old one is kept.
"""


def put_in_place(whole: Path, path: Path, busy_timeout_s: float) -> Path | None:
    """Make ``path`` what ``whole`` is; return where the old one lies, None if there was none.

    ``whole`` is a verified catalogue beside ``path``; it may lose its name.

    Raises
    ------
    NotACatalogue
        What lies there is not a catalogue and is left as it is.
    NewerCatalogue
        A later footfit made it, and this one cannot judge its lasts; it is left as it is.
    CatalogueLocked, CatalogueNotWritable
        Another program holds it; the folder or the disk takes no write.
    """
    try:
        with sqlite_errors_in_words(path):
            kind = recovered_kind(path, busy_timeout_s)
    except NotACatalogue as error:
        raise NotACatalogue(f"{NOT_A_CATALOGUE}; {MOVE_AWAY}", str(path)) from error
    if kind == "catalogue":
        _refuse_newer(path, busy_timeout_s)
    with system_errors_in_words(path):
        if kind in ("missing", "empty"):
            give_name(whole, path, replace=kind == "empty")
            return None
        kept = _free_name(path)
        try:
            _overwrite(whole, path, kept, busy_timeout_s)
        except (CatalogueDamaged, NotACatalogue):  # no program can have it open
            _set_aside(path, kept)
            give_name(whole, path, replace=False)
        return kept


def _refuse_newer(path: Path, busy_timeout_s: float) -> None:
    try:
        with (
            sqlite_errors_in_words(path),
            closing(connect_for_reading(path, busy_timeout_s)) as connection,
        ):
            stored_revision(connection, Schema(), path)
    except (CatalogueDamaged, NotACatalogue):
        return  # a restore is what it needs
    except NewerCatalogue as error:
        raise NewerCatalogue(f"{error.message}, or {MOVE_AWAY}", str(path)) from error


def _free_name(path: Path) -> Path:
    """``NAME.before-restore``, with a number if it is taken: no kept file is overwritten."""
    numbers = (f".{count}" for count in range(2, 10_000))
    for tail in ("", *numbers):
        name = path.with_name(f"{path.name}.{KEPT}{tail}")
        if not name.exists():
            return name
    raise FileExistsError(0, "too many kept catalogues", str(path))


def _overwrite(whole: Path, path: Path, kept: Path, busy_timeout_s: float) -> None:
    """Write every page of ``whole`` over the catalogue in one transaction.

    The old file is opened by way of `byte_reader`: closed in the usual way, it would take
    SQLite's locks with it.
    """
    with (
        byte_reader(path) as old,
        sqlite_errors_in_words(path),
        closing(connect(whole, "ro")) as source,
        closing(connect(path, "rw", busy_timeout_s)) as target,
    ):
        keep = _keeper(old, kept, busy_timeout_s)
        source.backup(target, pages=PAGES_PER_STEP, progress=keep, sleep=0.02)


def _keeper(old: BinaryIO, kept: Path, busy_timeout_s: float) -> Callable[[int, int, int], None]:
    """A function to call after each step: it keeps the old file once the lock is taken, and
    ends the wait for the lock.
    """
    deadline = time.monotonic() + busy_timeout_s
    done = False

    def keep(status: int, _remaining: int, _total: int) -> None:
        nonlocal done
        if status in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
            if time.monotonic() > deadline:
                raise CatalogueLocked(HELD)
        elif not done:
            _write_copy(old, kept)
            done = True

    return keep


def _write_copy(old: BinaryIO, kept: Path) -> None:
    """Put the bytes of the old file on the disk, damage and all, before the file is changed."""
    old.seek(0)
    with partial_beside(kept) as partial:
        with partial.open("wb") as file:
            shutil.copyfileobj(old, file)
        sync(partial)
        give_name(partial, kept, replace=True)


def _set_aside(path: Path, kept: Path) -> None:
    """Move a file away with its journal, which belongs to that file alone."""
    for tail in ("-journal", ""):
        part = path.with_name(path.name + tail)
        if part.exists():
            part.rename(kept.with_name(kept.name + tail))
    sync(path.parent)
