"""``footfit rename-last``: another name for a last."""

from __future__ import annotations

from typing import Annotated

import typer

from footfit.cli import options


def rename_last(
    last: options.LastName,
    new_name: Annotated[str, typer.Argument(metavar="NEW_NAME", help="The name it gets.")],
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Give a last another name.

    Example: footfit rename-last scan-0042 derby-42
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts

    tell(lasts.rename(catalogue_path(catalogue), last, new_name), Voice(json, quiet))
