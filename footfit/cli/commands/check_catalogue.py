"""``footfit check-catalogue``: is every value as it was stored?"""

from __future__ import annotations

from footfit.cli import options


def check_catalogue(*, lasts: options.Lasts, mode: options.OutputMode) -> None:
    """Check that every value is as it was stored. If not, list the faults and exit with 7.

    Example: footfit check-catalogue
    """
    from footfit.cli.answers import tell
    from footfit.errors import CheckFailed
    from footfit.pipeline.library.check import failure_words

    outcome = lasts.open().check()
    tell(outcome, mode)
    if outcome.findings:
        raise CheckFailed(failure_words(outcome.findings), outcome.path)
