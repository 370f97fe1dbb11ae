"""Ctrl-C and SIGTERM: the work unwinds at the next safe moment, or the process ends without it.

Python hears a signal between two of its own steps only. A process that sits in one long call (a
lock that another program holds, a big mesh) would not end for as long as that takes. So a thread
hears it too, and ends the process when `PATIENCE_S` are over; what is stored is safe at any
moment (docs/reliability.md).
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
"""From the signal to the end of the process at the latest, short of the two seconds promised."""
KNOCK_S = 0.05
"""How often the thread looks whether a signal that came at a bad moment can be heard now."""
CODES = {signal.SIGINT: ExitCode.INTERRUPTED, signal.SIGTERM: ExitCode.TERMINATED}
_WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "ended by SIGTERM"}


class Stopped(BaseException):
    """A signal asks to end: unwinds the stack, so that nothing is left half written."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = signal.Signals(number)


class Listener:
    """What this process has heard, and how far its batch is."""

    def __init__(self) -> None:
        self._held = False
        self._stopping = False
        self._pending: int | None = None
        self._knocks = 0
        self.done = 0
        self.total = 0

    def words(self, number: int) -> str:
        """The line that says why the process ends, and what became of the batch."""
        what = _WORDS[signal.Signals(number)]
        if self.total < 2:
            return f"footfit: {what}; what was confirmed is stored"
        return (
            f"footfit: {what} after {self.done} of {self.total} files; their lines say what is done"
        )

    def heed(self) -> None:
        """From here on a signal raises `Stopped`, one that came before as well.

        Raises
        ------
        Stopped
            One came while it was put off.
        """
        self._held = False
        number, self._pending = self._pending, None
        if number is not None:
            self._stopping = True
            raise Stopped(number)

    def put_off(self) -> None:
        """From here on a signal waits for `heed`, or for the end of patience."""
        self._held = True

    @contextmanager
    def hold(self) -> Iterator[None]:
        """Put a signal off until the block is over: what is stored in it is also said in it."""
        self.put_off()
        try:
            yield
        except BaseException:
            self._held = False
            raise
        self.heed()

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Hear SIGINT and SIGTERM inside, put off until `heed`; outside all is as it was."""
        self._held, self._stopping, self._pending = True, False, None
        self._knocks = self.done = self.total = 0
        if threading.current_thread() is not threading.main_thread():
            yield  # Python lets only the main thread set a handler
            return
        # What is ignored stays so: a job that a script put into the background.
        heard = [number for number in CODES if signal.getsignal(number) != signal.SIG_IGN]
        before = {number: signal.signal(number, self._hear) for number in heard}
        if not hasattr(signal, "pthread_kill"):  # not POSIX: the handlers alone
            yield
            return
        ear, mouth = os.pipe()
        os.set_blocking(mouth, False)
        wakeup = signal.set_wakeup_fd(mouth, warn_on_full_buffer=False)
        # Deaf from its first moment on: else it would take a signal that the main thread has
        # blocked, and Python would raise there all the same.
        blocked = signal.pthread_sigmask(signal.SIG_BLOCK, CODES)
        threading.Thread(target=self._watch, args=(ear,), daemon=True).start()
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
        try:
            yield
        finally:
            signal.set_wakeup_fd(wakeup)
            os.close(mouth)  # the thread's sign to end
            for number, handler in before.items():
                signal.signal(number, handler)

    def _hear(self, number: int, frame: FrameType | None) -> None:
        if self._stopping:  # the second one is the thread's to answer
            return
        if self._held or _importing(frame):
            self._pending = number
            return
        self._stopping = True
        raise Stopped(number)

    def _watch(self, ear: int) -> None:
        """In the thread: a second signal, or the end of patience, ends the process at once."""
        heard, deadline = 0, 0.0
        while True:
            ready, _, _ = select.select([ear], [], [], KNOCK_S if heard else None)
            said = os.read(ear, 1) if ready else b""
            if ready and not said:
                os.close(ear)
                return
            if said and said[0] in CODES:
                if not heard:
                    heard, deadline = said[0], time.monotonic() + PATIENCE_S
                elif self._knocks:
                    self._knocks -= 1
                else:
                    self._end_at_once(heard)
            if heard and time.monotonic() > deadline:
                self._end_at_once(heard)
            if not ready and self._pending is not None and not self._held:
                self._knocks += 1
                signal.pthread_kill(threading.main_thread().ident or 0, heard)

    def _end_at_once(self, number: int) -> None:
        with suppress(OSError):
            os.write(sys.__stderr__.fileno() if sys.__stderr__ else 2, self._line(number))
        if "multiprocessing" in sys.modules:
            from multiprocessing import active_children

            for child in active_children():
                child.kill()
        os._exit(int(CODES[signal.Signals(number)]))

    def _line(self, number: int) -> bytes:
        return (self.words(number) + "\n").encode()


def _importing(frame: FrameType | None) -> bool:
    """Is Python in the middle of an import, whose own callbacks swallow what is raised in them?"""
    return frame is not None and frame.f_code.co_filename.startswith("<frozen importlib")


LISTENER = Listener()
"""One for the process, as its signals are."""
