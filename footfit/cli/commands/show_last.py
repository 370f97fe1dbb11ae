"""``footfit show-last``: all that the catalogue holds of one last."""

from __future__ import annotations

from footfit.cli import options


def show_last(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    *,
    mode: options.OutputMode,
) -> None:
    """Show one last: labels, frame, flare, measures, and what the paper's frame would cost.

    Example: footfit show-last derby-42
    """
    from footfit.api.catalogues import open_catalogue
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_path

    tell(open_catalogue(catalogue_path(catalogue)).last(last), mode)
