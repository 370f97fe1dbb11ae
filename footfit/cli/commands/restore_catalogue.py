"""``footfit restore-catalogue``: the catalogue as a backup has it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from footfit.cli import options


def restore_catalogue(
    file: Annotated[Path, options.argument("FILE", "The backup to restore.")],
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Make the catalogue what a backup is; the backup is checked first, the one before is kept.

    Example: footfit restore-catalogue lasts-2026-05-01.footfit
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).restore(file), mode)
