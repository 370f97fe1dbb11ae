"""``footfit remove-last``: remove a last from the catalogue."""

from __future__ import annotations

from footfit.cli import options


def remove_last(
    last: str = options.LAST, *, lasts: options.Lasts, mode: options.OutputMode
) -> object:
    """Remove a last from the catalogue; the reference only if no other last is left.

    Example: footfit remove-last derby-42
    """
    return lasts.open().remove(last)
