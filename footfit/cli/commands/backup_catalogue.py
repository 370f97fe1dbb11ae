"""``footfit backup-catalogue``: a whole, checked copy, while others go on working."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from footfit.cli import options


def backup_catalogue(
    file: Annotated[Path, options.argument("FILE", "Name the backup to write.")],
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    mode: options.OutputMode,
) -> None:
    """Copy the catalogue and check the copy, also while others write to it.

    A damaged catalogue is refused.

    Example: footfit backup-catalogue lasts-2026-05-01.footfit
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).backup(file, replace=force), mode)
