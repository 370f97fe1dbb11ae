"""``footfit set-reference``: the last that the paper's frame comes from."""

from __future__ import annotations

from footfit.cli import options


def set_reference(
    last: str = options.LAST, *, lasts: options.Lasts, mode: options.OutputMode
) -> object:
    """Make a last the reference: the paper's OM_E comes from it (Eq. 6).

    Every stored frame is rewritten in one transaction. No mesh file is needed.

    Example: footfit set-reference derby-42
    """
    return lasts.open().set_reference(last)
