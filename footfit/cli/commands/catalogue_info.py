"""``footfit catalogue-info``: where the catalogue is and what it keeps."""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def catalogue_info(
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Say where the catalogue is, what it holds and what it keeps.

    Example: footfit catalogue-info
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).info(), mode)
