"""``footfit restore-catalogue``: the catalogue as a backup has it."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def restore_catalogue(
    file: Path = options.argument("FILE", "Name the backup to restore."),
    *,
    lasts: options.Lasts,
    mode: options.OutputMode,
) -> object:
    """Put a backup in the place of the catalogue. It is checked first; the old file is kept.

    Example: footfit restore-catalogue lasts-2026-05-01.footfit
    """
    return lasts.open_to_make().restore(file)
