"""``footfit backup-catalogue``: a whole, checked copy, while others go on working."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def backup_catalogue(
    file: Path = options.argument("FILE", "Name the backup to write."),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> object:
    """Copy the catalogue and check the copy, also while others write to it.

    A damaged catalogue is refused.

    Example: footfit backup-catalogue lasts-2026-05-01.footfit
    """
    return lasts.open().backup(file, replace=force)
