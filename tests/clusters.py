"""A Dask scheduler and its workers on 127.0.0.1, started by a test and ended after it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from footfit.pipeline.batch.sources import Source

ROOT = Path(__file__).resolve().parents[1]
AT_ONCE = "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES"
"""With 0 Dask gives up a task when its first worker dies: footfit has to send it again."""


def path_and_size(source: Source) -> str:
    """What a worker sees of an item: its bytes have travelled."""
    assert source.data is not None
    return f"{source.path} {len(source.data)}"


def failing(source: Source) -> str:
    """Work with a bug."""
    raise ValueError(source.path)


@dataclass
class LocalCluster:
    """A scheduler with workers of one thread each."""

    folder: Path
    address: str = ""
    processes: list[subprocess.Popen[bytes]] = field(default_factory=list)

    def start(self, program: str, *options: str) -> subprocess.Popen[bytes]:
        """Start a scheduler or a worker."""
        environment = os.environ | {
            AT_ONCE: "0",
            "PYTHONPATH": str(ROOT),
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
        }
        command = [sys.executable, "-m", f"distributed.cli.dask_{program}", *options]
        log = (self.folder / f"{program}-{len(self.processes)}.log").open("wb")
        process = subprocess.Popen(
            [*command, "--no-dashboard"], cwd=self.folder, env=environment, stdout=log, stderr=log
        )
        log.close()
        self.processes.append(process)
        return process

    def client(self) -> Any:
        """A client of the test's own."""
        import distributed

        return distributed.Client(self.address, timeout="60s", set_as_default=False)

    def pids(self) -> list[int]:
        """The process of each worker, as the workers say it."""
        with self.client() as client:
            pids: dict[str, Any] = client.run(os.getpid)
            return list(pids.values())


@contextmanager
def local_cluster(folder: Path, workers: int = 2) -> Iterator[LocalCluster]:
    """A cluster in a folder; its workers are replaced when they die."""
    cluster = LocalCluster(folder)
    where = folder / "scheduler.json"
    try:
        cluster.start("scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", where)
        for _ in range(workers):
            local = ("--host", "127.0.0.1", "--nthreads", "1", "--local-directory", str(folder))
            cluster.start("worker", "--scheduler-file", str(where), *local)
        cluster.address = _address(where, cluster.processes[0])
        with cluster.client() as client:
            client.wait_for_workers(workers, timeout=60)
        yield cluster
    finally:
        for process in reversed(cluster.processes):
            process.terminate()
        for process in cluster.processes:
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _address(where: Path, scheduler: subprocess.Popen[bytes]) -> str:
    """The scheduler's address, as it writes it when it listens."""
    import json
    import time

    deadline = time.monotonic() + 30
    while time.monotonic() < deadline and scheduler.poll() is None:
        try:
            return str(json.loads(where.read_text())["address"])
        except (OSError, ValueError, KeyError):
            time.sleep(0.05)
    raise AssertionError("the scheduler did not start")
