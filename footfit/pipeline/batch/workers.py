"""A few processes that work on items one at a time, each watched by this one.

``concurrent.futures`` cannot say which item a dead worker had, nor end one that hangs; here each
worker has its own pipes, so that both are known, and the others go on.
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
from footfit.pipeline.batch.work_limits import SLIM, WorkLimits, out_of_time

S = TypeVar("S")
T = TypeVar("T")
AHEAD_PER_JOB = 2
"""Items begun, for each worker, before the first of them is answered: bounds what waits."""


@dataclass(slots=True)
class _Worker(Generic[S]):
    """A process, this end of its two pipes, and which item it has since when."""

    process: SpawnProcess
    orders: Connection
    answers: Connection
    place: int | None = None
    since: float = 0.0

    def begin(self, place: int, item: S) -> None:
        self.place, self.since = place, time.monotonic()
        with suppress(OSError):  # dead already: its pipe's end tells
            self.orders.send(item)

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.orders.close()
        self.answers.close()


def worked(
    work: Callable[[S], T], items: Sequence[S], jobs: int, limits: WorkLimits
) -> Iterator[T | FootfitError]:
    """What ``work`` gives for each item, in order, from ``jobs`` processes.

    Spawned, not forked: a catalogue that is open in this process must not be carried into a child
    (SQLite forbids it). An item whose worker dies or outlives the limits gives an error instead;
    an exception of ``work`` is raised here.
    """
    crew: list[_Worker[S]] = []
    answers: dict[int, T | FootfitError] = {}
    begun = 0
    try:
        for awaited in range(len(items)):
            while awaited not in answers:
                for worker in _idle(crew, work, jobs):
                    if begun < min(len(items), awaited + AHEAD_PER_JOB * jobs):
                        worker.begin(begun, items[begun])
                        begun += 1
                answers |= _answered(crew, limits)
            yield answers.pop(awaited)
    finally:
        for worker in crew:
            worker.end()


def _idle(crew: list[_Worker[S]], work: Callable[[S], T], jobs: int) -> list[_Worker[S]]:
    """The workers that have no item, once there are ``jobs`` of them again."""
    context = get_context("spawn")
    while len(crew) < jobs:
        taken, orders = context.Pipe(duplex=False)  # one both ways would be a socket
        answers, given = context.Pipe(duplex=False)
        process = context.Process(target=_serve, args=(taken, given, work), daemon=True)
        with _signals_put_off():  # or a worker could be begun that nobody knows of and ends
            process.start()
            crew.append(_Worker(process, orders, answers))
        taken.close()
        given.close()
    return [worker for worker in crew if worker.place is None]


@contextmanager
def _signals_put_off() -> Iterator[None]:
    """Hear SIGINT and SIGTERM only after the block.

    A child that is begun inside is deaf to them from its first instruction on: a Ctrl-C, which
    goes to all processes of a terminal, is answered by this one alone.
    """
    if not hasattr(signal, "pthread_sigmask"):  # not POSIX
        yield
        return
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()  # the first child starts it, and it lifts the mask again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _answered(crew: list[_Worker[S]], limits: WorkLimits) -> dict[int, Any]:
    """Wait until a worker answers, dies or runs out of time: its item's place and answer."""
    busy = [worker for worker in crew if worker.place is not None]
    deadline = min(worker.since for worker in busy) + limits.seconds + limits.grace_seconds
    ready = wait([worker.answers for worker in busy], max(0.0, deadline - time.monotonic()))
    found: dict[int, Any] = {}
    for worker in busy:
        assert worker.place is not None
        place = worker.place
        if worker.answers in ready:
            found[place] = _received(worker)
        elif time.monotonic() >= worker.since + limits.seconds + limits.grace_seconds:
            worker.end()
            found[place] = TooSlow(out_of_time(limits))
        else:
            continue
        worker.place = None
        if worker.answers.closed:
            crew.remove(worker)
    return found


def _received(worker: _Worker[S]) -> Any:
    """The answer, or the error that a dead worker's item gets.

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
        return _obituary(code)
    if error is not None:
        raise error
    return answer


def _obituary(exit_code: int) -> FootfitError:
    """What to say of a file whose worker died."""
    if exit_code == -getattr(signal, "SIGKILL", 9):
        return TooLarge(f"the process that worked on it was killed (out of memory?): {SLIM}")
    return UnreadableFile(
        f"the process that worked on it died (exit {exit_code}): leave this file out, and"
        " please report it"
    )


def _serve(orders: Connection, answers: Connection, work: Callable[[S], T]) -> None:
    """In a worker: answer items until the orders end. The parent alone answers Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):  # as it was begun, it hears nothing
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
