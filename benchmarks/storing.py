"""What storing measured lasts costs, against writing the same rows in one transaction.

    python -m benchmarks.storing [--lasts 10000] [--runs 3]

Both are taken in turn, and the medians are given. Both are timed by the clock, because they wait
for the disk; the processor's seconds are beside them, because the machines are shared.
"""

from __future__ import annotations

import argparse
import sqlite3
import statistics
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import NamedTuple

from benchmarks.big_catalogues import measured_lasts, perturbed_lasts
from footfit.catalogue.file.engine import SETTINGS
from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.store import open_catalogue

SEED = 20261128
Tables = list[tuple[str, int, list[tuple[object, ...]]]]


class Storing(NamedTuple):
    """Seconds of storing by the clock and of the processor, and both as ratios to the peer."""

    seconds: float
    ratio: float
    processor_s: float
    processor_ratio: float


def storing(measured: Sequence[NewLast], count: int, folder: Path, runs: int) -> Storing:
    """The medians of some runs, in which lasts are stored and their rows are written again."""
    taken = [_stored(measured, count, folder) for _ in range(runs)]
    return Storing(*(statistics.median(values) for values in zip(*taken, strict=True)))


def _stored(measured: Sequence[NewLast], count: int, folder: Path) -> Storing:
    lasts = list(perturbed_lasts(measured, count, SEED))
    path, copy = folder / "stored.footfit", folder / "copy.footfit"
    for each in (path, copy):
        each.unlink(missing_ok=True)
    with open_catalogue(path, write=True) as catalogue:
        seconds, processor_s = _taken(lambda: sum(1 for _ in catalogue.add_many(lasts)))
    lasts.clear()
    tables = _tables(path)
    with open_catalogue(copy, write=True):
        pass
    peer_s, peer_processor_s = _taken(lambda: _write(copy, tables))
    for each in (path, copy):
        each.unlink()
    return Storing(seconds, seconds / peer_s, processor_s, processor_s / peer_processor_s)


def _tables(path: Path) -> Tables:
    """Every row of every table, and the number of its columns."""
    with closing(sqlite3.connect(path)) as connection:
        select = "SELECT name FROM sqlite_schema WHERE type = 'table'"
        names = [str(name) for (name,) in connection.execute(select) if name != "alembic_version"]
        rows = [(name, connection.execute(f"SELECT * FROM {name}").fetchall()) for name in names]
    return [(name, len(found[0]), found) for name, found in rows if found]


def _write(path: Path, tables: Tables) -> None:
    """Write rows into the same tables, with the same settings, in one transaction."""
    with closing(sqlite3.connect(path)) as connection, connection:
        for pragma in SETTINGS.for_writers:
            connection.execute(pragma)
        for name, columns, rows in tables:
            places = ", ".join("?" * columns)
            connection.executemany(f"INSERT INTO {name} VALUES ({places})", rows)


def _taken(work: Callable[[], object]) -> tuple[float, float]:
    """Seconds by the clock and of the processor."""
    start_s, start_processor_s = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - start_s, time.process_time() - start_processor_s


def main() -> None:
    """Print one line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lasts", type=int, default=10_000)
    parser.add_argument("--runs", type=int, default=3)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        found = storing(measured_lasts(Path(name)), asked.lasts, Path(name), asked.runs)
    print(
        f"{asked.lasts} lasts: {found.seconds:.2f} s, {found.ratio:.2f} times the peer;"
        f" processor {found.processor_s:.2f} s, {found.processor_ratio:.2f} times"
    )


if __name__ == "__main__":
    main()
