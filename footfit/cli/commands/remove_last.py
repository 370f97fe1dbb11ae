"""``footfit remove-last``: a last out of the catalogue."""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def remove_last(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Remove a last from the catalogue; the reference is refused.

    Example: footfit remove-last derby-42
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).remove(last), mode)
