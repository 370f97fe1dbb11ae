"""How a match and the storing of lasts grow with the catalogue, against peers in the same run.

    python -m benchmarks.growth [--sizes 100 1000 10000] [--runs 5] [--folder F] [--write]

Sizes go up to 1000000. A catalogue of 10,000 lasts takes 0.3 GB; ``--folder`` keeps the catalogues
for the next run. Times are processor seconds, because the machines are shared: whole processes are
taken in turn with the smallest catalogue, and the median of the ratios is given. Only storing is
timed by the clock, because it waits for the disk.
"""

from __future__ import annotations

import argparse
import math
import os
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path

import numpy as np

from benchmarks.big_catalogues import make_catalogue, measured_lasts, perturbed_lasts
from benchmarks.tables import markdown, put
from footfit.catalogue.file.engine import SETTINGS
from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.store import open_catalogue

ROOT = Path(__file__).resolve().parents[1]
FOOT = ROOT / "sample_data" / "feet" / "mh008_R.stl"
SEED = 20261128
MOST_STORED = 10_000
"""The peer of storing keeps all rows in memory."""
PROCESS = """
import resource, subprocess, sys
code = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(code, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)
"""
"""Processor seconds and peak MB of a process, from a small parent."""
SEARCH = """
import sys, time
from pathlib import Path
import footfit
from footfit.pipeline.fit.fit_profile import fit_profile
from footfit.pipeline.fit.judging.judged_lasts import asked_of
from footfit.pipeline.fit.ranking import ranking
from footfit.pipeline.shelf.candidates import choice
foot = footfit.flare(sys.argv[2])
asked = asked_of([foot], fit_profile(), "flare")
times = []
for _ in range(4):
    start = time.process_time()
    if not times:
        shelf = choice(Path(sys.argv[1]), None, None)
    answer = ranking(asked, shelf.lasts, shelf.ranked, 5, 3)
    times.append(time.process_time() - start)
print(times[0], min(times[2:]), *answer.names[:5])
"""
"""The search by flare over blocks: cold with the reading of the lasts, then warm."""
PEER = """
import sys, time
import numpy as np
import footfit
from footfit.geometry.flare.definition import CHANNELS
from footfit.geometry.flare.profile_distance import distance_parts, total_distance
foot = footfit.flare(sys.argv[2])
stations = len(foot.flare.stations)
times = []
for _ in range(4):
    start = time.process_time()
    if not times:
        flat = np.memmap(sys.argv[1], dtype="<f8", mode="r")
        curves = flat.reshape(-1, len(CHANNELS), stations)
    distance = np.empty(len(curves))
    for at in range(0, len(curves), 4096):
        part = curves[at : at + 4096]
        each = [part[:, channel] for channel in range(len(CHANNELS))]
        distance[at : at + 4096] = total_distance(distance_parts(foot.flare, each))
    best = np.argpartition(distance, 5)[:5]
    best = best[np.argsort(distance[best])]
    times.append(time.process_time() - start)
print(times[0], min(times[2:]), *best.tolist())
"""
"""Memory-mapped brute force over the same profiles: every distance, then the five least."""


def process(*command: str) -> tuple[float, float]:
    """Processor seconds and peak MB of a command."""
    wrapped = [sys.executable, "-S", "-c", PROCESS, *command]
    done = subprocess.run(wrapped, capture_output=True, text=True, check=True)
    code, seconds, megabytes = done.stdout.split()
    if code != "0":
        raise RuntimeError(f"failed: {' '.join(command)}")
    return float(seconds), float(megabytes)


def match_row(path: Path, least: Path, runs: int) -> tuple[float, float, float]:
    """The seconds of a match, the ratio to the smallest catalogue, and its MB."""
    words = [sys.executable, "-m", "footfit", "match", str(FOOT), "--catalogue"]
    process(*words, str(path))
    pairs = [(process(*words, str(path)), process(*words, str(least))) for _ in range(runs)]
    ratio = statistics.median(own[0] / other[0] for own, other in pairs)
    seconds = statistics.median(own[0] for own, _ in pairs)
    return seconds, ratio, max(own[1] for own, _ in pairs)


def searched(script: str, *arguments: str) -> tuple[float, float, list[str]]:
    """Cold and warm seconds of a search in a process of its own, and what it found."""
    done = subprocess.run(
        [sys.executable, "-c", script, *arguments],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
    )
    cold, warm, *found = done.stdout.split()
    return float(cold), float(warm), found


