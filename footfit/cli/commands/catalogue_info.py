"""``footfit catalogue-info``: where the catalogue is and what it keeps."""

from __future__ import annotations

from footfit.cli import options


def catalogue_info(*, lasts: options.Lasts, mode: options.OutputMode) -> object:
    """Say where the catalogue is, what it holds and what it keeps.

    Example: footfit catalogue-info
    """
    return lasts.open().info()
