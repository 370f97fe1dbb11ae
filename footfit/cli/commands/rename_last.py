"""``footfit rename-last``: another name for a last."""

from __future__ import annotations

from footfit.cli import options


def rename_last(
    last: str = options.LAST,
    new_name: str = options.argument("NEW_NAME", "Give the new name."),
    *,
    lasts: options.Lasts,
    mode: options.OutputMode,
) -> object:
    """Give a last another name.

    Example: footfit rename-last scan-0042 derby-42
    """
    return lasts.open().rename(last, new_name)
