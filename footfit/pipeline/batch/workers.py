"""A few processes that work on calls one at a time, each watched by this one.

``concurrent.futures`` has a pool of processes too. It cannot say which call a dead worker had, and
cannot end one that hangs. Here each worker has its own pipes, so that both are known and the others
go on.
"""

from __future__ import annotations

import atexit
import signal
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing import current_process, get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from multiprocessing.reduction import ForkingPickler
from typing import Any, ParamSpec, TypeVar

from footfit.errors import FootfitError, TooLarge, TooSlow, UnreadableFile
from footfit.pipeline.batch.work_limits import (
    SLIM,
    WORK_LIMITS,
    WorkLimits,
    hold_to_limits,
    too_slow_words,
)

P = ParamSpec("P")
T = TypeVar("T")
SIGNALS = {signal.SIGINT, signal.SIGTERM}


@dataclass(frozen=True, slots=True)
class _Order:
    """A pickled call, and the future that gets its answer."""

    call: bytes
    future: Future[Any]


@dataclass(slots=True, eq=False)
class _Worker:
    """A process, this end of its two pipes, and which order it has until when."""

    process: SpawnProcess
    orders: Connection
    answers: Connection
    order: _Order | None = None
    deadline: float = 0.0

    def begin(self, order: _Order, seconds: float) -> None:
        """Hand the worker an order that it has so many seconds for."""
        self.order, self.deadline = order, time.monotonic() + seconds
        with suppress(OSError):  # the worker has exited; we notice when we read its pipe
            self.orders.send_bytes(order.call)

    def end(self) -> None:
        """Kill the process and close the pipes."""
        self.process.kill()
        self.process.join()
        self.orders.close()
        self.answers.close()


class WorkerPool(Executor):
    """``jobs`` processes behind the interface of ``concurrent.futures``.

    They are spawned, not forked: SQLite forbids that a catalogue which is open in this process is
    carried into a child. A future has a FootfitError if its worker dies, or takes more time or
    memory than ``limits``. A thread hands out the calls, so that no worker waits for the caller.
    """

    def __init__(self, jobs: int, limits: WorkLimits = WORK_LIMITS) -> None:
        self.width, self._limits = jobs, limits
        self._crew: list[_Worker] = []
        self._waiting: deque[_Order] = deque()
        self._lock = threading.Lock()
        self._heard, self._bell = get_context("spawn").Pipe(duplex=False)
        self._thread: threading.Thread | None = None
        self._ending = self._ended = False

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Call ``fn`` in a worker. It must be picklable, and so must its arguments.

        Raises
        ------
        RuntimeError
            The pool is shut down.
        """
        call = ForkingPickler.dumps(partial(fn, *args, **kwargs))
        order = _Order(bytes(call), Future())
        with self._lock:
            if self._ending:
                raise RuntimeError("the pool of workers is shut down")
            self._waiting.append(order)
            if self._thread is None:
                self._thread = threading.Thread(target=self._serve_orders, daemon=True)
                self._thread.start()
                atexit.register(self._leave)
        self._ring()
        return order.future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes after the calls; with ``cancel_futures`` at once, whatever runs."""
        with self._lock:
            self._ending, self._ended = True, self._ended or cancel_futures
        self._ring()
        if wait and self._thread is not None:
            self._thread.join()

    def _leave(self) -> None:
        """End the pool with this process: a child that loses it while it starts writes an error."""
        self.shutdown(cancel_futures=True)

    def _ring(self) -> None:
        """Wake the thread."""
        with suppress(OSError):  # the thread has ended and closed the pipe
            self._bell.send_bytes(b"!")

    def _serve_orders(self) -> None:
        """In the thread: hand out the orders and take the answers until the pool is shut down."""
        try:
            with _blocked_signals():
                while not self._is_done():
                    self._hand_out()
                    self._take_answers()
        except BaseException as error:  # noqa: BLE001 - every caller gets it
            self._fail_all(error)
        finally:
            self._fail_all(None)
            for worker in self._crew:
                worker.end()
            with self._lock:
                self._ending = True
                self._heard.close()
                self._bell.close()
            atexit.unregister(self._leave)

    def _is_done(self) -> bool:
        busy = any(worker.order is not None for worker in self._crew)
        with self._lock:
            return self._ended or (self._ending and not self._waiting and not busy)

    def _hand_out(self) -> None:
        """Give each idle worker an order; make workers while there are fewer than jobs."""
        idle = [each for each in self._crew if each.order is None and each.process.is_alive()]
        while (order := self._next_order()) is not None:
            if not idle and len(self._crew) == self.width:
                with self._lock:
                    self._waiting.appendleft(order)
                return
            if order.future.set_running_or_notify_cancel():
                worker = idle.pop() if idle else _new_worker(self._limits)
                if worker not in self._crew:
                    self._crew.append(worker)
                worker.begin(order, self._limits.seconds + self._limits.grace_seconds)

    def _next_order(self) -> _Order | None:
        with self._lock:
            return self._waiting.popleft() if self._waiting else None

    def _take_answers(self) -> None:
        """Wait until a worker answers, dies or runs out of time, or the caller has an order."""
        deadlines = [worker.deadline for worker in self._crew if worker.order is not None]
        patience = max(0.0, min(deadlines) - time.monotonic()) if deadlines else None
        ready = wait([self._heard, *(worker.answers for worker in self._crew)], patience)
        while self._heard in ready and self._heard.poll():
            self._heard.recv_bytes()
        for worker in list(self._crew):
            order = worker.order
            if worker.answers in ready:
                answer, error = _received_answer(worker)
            elif order is not None and time.monotonic() >= worker.deadline:
                worker.end()
                answer, error = None, TooSlow(too_slow_words(self._limits))
            else:
                continue
            worker.order = None
            if worker.answers.closed:
                self._crew.remove(worker)
            if order is not None:  # an idle worker may die too
                settle(order.future, answer, error)

    def _fail_all(self, error: BaseException | None) -> None:
        """No order that is left can be done: it is cancelled, or has the ``error``."""
        running = [worker.order for worker in self._crew if worker.order is not None]
        with self._lock:
            self._ending = True
            left = [*running, *self._waiting]
            self._waiting.clear()
        for order in left:
            if error is not None:
                settle(order.future, None, error)
            elif not order.future.cancel():
                settle(order.future, None, RuntimeError("the pool of workers was shut down"))
        for worker in self._crew:
            worker.order = None


