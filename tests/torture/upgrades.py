"""Migrations that fail at each of their statements."""

from __future__ import annotations

import shutil
from pathlib import Path

from footfit.catalogue.file.migrate import copy_path
from footfit.catalogue.store import open_catalogue
from tests.torture.migrations import OLD_FILE, later_schema
from tests.torture.scripts import MAIN, content
from tests.torture.tally import Tally


class Failed(RuntimeError):
    """The fault."""


def failing_upgrade_trials(folder: Path, every: int = 1) -> Tally:
    """Before the commit it is the old catalogue to the byte, with a whole copy beside it."""
    from sqlalchemy import Engine, event

    tally = Tally("migration that fails at a statement")
    folder.mkdir(exist_ok=True)
    path, old, k = folder / MAIN, content(OLD_FILE), 0
    first = OLD_FILE.stem.partition("-")[2]
    while True:
        shutil.copy(OLD_FILE, path)
        left = k

        def count(*_: object) -> None:
            nonlocal left
            left -= 1
            if left < 0:
                raise Failed

        event.listen(Engine, "before_cursor_execute", count)
        try:
            with open_catalogue(path, write=True, schema=later_schema()):
                pass
            break
        except Failed:
            tally.trials += 1
            tally.struck += 1
        finally:
            event.remove(Engine, "before_cursor_execute", count)
        if path.read_bytes() != OLD_FILE.read_bytes():
            tally.breach(f"statement {k}: the old file changed")
        copy = copy_path(path, first)
        if copy.exists() and content(copy) != old:
            tally.breach(f"statement {k}: the copy is not the old catalogue")
        k += every
    if content(copy_path(path, first)) != old or content(path) == old:
        tally.breach("the undisturbed upgrade changed nothing, or has no copy")
    return tally
