"""``footfit show-last``: all that the catalogue holds of one last."""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def show_last(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Show one last: labels, frame, flare, measures, and what the paper's frame would cost.

    Example: footfit show-last derby-42
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).last(last), mode)
