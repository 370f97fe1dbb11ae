"""How far the work is: a bar on stderr, if a person watches a terminal.

Of many files it counts those that are done. Of one customer it names the phase of the work.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

from footfit.cli.console import is_terminal
from footfit.cli.signals import LISTENER

if TYPE_CHECKING:
    from footfit.cli.options import OutputMode
    from footfit.pipeline.batch.phases import Phase

T = TypeVar("T")
PHASE_SHARES: dict[Phase, float] = {"reading": 1, "pose": 2, "measures": 2, "match": 1, "page": 4}
"""How long each phase takes beside the others, about: it only moves the bar."""
OF_EACH_SCAN: tuple[Phase, ...] = ("reading", "pose", "measures")


class Progress:
    """A bar that shows nothing if nobody watches."""

    def __init__(self, total: int, scans: int, *, watched: bool) -> None:
        self.counts = total > 1
        each = sum(PHASE_SHARES[phase] for phase in OF_EACH_SCAN)
        after = sum(PHASE_SHARES.values()) - each
        self.total = float(total) if self.counts else scans * each + after
        self.done, self.next_share = 0.0, 0.0
        self.bar = _rich_bar() if watched else None
        self.task = self.bar.add_task("", total=self.total, left="") if self.bar else None
        self.started = time.monotonic()

    def items(self, items: Iterable[T]) -> Iterator[T]:
        """The items; the bar is hidden while one is answered."""
        self.show()
        for item in items:
            self.hide()
            yield item
            LISTENER.done += 1
            if self.counts:
                self._advance(1.0, f"{LISTENER.done}/{self.total:.0f}")
                self.show()
        self.hide()

    def begin(self, phase: Phase) -> None:
        """Name the phase that begins; of many files the bar names none."""
        if not self.counts:
            self._advance(self.next_share, phase)
            self.next_share = PHASE_SHARES[phase]

    def show(self) -> None:
        """Show the bar."""
        if self.bar:
            self.bar.start()

    def hide(self) -> None:
        """Hide the bar, so that a line can be written."""
        if self.bar:
            self.bar.stop()

    def _advance(self, share: float, words: str) -> None:
        self.done = min(self.done + share, self.total)
        if self.bar is not None and self.task is not None:
            took_s = time.monotonic() - self.started
            left_s = took_s * (self.total - self.done) / self.done if self.done else None
            left = "" if left_s is None else left_words(left_s)
            shown = {"description": words, "left": left}
            # A phase may be over before the next regular drawing, so it is drawn at once.
            self.bar.update(self.task, completed=self.done, refresh=not self.counts, **shown)


@contextmanager
def progress(mode: OutputMode, scans: int = 1) -> Iterator[Progress]:
    """A bar for the work on ``mode.total`` customers, of which each may have several ``scans``."""
    from footfit.pipeline.batch.phases import heard_by

    LISTENER.total = mode.total
    watched = not (mode.quiet or mode.json) and is_terminal(sys.stderr)
    bar = Progress(mode.total, scans, watched=watched)
    with heard_by(bar.begin):
        try:
            yield bar
        finally:
            bar.hide()


def left_words(seconds: float) -> str:
    """How much time is left, about.

    Examples
    --------
    >>> left_words(0.2), left_words(44.6), left_words(100), left_words(7500)
    ('1 s left', '45 s left', '2 min left', '2 h 5 min left')
    """
    if seconds < 60:
        return f"{max(1, round(seconds))} s left"
    minutes = round(seconds / 60)
    return f"{minutes} min left" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min left"


def _rich_bar() -> Any:
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn
    from rich.progress import Progress as RichProgress

    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[left]}"))
    return RichProgress(*columns, console=Console(stderr=True), transient=True)
