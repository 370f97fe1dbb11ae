"""``footfit upgrade-catalogue``: an older catalogue to this version."""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def upgrade_catalogue(
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Bring a catalogue to this version's schema and flare definition.

    Example: footfit upgrade-catalogue
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at

    tell(catalogue_at(catalogue).upgrade(), mode)
