"""``footfit check-catalogue``: is everything as it was stored?"""

from __future__ import annotations

from footfit.cli import options
from footfit.cli.option_groups import OutputMode, with_groups


@with_groups
def check_catalogue(
    catalogue: options.Catalogue = None,
    *,
    mode: OutputMode,
) -> None:
    """Look for every value that is not as it was stored; exit 7 with a list of them.

    Example: footfit check-catalogue
    """
    from footfit.cli.answers import tell
    from footfit.cli.settings import catalogue_at
    from footfit.errors import CheckFailed
    from footfit.pipeline.library.check import failure_words

    outcome = catalogue_at(catalogue).check()
    tell(outcome, mode)
    if outcome.findings:
        raise CheckFailed(failure_words(outcome.findings), outcome.path)
