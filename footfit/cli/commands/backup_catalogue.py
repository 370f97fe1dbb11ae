"""``footfit backup-catalogue``: a whole, verified copy while others go on working."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def backup_catalogue(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", show_default=False, help="The backup to write.")
    ],
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    *,
    mode: OutputMode,
) -> None:
    """Copy the catalogue, also while others write to it; a damaged one is refused.

    Example: footfit backup-catalogue lasts-2026-05-01.footfit
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).backup(file, replace=force), mode)
