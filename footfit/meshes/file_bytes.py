"""The bytes of a regular file or a stream, up to the largest size that is read."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import BinaryIO

from footfit.errors import EmptyMesh, FootfitError, TooLarge, UnreadableFile
from footfit.meshes.read_limits import SIMPLIFY, Limits

_READ_FLAGS = (
    os.O_RDONLY
    | getattr(os, "O_NONBLOCK", 0)  # a FIFO may replace the file between stat and open
    | getattr(os, "O_NOCTTY", 0)
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)  # Windows would translate line ends
)

_PIECE_BYTES = 4_000_000


def file_bytes(path: str, limits: Limits) -> bytes:
    """Everything in a regular file.

    The path is checked before it is opened, since opening a FIFO waits and opening a device may
    act. It is checked again when it is open, since another file may have taken its place.

    Raises
    ------
    UnreadableFile
        Missing, not a regular file, or not permitted.
    TooLarge
        The file is over ``limits.file_bytes``; nothing has been read then.
    EmptyMesh
        The file has zero bytes.
    """
    try:
        _check(Path(path).stat(), limits)
        descriptor = os.open(path, _READ_FLAGS)
        with os.fdopen(descriptor, "rb") as stream:
            _check(os.fstat(descriptor), limits)
            return stream_bytes(stream, limits, os.fstat(descriptor).st_size)
    except FootfitError as error:
        raise error.at(path) from error
    except (OSError, ValueError) as error:  # ValueError: a name with a NUL in it
        raise UnreadableFile(_reason(error), path) from error


def stream_bytes(stream: BinaryIO, limits: Limits, expected: int = 0) -> bytes:
    """Everything in an open binary stream, such as standard input.

    It is read piece by piece. To ask for ``limits.file_bytes`` at once would take that much memory
    for the smallest stream.

    Parameters
    ----------
    stream : binary file
    limits : Limits
    expected : int
        The likely size, so that the pieces need not be joined.

    Raises
    ------
    TooLarge
        The stream is longer than ``limits.file_bytes``.
    EmptyMesh
        The stream has zero bytes.
    """
    pieces, size = [stream.read(expected + 1)], 0
    while pieces[-1]:
        size += len(pieces[-1])
        if size > limits.file_bytes:
            raise TooLarge(_too_large(limits))
        pieces.append(stream.read(_PIECE_BYTES))
    data = pieces[0] if len(pieces) == 2 else b"".join(pieces)
    if not data:
        raise EmptyMesh("the file is empty (0 bytes): export it again")
    return data


def _check(status: os.stat_result, limits: Limits) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise UnreadableFile("this is a folder: give the mesh files in it")
    if not stat.S_ISREG(status.st_mode):
        raise UnreadableFile(
            "this is a pipe, socket or device: give a regular file, or - for stdin"
        )
    if status.st_size > limits.file_bytes:
        raise TooLarge(_too_large(limits))


def _too_large(limits: Limits) -> str:
    return (
        f"the file is over {limits.file_bytes // 1_000_000:,} MB, the most that footfit reads:"
        f" {SIMPLIFY}"
    )


def _reason(error: OSError | ValueError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file: check the path"
    if isinstance(error, PermissionError):
        return "you may not read this file: change its permissions"
    words = error.strerror if isinstance(error, OSError) else None
    return f"the file cannot be read ({words or 'its name is not valid'}): check the path"
