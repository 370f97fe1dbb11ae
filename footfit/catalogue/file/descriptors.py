"""Descriptors of catalogue files, closed only when no lock of this process goes with them.

POSIX gives a process one set of locks on a file, and drops it when the process closes *any*
descriptor of that file. SQLite knows this of its own descriptors; whatever footfit opens beside
them (to look at a header, to copy bytes) has to be closed here.
"""

from __future__ import annotations

import os
import sqlite3
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

FileId = tuple[int, int]
"""The device and the inode of a file."""
_READING = (
    os.O_RDONLY
    | getattr(os, "O_NONBLOCK", 0)  # a FIFO in the file's place is no reason to wait
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)
)


class Handles:
    """Which files this process has open through SQLite, and the descriptors that wait for them."""

    def __init__(self) -> None:
        self._alone = threading.Lock()
        self._connections: Counter[FileId] = Counter()
        self._waiting: dict[FileId, list[int]] = {}

    def connect(self, path: Path, open_it: Callable[[], FileConnection]) -> FileConnection:
        """Open a connection to ``path``, which is known here until it is closed."""
        with self._alone:  # opening takes no lock of the file, and does not wait for one
            connection = open_it()
            try:
                connection.file = _file_id(path.stat())
            except OSError:  # gone again: nobody else can have it
                return connection
            self._connections[connection.file] += 1
        return connection

    def disconnected(self, file: FileId) -> None:
        """One connection to ``file`` is closed; with the last one, the descriptors are too."""
        with self._alone:
            self._connections[file] -= 1
            if self._connections[file] > 0:
                return
            del self._connections[file]
            for descriptor in self._waiting.pop(file, ()):
                os.close(descriptor)

    def close(self, descriptor: int) -> None:
        """Close a descriptor, now or when the last connection to its file is closed."""
        file = _file_id(os.fstat(descriptor))
        with self._alone:
            if file in self._connections:
                self._waiting.setdefault(file, []).append(descriptor)
            else:
                os.close(descriptor)

    def first_bytes(self, path: Path, count: int) -> bytes:
        """How a file begins. A descriptor that waits is read again: not one more for each look.

        Raises
        ------
        OSError
            The system does not let us.
        """
        file = _file_id(path.stat())
        with self._alone:
            if waiting := self._waiting.get(file):
                os.lseek(waiting[0], 0, os.SEEK_SET)
                return os.read(waiting[0], count)
        with opened(path) as stream:
            return stream.read(count)


HANDLES = Handles()
"""One for the process, as its locks are."""


class FileConnection(sqlite3.Connection):
    """A connection that `HANDLES` knows of until it is closed."""

    file: FileId | None = None

    def close(self) -> None:
        """Close it; a second time does nothing."""
        super().close()
        file, self.file = self.file, None
        if file is not None:
            HANDLES.disconnected(file)


@contextmanager
def opened(path: Path) -> Iterator[BinaryIO]:
    """A file to read bytes from, beside SQLite.

    Raises
    ------
    OSError
        The system does not open it.
    """
    descriptor = os.open(path, _READING)
    try:
        with os.fdopen(descriptor, "rb", closefd=False) as file:
            yield file
    finally:
        HANDLES.close(descriptor)


def _file_id(status: os.stat_result) -> FileId:
    return status.st_dev, status.st_ino
