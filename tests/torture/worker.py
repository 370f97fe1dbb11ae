"""A process to be watched by strace: ``python -m tests.torture.worker SCRIPT FOLDER [MODE]``."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path

from footfit.catalogue.file import engine
from tests.torture.scripts import SCRIPTS


def main(name: str, folder: str, synchronous: str = "EXTRA") -> None:
    """Run a script; each step is acknowledged by a byte on stdout."""
    pragmas = ("PRAGMA journal_mode = DELETE", f"PRAGMA synchronous = {synchronous}")
    engine.SETTINGS = replace(engine.SETTINGS, for_writers=pragmas)
    for _ in SCRIPTS[name].work(Path(folder), 0):
        os.writev(1, [b"."])


if __name__ == "__main__":
    main(*sys.argv[1:])
