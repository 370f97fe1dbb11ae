"""``footfit catalogue-info``: where the catalogue is and what it keeps."""

from __future__ import annotations

from footfit.cli import options


def catalogue_info(
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Say where the catalogue is, what it holds and what it keeps.

    Example: footfit catalogue-info
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts

    tell(lasts.summary(catalogue_path(catalogue)), Voice(json, quiet))
