"""Which phase of the work on a scan begins, for a person who waits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Literal

Phase = Literal["reading", "pose", "measures", "match", "page"]
Listener = Callable[[Phase], object]

_LISTENER: ContextVar[Listener | None] = ContextVar("listener", default=None)


def begin(phase: Phase) -> None:
    """Tell the listener of this process, if there is one, that a phase begins."""
    listener = _LISTENER.get()
    if listener is not None:
        listener(phase)


@contextmanager
def heard_by(listener: Listener) -> Iterator[None]:
    """Tell ``listener`` of each phase that begins inside the block."""
    token = _LISTENER.set(listener)
    try:
        yield
    finally:
        _LISTENER.reset(token)
