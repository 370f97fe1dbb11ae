"""``footfit set-reference``: the last that the paper's frame comes from."""

from __future__ import annotations

from footfit.cli import options


def set_reference(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Make a last the reference: the paper's OM_E comes from it (Eq. 6).

    Every stored frame is rewritten in one transaction. No mesh file is needed.

    Example: footfit set-reference derby-42
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).set_reference(last), mode)
