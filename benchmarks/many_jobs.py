"""How much faster an ingest is on several processes, and how much memory its parent takes.

    python -m benchmarks.many_jobs [--lasts 200] [--jobs 1 2] [--scheduler ADDRESS] [--write]

Lasts of 35,000 faces are drawn at random and ingested by a whole command for each number of jobs,
on a catalogue of its own. The start of Python and the first last are in the time. ``--scheduler``
adds a row for a cluster. ``--write`` puts the table into docs/speed.md.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.tables import markdown, put
from footfit.meshes.write import encoded_mesh
from tools.last_specs import varied
from tools.lasts import last_mesh

ONE_CORE = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def write_lasts(folder: Path, count: int) -> None:
    """Files of random lasts."""
    rng = np.random.default_rng(7)
    for number in range(count):
        vertices_mm, faces = last_mesh(varied(rng))
        (folder / f"last-{number:04d}.stl").write_bytes(encoded_mesh(vertices_mm, faces, "stl"))


@dataclass(frozen=True, slots=True)
class Cost:
    """What an ingest took: wall time, processor times of the parent and of its workers, memory."""

    seconds: float
    parent_s: float
    workers_s: float
    parent_mb: float


def ingest_cost(folder: Path, *how: str) -> Cost:
    """What the ingest of a folder takes (Linux: the parent is read from /proc until it ends)."""
    with tempfile.TemporaryDirectory() as place:
        command = [sys.executable, "-m", "footfit", "ingest-last", str(folder), "--side", "right"]
        command += ["--quiet", "--catalogue", f"{place}/lasts.footfit", *how]
        begun_s, before_s = time.perf_counter(), _children_s()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, env=os.environ | ONE_CORE)
        parent_s = parent_mb = 0.0
        while process.poll() is None:
            parent_s, parent_mb = _of_process(process.pid) or (parent_s, parent_mb)
            time.sleep(0.02)
        seconds = time.perf_counter() - begun_s
    assert process.returncode == 0, f"{' '.join(how)}: exit {process.returncode}"
    return Cost(seconds, parent_s, _children_s() - before_s - parent_s, parent_mb)


def _children_s() -> float:
    """The processor time of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _of_process(pid: int) -> tuple[float, float] | None:
    """The processor time in s and the peak memory in MB of a running process; None if it ended."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
        ticks = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[11:13]
        peak_kb = status.partition("VmHWM:")[2].split()[0]
    except (OSError, IndexError):
        return None
    return sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK"), int(peak_kb) / 1024


def main() -> None:
    """Print the table, or write it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lasts", type=int, default=200)
    parser.add_argument("--jobs", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--scheduler")
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    ways = {f"{jobs} job{'s' if jobs > 1 else ''}": ("--jobs", str(jobs)) for jobs in asked.jobs}
    if asked.scheduler:
        ways["the cluster"] = ("--scheduler", asked.scheduler)
    with tempfile.TemporaryDirectory() as place:
        write_lasts(Path(place), asked.lasts)
        costs = {name: ingest_cost(Path(place), *how) for name, how in ways.items()}
    first_s = next(iter(costs.values())).seconds
    rows = [
        (
            name,
            f"{cost.seconds:.1f}",
            f"{first_s / cost.seconds:.2f}",
            f"{cost.workers_s / asked.lasts:.2f}",
            f"{cost.parent_s / asked.lasts:.3f}",
            f"{cost.parent_mb:.0f} MB",
        )
        for name, cost in costs.items()
    ]
    what = f"{asked.lasts} lasts of 35,000 faces"
    head = (
        what,
        "seconds",
        "times as fast",
        "workers' CPU s",
        "parent's CPU s a last",
        "its memory",
    )
    table = markdown(head, rows)
    print(table)
    if asked.write:
        put("speed.md", "jobs", table)


if __name__ == "__main__":
    main()
