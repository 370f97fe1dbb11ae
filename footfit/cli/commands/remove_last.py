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
    from footfit.cli.answer_forms import REMOVE_LAST
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts

    lasts.remove(catalogue_path(catalogue), last)
    tell(last, REMOVE_LAST, Voice(json, quiet))
