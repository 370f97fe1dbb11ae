"""``footfit show-last``: all that the catalogue holds of one last."""

from __future__ import annotations

from footfit.cli import options


def show_last(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Show one last: labels, frame, flare, measures, and what the paper's frame would cost.

    Example: footfit show-last derby-42
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts

    tell(lasts.last(catalogue_path(catalogue), last), Voice(json, quiet))
