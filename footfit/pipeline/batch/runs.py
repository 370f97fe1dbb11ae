"""One function over many meshes, in order, on one process or several."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Generic, Protocol, TypeVar

from footfit.errors import ExitCode, FootfitError
from footfit.pipeline.batch.work_limits import WORK_LIMITS, WorkLimits, hold_to_limits

HERE = 0
"""As ``jobs``: in this process, where a crash ends the whole batch."""


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
    jobs: int = HERE,
    limits: WorkLimits = WORK_LIMITS,
) -> Iterator[Outcome[S, T]]:
    """Do ``work`` on each item; yield in the items' order, whatever ``jobs``.

    Several items go to ``jobs`` other processes, even if that is one, so that a process that dies
    costs only its own item. ``work`` must then be picklable: a module's function, or a
    ``functools.partial`` of one. A FootfitError becomes an outcome, and so does a worker that dies
    or needs more time or memory than ``limits``. Any other exception is a bug and is raised.
    """
    limited_work = partial(_outcome, work, limits)
    if jobs == HERE or len(items) < 2:
        yield from map(limited_work, items)
        return
    from footfit.pipeline.batch.workers import ordered_answers

    answers = ordered_answers(limited_work, items, min(jobs, len(items)), limits)
    for item, answer in zip(items, answers, strict=True):
        yield answer if isinstance(answer, Outcome) else Outcome(item, None, answer.at(item.path))


def _outcome(work: Callable[[S], T], limits: WorkLimits, item: S) -> Outcome[S, T]:
    try:
        with hold_to_limits(limits):
            return Outcome(item, work(item), None)
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
