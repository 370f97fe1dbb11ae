"""``footfit catalogue-info``: where the catalogue is and what it keeps."""

from __future__ import annotations

from footfit.cli import options


def catalogue_info(
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Say where the catalogue is, what it holds and what it keeps.

    Example: footfit catalogue-info
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).info(), mode)
