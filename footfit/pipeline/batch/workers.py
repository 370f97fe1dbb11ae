"""A few processes that work on items one at a time, each watched by this one.

``concurrent.futures`` cannot say which item a dead worker had, and cannot end one that hangs. Here
each worker has its own pipes, so that both are known and the others go on.
"""

from __future__ import annotations

import signal
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from typing import Any, Generic, TypeVar

from footfit.errors import FootfitError, TooLarge, TooSlow, UnreadableFile
from footfit.pipeline.batch.work_limits import SLIM, WorkLimits, too_slow_words

S = TypeVar("S")
T = TypeVar("T")
AHEAD_PER_JOB = 2
"""So many items for each worker are begun before the first is answered; it limits the memory."""


@dataclass(slots=True)
class _Worker(Generic[S]):
    """A process, this end of its two pipes, and which item it has until when."""

    process: SpawnProcess
    orders: Connection
    answers: Connection
    place: int | None = None
    deadline: float = 0.0

    def begin(self, place: int, item: S, seconds: float) -> None:
        """Hand the worker an item that it has so many seconds for."""
        self.place, self.deadline = place, time.monotonic() + seconds
        with suppress(OSError):  # the worker has exited; we notice when we read its pipe
            self.orders.send(item)

    def end(self) -> None:
        """Kill the process and close the pipes."""
        self.process.kill()
        self.process.join()
        self.orders.close()
        self.answers.close()


def ordered_answers(
    work: Callable[[S], T], items: Sequence[S], jobs: int, limits: WorkLimits
) -> Iterator[T | FootfitError]:
    """What ``work`` gives for each item, in order, from ``jobs`` processes.

    Spawned, not forked: SQLite forbids that a catalogue which is open in this process is carried
    into a child. An item has an error if its worker dies or takes longer than the limits. An
    exception of ``work`` is raised here.
    """
    crew: list[_Worker[S]] = []
    answers: dict[int, T | FootfitError] = {}
    begun = 0
    try:
        for awaited in range(len(items)):
            while awaited not in answers:
                for worker in _idle_workers(crew, work, jobs):
                    if begun < min(len(items), awaited + AHEAD_PER_JOB * jobs):
                        worker.begin(begun, items[begun], limits.seconds + limits.grace_seconds)
                        begun += 1
                answers |= _next_answers(crew, limits)
            yield answers.pop(awaited)
    finally:
        for worker in crew:
            worker.end()


def _idle_workers(crew: list[_Worker[S]], work: Callable[[S], T], jobs: int) -> list[_Worker[S]]:
    """The workers that have no item, after the crew is filled up to ``jobs``."""
    context = get_context("spawn")
    while len(crew) < jobs:
        taken, orders = context.Pipe(duplex=False)  # a pipe for both ways would be a socket
        answers, given = context.Pipe(duplex=False)
        process = context.Process(target=_serve, args=(taken, given, work), daemon=True)
        with _delayed_signals():  # or a worker could start that nobody knows of and nobody ends
            process.start()
            crew.append(_Worker(process, orders, answers))
        taken.close()
        given.close()
    return [worker for worker in crew if worker.place is None]


@contextmanager
def _delayed_signals() -> Iterator[None]:
    """Handle SIGINT and SIGTERM only after the block.

    A child that starts inside ignores them from its first instruction on. A Ctrl-C goes to all
    processes of a terminal, and this process alone answers it.
    """
    if not hasattr(signal, "pthread_sigmask"):  # not POSIX
        yield
        return
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()  # the first child starts it, and it unblocks signals again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _next_answers(crew: list[_Worker[S]], limits: WorkLimits) -> dict[int, Any]:
    """Wait until a worker answers, dies or runs out of time: the answers by their items' places."""
    busy = [worker for worker in crew if worker.place is not None]
    patience = min(worker.deadline for worker in busy) - time.monotonic()
    ready = wait([worker.answers for worker in busy], max(0.0, patience))
    answers: dict[int, Any] = {}
    for worker in busy:
        assert worker.place is not None
        if worker.answers in ready:
            answers[worker.place] = _received_answer(worker)
        elif time.monotonic() >= worker.deadline:
            worker.end()
            answers[worker.place] = TooSlow(too_slow_words(limits))
        else:
            continue
        worker.place = None
        if worker.answers.closed:
            crew.remove(worker)
    return answers


def _received_answer(worker: _Worker[S]) -> Any:
    """The answer, or the error for the item of a dead worker.

    Raises
    ------
    Exception
        Whatever ``work`` raised.
    """
    try:
        answer, error = worker.answers.recv()
    except (EOFError, OSError):
        worker.process.join()
        code = worker.process.exitcode or 0
        worker.end()
        if code == -getattr(signal, "SIGKILL", 9):
            return TooLarge(f"the process that worked on it was killed (out of memory?): {SLIM}")
        return UnreadableFile(
            f"the process that worked on it died (exit {code}): leave this file out, and please"
            " report it"
        )
    if error is not None:
        raise error
    return answer


def _serve(orders: Connection, answers: Connection, work: Callable[[S], T]) -> None:
    """In a worker: answer items until the orders end. The parent alone answers Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):  # it started with its signals blocked
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTERM})
    while True:
        try:
            item = orders.recv()
        except EOFError:
            return
        try:
            answer: tuple[T | None, Exception | None] = work(item), None
        except Exception as error:  # noqa: BLE001 - handed to the parent, which raises it
            error.add_note(f"in a worker: {traceback.format_exc()}")
            answer = None, error
        try:
            answers.send(answer)
        except OSError:  # the parent is gone
            return
