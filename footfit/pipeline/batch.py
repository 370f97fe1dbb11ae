"""One function over many meshes, in order, on one process or several."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from footfit.errors import ExitCode, FootfitError


class Item(Protocol):
    """What a batch is made of: anything that names its file."""

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""


S = TypeVar("S", bound=Item)
T = TypeVar("T")
AHEAD_PER_JOB = 2
"""Tasks handed to the pool before the first answer is taken: bounds what waits in memory."""


@dataclass(frozen=True, slots=True)
class Outcome(Generic[S, T]):
    """What became of one item: a value, or the error that its line says."""

    item: S
    value: T | None
    error: FootfitError | None


def outcomes(work: Callable[[S], T], items: Sequence[S], jobs: int = 1) -> Iterator[Outcome[S, T]]:
    """Do ``work`` on each item; yield in the items' order, whatever ``jobs``.

    ``work`` must be picklable (a module's function, or a ``functools.partial`` of one). Its
    FootfitErrors become outcomes; any other exception is a bug and is raised.
    """
    if jobs == 1 or len(items) < 2:
        for item in items:
            yield _outcome(work, item)
        return
    yield from _pooled(work, items, min(jobs, len(items)))


def _outcome(work: Callable[[S], T], item: S) -> Outcome[S, T]:
    try:
        return Outcome(item, work(item), None)
    except FootfitError as error:
        return Outcome(item, None, error.at(item.path))


def _pooled(work: Callable[[S], T], items: Sequence[S], jobs: int) -> Iterator[Outcome[S, T]]:
    """As `outcomes`, on a pool. Spawned, not forked: a catalogue that is open in this process
    must not be carried into a child (SQLite forbids it).
    """
    from concurrent.futures import Future, ProcessPoolExecutor
    from multiprocessing import get_context

    waiting: deque[Future[Outcome[S, T]]] = deque()
    pool = ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_deaf)
    try:
        for item in items:
            waiting.append(pool.submit(_outcome, work, item))
            if len(waiting) >= AHEAD_PER_JOB * jobs:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _deaf() -> None:
    """Let the parent alone answer Ctrl-C; it ends the workers."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)


def common_code(codes: Iterable[int]) -> int:
    """The failures' common exit code, or 3 where they differ; 0 without failures.

    Examples
    --------
    >>> common_code([]), common_code([5, 5]), common_code([5, 3])
    (0, 5, 3)
    """
    different = set(codes)
    return (
        different.pop()
        if len(different) == 1
        else int(ExitCode.INPUT if different else ExitCode.OK)
    )
