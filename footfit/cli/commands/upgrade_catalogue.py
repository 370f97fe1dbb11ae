"""``footfit upgrade-catalogue``: an older catalogue to this version."""

from __future__ import annotations

from footfit.cli import options


def upgrade_catalogue(
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Bring a catalogue to this version's schema and flare definition.

    Example: footfit upgrade-catalogue
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library.upgrade import upgrade

    tell(upgrade(catalogue_path(catalogue)), Voice(json, quiet))
