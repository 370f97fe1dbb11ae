"""Ctrl-C and SIGTERM: the work stops at the next safe moment, or the process ends without it.

Python handles a signal only between two of its own steps. A process in one long call (it waits for
a lock, or it reads a big mesh) would not end before the call does. So a thread receives the signal
too, and ends the process after `PATIENCE_S`. What is stored is safe at any moment, see
docs/reliability.md.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from footfit.errors import ExitCode

PATIENCE_S = 1.5
"""The longest time from the signal to the end of the process; docs/reliability.md promises 2 s."""
RETRY_S = 0.05
"""How often the thread sends a signal again that came while Python imported a module."""
CODES = {signal.SIGINT: ExitCode.INTERRUPTED, signal.SIGTERM: ExitCode.TERMINATED}
_CAUSES = {signal.SIGINT: "interrupted", signal.SIGTERM: "ended by SIGTERM"}


class Stopped(BaseException):
    """A signal ends the work: the exception unwinds the stack, so that no file is half written."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = signal.Signals(number)


class Listener:
    """The signals that this process received, and how many items of its batch are done.

    ``so_far`` are a command's own words about what is done and what to do next.
    """

    def __init__(self) -> None:
        self._held = False
        self._stopping = False
        self._pending: int | None = None
        self._resent = 0
        self.done = 0
        self.total = 0
        self.so_far: str | None = None

    def words(self, number: int) -> str:
        """The line that says why the process ends, and what is stored of the batch."""
        cause = _CAUSES[signal.Signals(number)]
        if self.so_far is not None:
            return f"footfit: {cause}; {self.so_far}"
        if self.total < 2:
            return f"footfit: {cause}; what was confirmed is stored"
        files = f"{self.done} of {self.total} files"
        return f"footfit: {cause} after {files}; their lines say what is done"

    def heed(self) -> None:
        """Let signals raise `Stopped` from now on.

        Raises
        ------
        Stopped
            A signal came while signals were put off.
        """
        self._held = False
        number, self._pending = self._pending, None
        if number is not None:
            self._stopping = True
            raise Stopped(number)

    def put_off(self) -> None:
        """Let signals wait for `heed`, or for the end of patience."""
        self._held = True

    @contextmanager
    def hold(self) -> Iterator[None]:
        """Put signals off until the block ends: what is stored in it is also reported in it."""
        self.put_off()
        try:
            yield
        except BaseException:
            self._held = False
            raise
        self.heed()

    @contextmanager
    def listen(self) -> Iterator[None]:
        """Receive SIGINT and SIGTERM inside the block, put off until `heed`."""
        self._held, self._stopping, self._pending = True, False, None
        self._resent = self.done = self.total = 0
        self.so_far = None
        if threading.current_thread() is not threading.main_thread():
            yield  # Python lets only the main thread set a handler
            return
        # A signal that is ignored stays ignored: the shell does so for jobs in the background.
        numbers = [number for number in CODES if signal.getsignal(number) != signal.SIG_IGN]
        before = {number: signal.signal(number, self._receive) for number in numbers}
        if not hasattr(signal, "pthread_kill"):  # not POSIX: the handlers alone
            try:
                yield
            finally:
                for number, handler in before.items():
                    signal.signal(number, handler)
            return
        read_end, write_end = os.pipe()
        os.set_blocking(write_end, False)
        wakeup = signal.set_wakeup_fd(write_end, warn_on_full_buffer=False)
        # The thread must block these signals from its start. Else it would take a signal that the
        # main thread has blocked, and Python would raise in the main thread all the same.
        blocked = signal.pthread_sigmask(signal.SIG_BLOCK, CODES)
        threading.Thread(target=self._watch, args=(read_end,), daemon=True).start()
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
        try:
            yield
        finally:
            signal.set_wakeup_fd(wakeup)
            os.close(write_end)  # the thread reads the end of the pipe, and ends
            for number, handler in before.items():
                signal.signal(number, handler)

    def _receive(self, number: int, frame: FrameType | None) -> None:
        if self._stopping:  # the thread answers a second signal
            return
        if self._held or _importing(frame):
            self._pending = number
            return
        self._stopping = True
        raise Stopped(number)

    def _watch(self, read_end: int) -> None:
        """In the thread: end the process at a second signal, or at the end of patience."""
        first, deadline = 0, 0.0
        while True:
            ready, _, _ = select.select([read_end], [], [], RETRY_S if first else None)
            byte = os.read(read_end, 1) if ready else b""
            if ready and not byte:
                os.close(read_end)
                return
            if byte and byte[0] in CODES:
                if not first:
                    first, deadline = byte[0], time.monotonic() + PATIENCE_S
                elif self._resent:
                    self._resent -= 1
                else:
                    self._end_at_once(first)
            if first and time.monotonic() > deadline:
                self._end_at_once(first)
            if not ready and self._pending is not None and not self._held:
                self._resent += 1
                signal.pthread_kill(threading.main_thread().ident or 0, first)

    def _end_at_once(self, number: int) -> None:
        with suppress(OSError):
            stderr = sys.__stderr__.fileno() if sys.__stderr__ else 2
            os.write(stderr, f"{self.words(number)}\n".encode())
        if "multiprocessing" in sys.modules:
            from multiprocessing import active_children

            for child in active_children():
                child.kill()
        os._exit(int(CODES[signal.Signals(number)]))


def _importing(frame: FrameType | None) -> bool:
    """Is Python importing a module? It swallows what is raised in the callbacks of an import."""
    return frame is not None and frame.f_code.co_filename.startswith("<frozen importlib")


LISTENER = Listener()
"""One for the process, as its signals are."""
