"""``footfit remove-last``: a last out of the catalogue."""

from __future__ import annotations

from footfit.cli import options


def remove_last(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Remove a last from the catalogue; the reference is refused.

    Example: footfit remove-last derby-42
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts

    tell(lasts.remove(catalogue_path(catalogue), last), Voice(json, quiet))
