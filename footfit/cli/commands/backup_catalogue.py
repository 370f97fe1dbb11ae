"""``footfit backup-catalogue``: a whole, verified copy while others go on working."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options


def backup_catalogue(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", show_default=False, help="The backup to write.")
    ],
    catalogue: options.Catalogue = None,
    force: options.Force = False,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Copy the catalogue, also while others write to it; a damaged one is refused.

    Example: footfit backup-catalogue lasts-2026-05-01.footfit
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library.backup import back_up

    outcome = back_up(catalogue_path(catalogue), file, replace=force)
    tell(outcome, Voice(json, quiet))
