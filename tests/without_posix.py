"""Take away what only POSIX has, so that a run here meets what a shop's Windows lacks.

`take_away` is called first of all in a process. Modules of POSIX cannot be imported after it, and
`signal` and `os` have the names of Windows. Windows also refuses to rename or to delete a file
that a process has open: so do `os.rename`, `os.replace` and `os.unlink` after it.

What stays: `os.name`, and what Python and NumPy need to start processes on this system.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib.abc import MetaPathFinder
from pathlib import Path
from typing import Any

MODULES = ("fcntl", "grp", "pty", "pwd", "readline", "resource", "syslog", "termios", "tty")
SIGNALS_OF_WINDOWS = (
    *("SIGABRT", "SIGFPE", "SIGILL", "SIGINT", "SIGSEGV", "SIGTERM", "SIG_DFL", "SIG_IGN"),
    *("default_int_handler", "getsignal", "raise_signal", "set_wakeup_fd", "signal"),
    *("strsignal", "valid_signals"),
)
LACKING_IN_OS = (
    *("chown", "fchmod", "fchown", "fork", "forkpty", "getegid", "geteuid", "getgid", "getloadavg"),
    *("getpgid", "killpg", "link", "lockf", "mkfifo", "mknod", "pipe2", "posix_fallocate"),
    *("pread", "pwrite", "sched_getaffinity", "set_blocking", "setsid", "statvfs", "sync", "wait"),
    *("O_CLOEXEC", "O_DIRECTORY", "O_NOCTTY", "O_NOFOLLOW", "O_NONBLOCK", "O_SYNC"),
)
OPEN_FILES = Path("/proc/self/fd")


class _Refusal(MetaPathFinder):
    """Refuses the modules that Windows lacks."""

    def find_spec(self, name: str, *_: Any) -> None:
        if name in MODULES:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


def take_away() -> None:
    """Leave this process with what Windows has."""
    import multiprocessing.popen_fork as processes
    import multiprocessing.resource_tracker
    import multiprocessing.util
    import random
    import subprocess
    import tempfile

    assert random, subprocess and tempfile  # they look for what is taken away when they load
    processes.Popen.kill = processes.Popen.terminate
    multiprocessing.resource_tracker._HAVE_SIGMASK = False
    for name in MODULES:
        sys.modules.pop(name, None)
    sys.meta_path.insert(0, _Refusal())
    for name in dir(signal):
        posix = name.startswith(("SIG", "ITIMER", "Itimer")) or name.islower()
        if posix and name[0] != "_" and name not in SIGNALS_OF_WINDOWS:
            delattr(signal, name)
    for name in LACKING_IN_OS:
        if hasattr(os, name):
            delattr(os, name)
    os.rename = _refused_if_open(os.rename)
    os.replace = _refused_if_open(os.replace)
    os.unlink = _refused_if_open(os.unlink)
    os.remove = os.unlink


def _refused_if_open(act: Callable[..., None]) -> Callable[..., None]:
    def guarded(*paths: Any, **more: Any) -> None:
        wanted = {os.path.realpath(path) for path in paths if not isinstance(path, int)}
        refused = None
        for number in OPEN_FILES.iterdir():
            with suppress(OSError):  # the one that lists the folder is closed again
                shown = number.readlink()
                if str(shown) in wanted and shown.is_file():
                    refused = PermissionError(
                        13, "The process cannot access the file: it is open", str(shown)
                    )
        if refused is not None:
            raise refused
        act(*paths, **more)

    return guarded
