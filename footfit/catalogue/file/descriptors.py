"""Descriptors of catalogue files, closed only when no lock of this process is lost by it.

POSIX gives a process one set of locks on a file, and drops them when the process closes *any*
descriptor of that file. SQLite takes care of its own descriptors. footfit opens others beside
them, to look at a header or to copy bytes, and has to close those here.
"""

from __future__ import annotations

import os
import sqlite3
import threading
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, Literal

OpenMode = Literal["ro", "rw", "rwc"]
FileId = tuple[int, int]
"""The device and the inode of a file."""
_READING = (
    os.O_RDONLY
    | getattr(os, "O_NONBLOCK", 0)  # do not wait if a FIFO lies in the file's place
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)
)


class Descriptors:
    """Which files this process has open through SQLite, and the descriptors to close later."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._connections: Counter[FileId] = Counter()
        self._waiting: dict[FileId, list[int]] = {}

    def connect(self, path: Path, mode: OpenMode, busy_timeout_s: float) -> FileConnection:
        """Open a connection to ``path`` in autocommit, and count it until it is closed.

        Raises
        ------
        sqlite3.Error
            SQLite cannot open the file.
        """
        uri = f"{path.absolute().as_uri()}?mode={mode}"
        with self._lock:  # opening takes no lock of the file, and does not wait for one
            connection = sqlite3.connect(
                uri, busy_timeout_s, isolation_level=None, factory=FileConnection, uri=True
            )
            try:
                connection.file = _file_id(path.stat())
            except OSError:  # the file is gone again: nobody else can have it open
                return connection
            self._connections[connection.file] += 1
        return connection

    def release(self, file: FileId) -> None:
        """Note that a connection was closed; after the last one, close what waited for it."""
        with self._lock:
            self._connections[file] -= 1
            if self._connections[file] > 0:
                return
            del self._connections[file]
            for descriptor in self._waiting.pop(file, ()):
                os.close(descriptor)

    def close(self, descriptor: int) -> None:
        """Close a descriptor, now or when the last connection to its file is closed."""
        file = _file_id(os.fstat(descriptor))
        with self._lock:
            if file in self._connections:
                self._waiting.setdefault(file, []).append(descriptor)
            else:
                os.close(descriptor)

    def first_bytes(self, path: Path, count: int) -> bytes:
        """The first bytes of a file.

        A descriptor that waits to be closed is used again, so that many looks at a file do not
        leave many descriptors open.

        Raises
        ------
        OSError
            The system does not let us read it.
        """
        file = _file_id(path.stat())
        with self._lock:
            if waiting := self._waiting.get(file):
                os.lseek(waiting[0], 0, os.SEEK_SET)
                return os.read(waiting[0], count)
        with byte_reader(path) as stream:
            return stream.read(count)


DESCRIPTORS = Descriptors()
"""One for the process, because its locks belong to the process."""


class FileConnection(sqlite3.Connection):
    """A connection that `DESCRIPTORS` counts until it is closed."""

    file: FileId | None = None

    def close(self) -> None:
        """Close it; a second call does nothing."""
        super().close()
        file, self.file = self.file, None
        if file is not None:
            DESCRIPTORS.release(file)


@contextmanager
def byte_reader(path: Path) -> Iterator[BinaryIO]:
    """A file open for reading its bytes, beside SQLite.

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
        DESCRIPTORS.close(descriptor)


def _file_id(status: os.stat_result) -> FileId:
    return status.st_dev, status.st_ino
