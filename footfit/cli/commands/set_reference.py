"""``footfit set-reference``: the last that the paper's frame comes from."""

from __future__ import annotations

from footfit.cli import options


def set_reference(
    last: options.LastName,
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Make a last the reference: the paper's OM_E comes from it (Eq. 6).

    Every stored frame is re-expressed in one transaction; no mesh file is needed.

    Example: footfit set-reference derby-42
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.pipeline.library import lasts

    changed = lasts.set_reference(catalogue_path(catalogue), last)
    tell(changed, Voice(json, quiet))
