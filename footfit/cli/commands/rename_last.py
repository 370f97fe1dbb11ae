"""``footfit rename-last``: another name for a last."""

from __future__ import annotations

from typing import Annotated

import typer

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def rename_last(
    last: options.LastName,
    new_name: Annotated[str, typer.Argument(metavar="NEW_NAME", help="The name it gets.")],
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Give a last another name.

    Example: footfit rename-last scan-0042 derby-42
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).rename(last, new_name), mode)
