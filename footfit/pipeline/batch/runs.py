"""One function over many meshes, in order: in this process, in others, or on a cluster."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
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
    for group in outcome_groups(work, items, jobs, limits, known):
        yield from group


def outcome_groups(
    work: Callable[[S], T],
    items: Sequence[S],
    jobs: Jobs = HERE,
    limits: WorkLimits = WORK_LIMITS,
    known: Callable[[S], T | None] = lambda _: None,
    *,
    most: int = 1,
    longest_s: float = 0.0,
) -> Iterator[list[Outcome[S, T]]]:
    """The `outcomes`, those together that are ready when the first of them is asked for.

    A group has at most ``most`` outcomes, and is gathered for at most ``longest_s``. No group waits
    for an outcome that is not ready.
    """
    if isinstance(jobs, int) and (jobs == HERE or len(items) < 2):
        for item in items:
            yield [_outcome(item, partial(_limited, work, item, limits, known))]
        return
    from footfit.pipeline.batch.workers import WorkerPool

    executor = WorkerPool(min(jobs, len(items)), limits) if isinstance(jobs, int) else jobs
    flight = _Flight(work, iter(items), executor, known)
    try:
        while flight.refilled():
            group, ends_s = [flight.taken()], time.monotonic() + longest_s
            while len(group) < most and flight.has_ready() and time.monotonic() < ends_s:
                group.append(flight.taken())
                flight.refilled()
            yield group
    finally:
        flight.cancel()
        if executor is not jobs:
            executor.shutdown(cancel_futures=True)


@dataclass(slots=True)
class _Flight(Generic[S, T]):
    """The items that an executor has, in order: a few at a time, however many there are."""

    work: Callable[[S], T]
    waiting: Iterator[S]
    executor: Executor
    known: Callable[[S], T | None]
    flying: deque[tuple[S, Future[T]]] = field(default_factory=deque)

    def refilled(self) -> bool:
        """Begin items until there are enough; whether there is one at all."""
        while len(self.flying) < AHEAD_PER_JOB * _width(self.executor):
            item = next(self.waiting, None)
            if item is None:
                break
            self.flying.append((item, _future(self.work, item, self.executor, self.known)))
        return bool(self.flying)

    def taken(self) -> Outcome[S, T]:
        """The outcome of the next item, as soon as there is one."""
        item, future = self.flying.popleft()
        return _outcome(item, future.result)

    def has_ready(self) -> bool:
        """Whether the next item has an outcome already, which does not end the batch."""
        if not self.flying or not self.flying[0][1].done():
            return False
        future = self.flying[0][1]
        error = None if future.cancelled() else future.exception()
        return error is None or (
            isinstance(error, FootfitError) and not isinstance(error, ClusterUnusable)
        )

    def cancel(self) -> None:
        """Cancel what is not done."""
        for _, future in self.flying:
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
