"""``footfit remove-last``: remove a last from the catalogue."""

from __future__ import annotations

from footfit.cli import options


def remove_last(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Remove a last from the catalogue. The reference last cannot be removed.

    Example: footfit remove-last derby-42
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).remove(last), mode)