def settle(future: Future[Any], answer: object, error: BaseException | None) -> None:
    """Give a future its answer or its error."""
    if future.done():
        return
    if error is None:
        future.set_result(answer)
    else:
        future.set_exception(error)


def _new_worker(limits: WorkLimits) -> _Worker:
    context = get_context("spawn")
    taken, orders = context.Pipe(duplex=False)  # a pipe for both ways would be a socket
    answers, given = context.Pipe(duplex=False)
    process = context.Process(target=_serve, args=(taken, given, limits), daemon=True)
    with _allowed_children():
        process.start()
    taken.close()
    given.close()
    return _Worker(process, orders, answers)


@contextmanager
def _allowed_children() -> Iterator[None]:
    """Let this process have children, also if it is a daemonic one: a worker of a cluster.

    Python forbids it because such a child could outlive its parent. Ours ends when its pipe does.
    """
    settings = current_process()._config  # type: ignore[attr-defined]
    daemonic = settings.get("daemon")
    settings["daemon"] = False
    try:
        yield
    finally:
        settings["daemon"] = daemonic


@contextmanager
def _blocked_signals() -> Iterator[None]:
    """Block SIGINT and SIGTERM in this thread.

    A child that starts inside ignores them from its first instruction on. A Ctrl-C goes to all
    processes of a terminal, and the main thread of this process alone answers it.
    """
    if not hasattr(signal, "pthread_sigmask"):  # not POSIX
        yield
        return
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()  # the first child starts it, and it unblocks signals again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _received_answer(worker: _Worker) -> tuple[Any, BaseException | None]:
    """The answer of a worker or the error of its call; of a dead worker an error."""
    try:
        answer: tuple[Any, BaseException | None] = worker.answers.recv()
        return answer
    except (EOFError, OSError):
        worker.process.join()
        code = worker.process.exitcode or 0
        worker.end()
    except Exception as error:  # noqa: BLE001 - the answer does not unpickle: the caller gets it
        return None, error
    if code == -getattr(signal, "SIGKILL", 9):
        words = f"the process that worked on it was killed (out of memory?): {SLIM}"
        return None, TooLarge(words)
    words = f"the process that worked on it died (exit {code}): leave this file out, and please"
    return None, UnreadableFile(f"{words} report it")


def _serve(orders: Connection, answers: Connection, limits: WorkLimits) -> None:
    """In a worker: answer calls until the orders end. The parent alone answers Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):  # it started with its signals blocked
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTERM})
    while True:
        try:
            call = orders.recv_bytes()
        except EOFError:
            return
        try:
            work = ForkingPickler.loads(call)
            with hold_to_limits(limits):
                answer: tuple[Any, Exception | None] = work(), None
        except FootfitError as error:
            answer = None, error
        except Exception as error:  # noqa: BLE001 - handed to the parent, which raises it
            error.add_note(f"in a worker: {traceback.format_exc()}")
            answer = None, error
        try:
            answers.send(answer)
        except OSError:  # the parent is gone
            return