def search_row(path: Path, folder: Path, runs: int) -> tuple[float, float, float]:
    """The seconds of a search by flare, and its ratios to brute force, cold and warm."""
    flat, names = folder / "profiles.f8", []
    with open_catalogue(path) as catalogue, flat.open("wb") as file:
        for _, part in catalogue.block_lasts().chunks(("plan", "bottom")):
            assert part.flare is not None
            assert part.flare.plan is not None
            assert part.flare.bottom is not None
            both = np.concatenate([part.flare.plan[:, None], part.flare.bottom], axis=1)
            file.write(np.ascontiguousarray(both, "<f8").tobytes())
            names += part.names
    cold, warm, seconds = [], [], []
    for _ in range(runs):
        ours, peer = searched(SEARCH, str(path), str(FOOT)), searched(PEER, str(flat), str(FOOT))
        if ours[2] != [names[int(row)] for row in peer[2]]:
            raise RuntimeError(f"{path}: the search and brute force do not agree")
        cold.append(ours[0] / peer[0])
        warm.append(ours[1] / peer[1])
        seconds.append(ours[0])
    flat.unlink()
    return statistics.median(seconds), statistics.median(cold), statistics.median(warm)


def stored(measured: Sequence[NewLast], count: int, folder: Path) -> tuple[float, float]:
    """Seconds of storing measured lasts, and the ratio to writing the same bytes."""
    lasts = list(perturbed_lasts(measured, count, SEED))
    path, copy = folder / "stored.footfit", folder / "copy.footfit"
    for each in (path, copy):
        each.unlink(missing_ok=True)
    with open_catalogue(path, write=True) as catalogue:
        seconds = _wall_s(lambda: sum(1 for _ in catalogue.add_many(lasts)))
    lasts.clear()
    tables = _tables(path)
    with open_catalogue(copy, write=True):
        pass
    peer = _wall_s(lambda: _write(copy, tables))
    for each in (path, copy):
        each.unlink()
    return seconds, seconds / peer


def _tables(path: Path) -> list[tuple[str, int, list[tuple[object, ...]]]]:
    """Every row of every table, and the number of its columns."""
    with closing(sqlite3.connect(path)) as connection:
        select = "SELECT name FROM sqlite_schema WHERE type = 'table'"
        names = [str(name) for (name,) in connection.execute(select) if name != "alembic_version"]
        rows = [(name, connection.execute(f"SELECT * FROM {name}").fetchall()) for name in names]
    return [(name, len(found[0]), found) for name, found in rows if found]


def _write(path: Path, tables: list[tuple[str, int, list[tuple[object, ...]]]]) -> None:
    """Write rows into the same tables, with the same settings, in one transaction."""
    with closing(sqlite3.connect(path)) as connection, connection:
        for pragma in SETTINGS.for_writers:
            connection.execute(pragma)
        for name, columns, rows in tables:
            places = ", ".join("?" * columns)
            connection.executemany(f"INSERT INTO {name} VALUES ({places})", rows)


def _wall_s(work: Callable[[], object]) -> float:
    """Seconds by the clock: storing waits for the disk."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def exponent(sizes: Sequence[int], seconds: Sequence[float]) -> float:
    """The power of the number of lasts that the time grows with: a fitted slope of logarithms."""
    if len(sizes) < 2:
        return math.nan
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def main() -> None:
    """Print the table; with --write put it into docs/speed.md."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 1_000, 10_000])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--folder", type=Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = options.folder or Path(name)
        text = growth(sorted(options.sizes), options.runs, folder, Path(name))
    print(text)
    if options.write:
        put("speed.md", "growth", text)


def growth(sizes: Sequence[int], runs: int, folder: Path, scratch: Path) -> str:
    """The table, and the fitted exponents."""
    folder.mkdir(exist_ok=True)
    measured = measured_lasts(scratch)
    paths = {size: folder / f"lasts-{size}.footfit" for size in sizes}
    for size, path in paths.items():
        if not path.exists():
            make_catalogue(path, measured, size, SEED)
    rows, matches, searches, stores = [], [], [], []
    for size, path in paths.items():
        match_s, ratio, megabytes = match_row(path, paths[sizes[0]], runs)
        search_s, cold, warm = search_row(path, scratch, runs)
        matches.append(match_s)
        searches.append(search_s)
        storing = "-"
        if size <= MOST_STORED:
            store_s, store_ratio = stored(measured, size, scratch)
            stores.append(store_s)
            storing = f"{store_s:.2f} s, {store_ratio:.1f}"
        rows.append(
            [
                f"{size:,}",
                f"{match_s:.2f} s, {ratio:.2f}",
                f"{megabytes:.0f} MB",
                f"{search_s:.3f} s, {cold:.2f}",
                f"{warm:.2f}",
                storing,
            ]
        )
        print(" | ".join(rows[-1]), flush=True)
    head = [
        "lasts",
        f"`match`, times that of {sizes[0]}",
        "its peak memory",
        "search by flare, cold, times memory-mapped brute force",
        "warm, times the same",
        "storing measured lasts, times writing the same rows in one transaction",
    ]
    fitted = (
        f"Fitted exponents (time grows as lasts to this power): `match`"
        f" {exponent(sizes, matches):.2f}, search {exponent(sizes, searches):.2f}, storing"
        f" {exponent(sizes[: len(stores)], stores):.2f}."
    )
    return f"{markdown(head, rows)}\n{fitted}\n"


if __name__ == "__main__":
    main()
