"""``footfit upgrade-catalogue``: an older catalogue to this version."""

from __future__ import annotations

from footfit.cli import options


def upgrade_catalogue(*, lasts: options.Lasts, mode: options.OutputMode) -> object:
    """Bring an older catalogue to the schema and the definitions of this version.

    Example: footfit upgrade-catalogue
    """
    return lasts.open().upgrade()
