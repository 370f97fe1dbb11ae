"""One function over many meshes, in order, on one process or several."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Generic, Protocol, TypeVar

from footfit.errors import ExitCode, FootfitError
from footfit.pipeline.batch.work_limits import WORK_LIMITS, WorkLimits, limited

HERE = 0
"""As ``jobs``: in this process, where a crash takes everything with it."""


class Item(Protocol):
    """What a batch is made of: anything that names its file."""

    @property
    def path(self) -> str | None:
        """The file's path; None for standard input."""


S = TypeVar("S", bound=Item)
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Outcome(Generic[S, T]):
    """What became of one item: a value, or the error that its line says."""

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

    Several items are done by ``jobs`` other processes, also by a single one, so that one that dies
    costs its own item only; ``work`` must then be picklable (a module's function, or a
    ``functools.partial`` of one). FootfitErrors become outcomes, and so do time and memory past
    ``limits`` and a worker's death; any other exception is a bug and is raised.
    """
    held = partial(_outcome, work, limits)
    if jobs == HERE or len(items) < 2:
        yield from map(held, items)
        return
    from footfit.pipeline.batch.workers import worked

    answers = worked(held, items, min(jobs, len(items)), limits)
    for item, answer in zip(items, answers, strict=True):
        yield answer if isinstance(answer, Outcome) else Outcome(item, None, answer.at(item.path))


def _outcome(work: Callable[[S], T], limits: WorkLimits, item: S) -> Outcome[S, T]:
    try:
        with limited(limits):
            return Outcome(item, work(item), None)
    except FootfitError as error:
        return Outcome(item, None, error.at(item.path))


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
