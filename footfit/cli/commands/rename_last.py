"""``footfit rename-last``: another name for a last."""

from __future__ import annotations

from typing import Annotated

import typer

from footfit.cli import options


def rename_last(
    last: options.LastName,
    new_name: Annotated[str, typer.Argument(metavar="NEW_NAME", help="Give the new name.")],
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Give a last another name.

    Example: footfit rename-last scan-0042 derby-42
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).rename(last, new_name), mode)
