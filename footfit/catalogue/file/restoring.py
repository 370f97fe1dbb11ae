"""Put a whole catalogue in the place of another, which is kept.

Under SQLite's own locks and journal, not by moving files about: a program that has the old
catalogue open goes on with the new one, a journal of the old one cannot be played into the new
one, and a kill or a power cut leaves the old or the new one.
"""

from __future__ import annotations

import os
import sqlite3
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import BinaryIO

from footfit.catalogue.file.copying import said_of, settled, synced
from footfit.catalogue.file.descriptors import opened
from footfit.catalogue.file.engine import connected, connected_for_reading, worded
from footfit.catalogue.file.migrate import Schema, stored_revision
from footfit.catalogue.file.opening import settled_kind
from footfit.errors import CatalogueDamaged, CatalogueLocked, NewerCatalogue, NotACatalogue

KEPT = "before-restore"
PAGES_PER_STEP = 1
"""The first step takes the lock and is not the last one: no catalogue has a single page. With more
pages a step, a small catalogue would be written over before anybody is asked to keep it.
"""


def put_in_place(whole: Path, path: Path, busy_timeout_s: float) -> Path | None:
    """Make ``path`` what ``whole`` is; return where the old one lies, None if there was none.

    ``whole`` is a verified catalogue beside ``path``; its name may be taken.

    Raises
    ------
    NotACatalogue
        What lies there is no catalogue and is left as it is.
    NewerCatalogue
        A later footfit's lies there, whose lasts this one cannot judge; it is left as it is.
    CatalogueLocked, CatalogueNotWritable
        Another program holds it; the folder or the disk takes no write.
    """
    try:
        with worded(path):
            kind = settled_kind(path, busy_timeout_s)
    except NotACatalogue as error:
        words = "is not a footfit catalogue and was left as it is; move it away, then try again"
        raise NotACatalogue(words, str(path)) from error
    if kind == "catalogue":
        _refuse_newer(path, busy_timeout_s)
    with said_of(path):
        if kind in ("missing", "empty"):
            settled(whole, path, replace=kind == "empty")
            return None
        kept = _free_name(path)
        try:
            _overwritten(whole, path, kept, busy_timeout_s)
        except (CatalogueDamaged, NotACatalogue):  # no program can have it open
            _moved(path, kept)
            settled(whole, path, replace=False)
        return kept


def _refuse_newer(path: Path, busy_timeout_s: float) -> None:
    try:
        with worded(path), closing(connected_for_reading(path, busy_timeout_s)) as connection:
            stored_revision(connection, Schema(), path)
    except (CatalogueDamaged, NotACatalogue):
        return  # a restore is what it needs
    except NewerCatalogue as error:
        words = f"{error.message}, or move the file away, then try again"
        raise NewerCatalogue(words, str(path)) from error


def _free_name(path: Path) -> Path:
    """``NAME.before-restore``, with a number where there is one: no kept file is written over."""
    numbered = (f".{count}" for count in range(2, 10_000))
    for tail in ("", *numbered):
        name = path.with_name(f"{path.name}.{KEPT}{tail}")
        if not name.exists():
            return name
    raise FileExistsError(0, "too many kept catalogues", str(path))


def _overwritten(whole: Path, path: Path, kept: Path, busy_timeout_s: float) -> None:
    """Write every page of ``whole`` over the catalogue in one transaction.

    The old file is opened beside SQLite, which would lose its locks were it closed just so.
    """
    with (
        opened(path) as old,
        worded(path),
        closing(connected(whole, "ro")) as source,
        closing(connected(path, "rw", busy_timeout_s)) as target,
    ):
        source.backup(
            target, pages=PAGES_PER_STEP, progress=_keeping(old, kept, busy_timeout_s), sleep=0.02
        )


def _keeping(old: BinaryIO, kept: Path, busy_timeout_s: float) -> Callable[[int, int, int], None]:
    """Called after each step: keeps the old file once the lock is there, and bounds the wait."""
    deadline = time.monotonic() + busy_timeout_s
    done = False

    def keep(status: int, _remaining: int, _total: int) -> None:
        nonlocal done
        if status in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
            if time.monotonic() > deadline:
                raise CatalogueLocked(
                    "is held by another program; wait until it is done, then try again"
                )
        elif not done:
            _write_whole(old, kept)
            done = True

    return keep


def _write_whole(old: BinaryIO, kept: Path) -> None:
    """The bytes of the old file as they are, damage and all, on the disk before it is changed."""
    partial = kept.with_name(f".{kept.name}.partial")
    try:
        old.seek(0)
        with partial.open("wb") as file:
            while block := old.read(1 << 20):
                file.write(block)
            file.flush()
            os.fsync(file.fileno())
        settled(partial, kept, replace=True)
    finally:
        partial.unlink(missing_ok=True)


def _moved(path: Path, kept: Path) -> None:
    """Set a file aside with its journal, which belongs to it and to no other."""
    for tail in ("-journal", ""):
        part = path.with_name(path.name + tail)
        if part.exists():
            part.rename(kept.with_name(kept.name + tail))
    synced(path.parent)
