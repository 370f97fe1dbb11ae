"""Commands in a copy of the tree, each ended with everything that it began."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

MEMORY_BYTES = 12 * 1024**3
"""What a process may ask of the memory: a mutant can ask for all."""

_RUNNING: set[int] = set()


def run(
    command: Sequence[str],
    tree: Path,
    environment: Mapping[str, str],
    seconds: float | None = None,
    output: IO[bytes] | None = None,
) -> int:
    """The exit code of a command; -1 where it takes longer than ``seconds``."""
    process = subprocess.Popen(
        command,
        cwd=tree,
        env=environment,
        stdout=subprocess.DEVNULL if output is None else output,
        stderr=subprocess.STDOUT,
        start_new_session=True,
        preexec_fn=_limit_memory,
    )
    _RUNNING.add(process.pid)
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        return -1
    finally:
        _RUNNING.discard(process.pid)
        _kill(process.pid)
        process.wait()


@contextmanager
def workers(count: int) -> Iterator[ThreadPoolExecutor]:
    """Threads that wait for commands; where the work is given up, what runs is killed."""
    pool = ThreadPoolExecutor(count)
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for pid in list(_RUNNING):
            _kill(pid)
        raise
    finally:
        pool.shutdown()


def _kill(group: int) -> None:
    with suppress(ProcessLookupError):
        os.killpg(group, signal.SIGKILL)


def _limit_memory() -> None:
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY_BYTES, MEMORY_BYTES))
