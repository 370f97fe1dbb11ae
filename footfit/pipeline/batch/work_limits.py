"""How much time and memory the work on one file may take."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from footfit.errors import TooLarge, TooSlow

SLIM = "decimate the mesh first (100,000 faces are plenty)"


@dataclass(frozen=True, slots=True)
class WorkLimits:
    """What the work on one file of a batch may take.

    Attributes
    ----------
    seconds : float
        After so long the work is stopped from inside the process, and the file has failed.
    grace_seconds : float
        So much later a worker that did not stop, because it is in one long call, is killed.
    address_bytes : int
        How much the process may grow while it works.
    """

    seconds: float = 60.0
    grace_seconds: float = 5.0
    address_bytes: int = 3_500_000_000


WORK_LIMITS = WorkLimits()
AGAIN_S = 1.0
"""After the time is up the alarm repeats: a callback may have caught what the first one raised."""


class _OutOfTime(BaseException):
    """The time is up. It is no Exception, so that no reader takes it for a damaged file."""


@contextmanager
def hold_to_limits(limits: WorkLimits = WORK_LIMITS) -> Iterator[None]:
    """Hold the work inside to the limits, if the system can (POSIX).

    Time is limited in the main thread only, because only that one receives the alarm.

    Raises
    ------
    TooSlow, TooLarge
        The time is used up, or the memory.
    """
    try:
        with _alarm(limits.seconds), _address_space(limits.address_bytes):
            yield
    except _OutOfTime:
        raise TooSlow(too_slow_words(limits)) from None
    except MemoryError as error:
        most = limits.address_bytes / 1e9
        raise TooLarge(f"took more than {most:.2g} GB of memory: {SLIM}") from error


def too_slow_words(limits: WorkLimits) -> str:
    """What to say of a file that took too long."""
    return f"took longer than {limits.seconds:.2g} s, the most that one file may: {SLIM}"


def _ring(_number: int, frame: FrameType | None) -> None:
    """Stop the work. An import may catch the exception, so it is stopped at the next alarm."""
    if frame is None or not frame.f_code.co_filename.startswith("<frozen importlib"):
        raise _OutOfTime


@contextmanager
def _alarm(seconds: float) -> Iterator[None]:
    """Raise `_OutOfTime` inside after so long; another alarm's handler is put back afterwards."""
    import threading

    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or not hasattr(signal, "setitimer"):
        yield
        return
    before = signal.signal(signal.SIGALRM, _ring)
    signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0, 0.0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def _address_space(growth_bytes: int) -> Iterator[None]:
    """Let the process grow by so much; a stricter limit that the user has set stays."""
    try:
        import resource
    except ImportError:  # not POSIX
        yield
        return
    used = _address_bytes()
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    wanted = used + growth_bytes if used is not None else resource.RLIM_INFINITY
    allowed = [limit for limit in (soft, wanted) if limit != resource.RLIM_INFINITY]
    if not allowed:
        yield
        return
    resource.setrlimit(resource.RLIMIT_AS, (min(allowed), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def _address_bytes() -> int | None:
    """How much address space this process has; None if there is no /proc."""
    import resource

    try:
        pages = int(Path("/proc/self/statm").read_bytes().split()[0])
    except (OSError, ValueError, IndexError):
        return None
    return pages * resource.getpagesize()
