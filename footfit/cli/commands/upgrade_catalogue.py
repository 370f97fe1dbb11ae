"""``footfit upgrade-catalogue``: an older catalogue to this version."""

from __future__ import annotations

from footfit.cli import options


def upgrade_catalogue(
    jobs: int = options.JOBS, *, lasts: options.Lasts, mode: options.OutputMode
) -> object:
    """Bring an older catalogue to the schema and the definitions of this version.

    You can stop it and run it again: it goes on with the lasts that are left.

    Example: footfit upgrade-catalogue --jobs 2
    """
    from footfit.cli.signals import LISTENER

    def count(done: int, total: int) -> None:
        if total:
            words = f"{done} of {total} lasts are done: run the command again for the others"
            LISTENER.so_far = words

    return lasts.open().upgrade(jobs, count)
