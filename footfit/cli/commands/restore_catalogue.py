"""``footfit restore-catalogue``: the catalogue as a backup has it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from footfit.cli import options


def restore_catalogue(
    file: Annotated[Path, options.argument("FILE", "Name the backup to restore.")],
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Put a backup in the place of the catalogue. It is checked first; the old file is kept.

    Example: footfit restore-catalogue lasts-2026-05-01.footfit
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).restore(file), mode)
