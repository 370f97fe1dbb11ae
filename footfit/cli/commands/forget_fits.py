"""``footfit forget-fits``: remove entries of the fit log for good."""

from __future__ import annotations

from footfit.cli import options


def forget_fits(
    code: str = options.argument("CODE|ID", "Give a wearer's code, or the id of one entry."),
    *,
    lasts: options.Lasts,
    mode: options.OutputMode,
) -> object:
    """Remove all entries of a wearer, or one entry, so that nothing of them is left in the file.

    Backups and copies that were made earlier keep them; delete those too.

    Example: footfit forget-fits W17
    """
    return lasts.open().fit_log.forget(code)
