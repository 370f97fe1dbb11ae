"""``footfit upgrade-catalogue``: an older catalogue to this version."""

from __future__ import annotations

from footfit.cli import options


def upgrade_catalogue(
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Bring an older catalogue to the schema and the definitions of this version.

    Example: footfit upgrade-catalogue
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).upgrade(), mode)
