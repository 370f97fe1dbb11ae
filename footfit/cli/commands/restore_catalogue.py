"""``footfit restore-catalogue``: the catalogue as a backup has it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def restore_catalogue(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", show_default=False, help="The backup to restore.")
    ],
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Make the catalogue what a backup is; the backup is checked first, the one before is kept.

    Example: footfit restore-catalogue lasts-2026-05-01.footfit
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).restore(file), mode)
