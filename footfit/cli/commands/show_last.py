"""``footfit show-last``: all that the catalogue holds of one last."""

from __future__ import annotations

from footfit.cli import options


def show_last(
    last: str = options.LAST, *, lasts: options.Lasts, mode: options.OutputMode
) -> object:
    """Show one last: labels, frame, flare, measures, and what the paper's frame would cost.

    Example: footfit show-last derby-42
    """
    return lasts.open().last(last)
