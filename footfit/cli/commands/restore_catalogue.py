"""``footfit restore-catalogue``: the catalogue as a backup has it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from footfit.cli import options


def restore_catalogue(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", show_default=False, help="The backup to restore.")
    ],
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Make the catalogue what a backup is; the backup is checked first, the one before is kept.

    Example: footfit restore-catalogue lasts-2026-05-01.footfit
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library.backup import restore

    tell(restore(catalogue_path(catalogue), file), Voice(json, quiet))
