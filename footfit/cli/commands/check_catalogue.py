"""``footfit check-catalogue``: is everything as it was stored?"""

from __future__ import annotations

from footfit.cli import options


def check_catalogue(
    catalogue: options.Catalogue = None,
    json: options.Json = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Look for every value that is not as it was stored; exit 7 with a list of them.

    Example: footfit check-catalogue
    """
    from footfit.cli.answers import Voice, tell
    from footfit.cli.settings import catalogue_path
    from footfit.errors import CheckFailed
    from footfit.pipeline.library.check import check, failure_words

    outcome = check(catalogue_path(catalogue))
    tell(outcome, Voice(json, quiet))
    if outcome.findings:
        raise CheckFailed(failure_words(outcome.findings), outcome.path)
