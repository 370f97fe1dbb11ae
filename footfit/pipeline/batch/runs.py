"""One function over many meshes, in order: in this process, in others, or on a cluster."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Generic, Protocol, TypeAlias, TypeVar

from footfit.errors import ClusterUnusable, ExitCode, FootfitError
from footfit.pipeline.batch.work_limits import WORK_LIMITS, WorkLimits, hold_to_limits

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

Jobs: TypeAlias = "int | Executor"
"""How many processes work, or who works: an executor of ``concurrent.futures``."""
HERE = 0
"""As ``jobs``: in this process, where a crash ends the whole batch."""
AHEAD_PER_JOB = 2
"""So many items for each worker are begun before the first is answered; it limits the memory."""
USUAL_WIDTH = 4
"""How many workers an executor is taken to have that does not say it."""


class Item(Protocol):
    """One of a batch: anything that names its file."""

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""


S = TypeVar("S", bound=Item)
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Outcome(Generic[S, T]):
    """The result of one item: a value, or an error."""

    item: S
    value: T | None
    error: FootfitError | None


def outcomes(
    work: Callable[[S], T],
    items: Sequence[S],
    jobs: Jobs = HERE,
    limits: WorkLimits = WORK_LIMITS,
    known: Callable[[S], T | None] = lambda _: None,
) -> Iterator[Outcome[S, T]]:
    """Do ``work`` on each item; yield in the items' order, whatever ``jobs``.

    Several items go to ``jobs`` other processes, even if that is one, so that a process that dies
    costs only its own item. ``work`` must then be picklable: a module's function, or a
    ``functools.partial`` of one. An executor gets every item; it is not shut down. What ``known``
    gives for an item, in this process, needs no work.

    A FootfitError becomes an outcome, and so does a worker that dies or needs more time or memory
    than ``limits``. Any other exception is a bug and is raised.

    Raises
    ------
    ClusterUnusable
        The executor's cluster cannot be used any more.
    """
    if not isinstance(jobs, int):
        yield from _ordered(work, items, jobs, known)
    elif jobs == HERE or len(items) < 2:
        for item in items:
            yield _outcome(item, partial(_limited, work, item, limits, known))
    else:
        from footfit.pipeline.batch.workers import WorkerPool

        pool = WorkerPool(min(jobs, len(items)), limits)
        try:
            yield from _ordered(work, items, pool, known)
        finally:
            pool.shutdown(cancel_futures=True)


def _ordered(
    work: Callable[[S], T],
    items: Iterable[S],
    executor: Executor,
    known: Callable[[S], T | None],
) -> Iterator[Outcome[S, T]]:
    """The outcomes in order; a few items are in flight at a time, however many there are."""
    waiting = iter(items)
    flying: deque[tuple[S, Future[T]]] = deque()
    try:
        while True:
            for item in waiting:
                flying.append((item, _future(work, item, executor, known)))
                if len(flying) >= AHEAD_PER_JOB * _width(executor):
                    break
            if not flying:
                return
            item, future = flying.popleft()
            yield _outcome(item, future.result)
    finally:
        for _, future in flying:
            future.cancel()


def _future(
    work: Callable[[S], T], item: S, executor: Executor, known: Callable[[S], T | None]
) -> Future[T]:
    value = _quiet(known, item)
    if value is None:
        return executor.submit(work, item)
    from concurrent.futures import Future

    future: Future[T] = Future()
    future.set_result(value)
    return future


def _quiet(known: Callable[[S], T | None], item: S) -> T | None:
    """What is known of an item; what is wrong with it, the work will say."""
    try:
        return known(item)
    except FootfitError:
        return None


def _width(executor: Executor) -> int:
    """How many calls an executor works on at a time."""
    width = getattr(executor, "width", getattr(executor, "_max_workers", USUAL_WIDTH))
    return max(1, int(width))


def _limited(
    work: Callable[[S], T], item: S, limits: WorkLimits, known: Callable[[S], T | None]
) -> T:
    with hold_to_limits(limits):
        value = _quiet(known, item)
        return work(item) if value is None else value


def _outcome(item: S, result: Callable[[], T]) -> Outcome[S, T]:
    try:
        return Outcome(item, result(), None)
    except ClusterUnusable:  # it is no fault of the item
        raise
    except FootfitError as error:
        return Outcome(item, None, error.at(item.path))


def common_code(codes: Iterable[int]) -> int:
    """The exit code that all failures have in common, or 3 if they differ; 0 without failures.

    Examples
    --------
    >>> common_code([]), common_code([5, 5]), common_code([5, 3])
    (0, 5, 3)
    """
    different = set(codes)
    if len(different) == 1:
        return different.pop()
    return int(ExitCode.INPUT if different else ExitCode.OK)
