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
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import footfit
from benchmarks.big_catalogues import make_catalogue, measured_lasts
from benchmarks.search_peers import PEERS, installed, vectors_of, write_profiles
from benchmarks.storing import SEED, storing
from benchmarks.tables import markdown, put
from footfit.catalogue.blocks.search_file import search_path
from footfit.geometry.flare.definition import CHANNELS

ROOT = Path(__file__).resolve().parents[1]
FOOT = ROOT / "sample_data" / "feet" / "mh008_R.stl"
MOST_STORED = 10_000
"""The peer of storing keeps all rows in memory."""
PROCESS = """
import resource, subprocess, sys
code = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(code, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)
"""
"""Processor seconds and peak MB of a process, from a small parent."""
PEERS_MODULE, EXACT = ("-m", "benchmarks.search_peers"), "exact"
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


def searched(*command: str) -> tuple[float, float, list[str]]:
    """Cold and warm seconds of a search in a process of its own, and what it found."""
    done = subprocess.run(
        [sys.executable, *command],
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
        env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
    )
    cold, warm, *found = done.stdout.split()
    return float(cold), float(warm), found


@dataclass(frozen=True, slots=True)
class Searched:
    """The seconds of the searches by flare in one catalogue: the medians of some runs.

    ``first`` is a search after a change, which also makes the search file. ``cold`` and ``warm``
    have the ratios to brute force, of whole runs in turn; ``peers`` the cold and warm seconds of
    each peer.
    """

    first_s: float
    cold_s: float
    warm_s: float
    cold: float
    warm: float
    peers: dict[str, tuple[float, float]]


def search_row(path: Path, folder: Path, runs: int) -> Searched:
    """The searches by flare in a catalogue, in turn with all peers that are installed."""
    foot = footfit.flare(FOOT).flare
    names = write_profiles(path, folder, foot.stations)
    width = vectors_of(np.zeros((1, len(CHANNELS), len(foot.stations))), foot.stations).shape[1]
    peers = installed()
    for name in peers:
        process(sys.executable, *PEERS_MODULE, "make", name, str(folder), str(width))
    search_path(path).unlink(missing_ok=True)
    first_s = searched("-c", SEARCH, str(path), str(FOOT))[0]
    seconds: dict[str, list[tuple[float, float]]] = {name: [] for name in ("footfit", *peers)}
    for run in range(runs + 1):
        ours = searched("-c", SEARCH, str(path), str(FOOT))
        answers = {
            name: searched(*PEERS_MODULE, "ask", name, str(folder), str(FOOT)) for name in peers
        }
        if ours[2] != [names[int(row)] for row in answers[EXACT][2]]:
            raise RuntimeError(f"{path}: the search and brute force do not agree")
        for name, (cold_s, warm_s, _) in {"footfit": ours, **answers}.items():
            seconds[name] += [(cold_s, warm_s)] * (run > 0)  # the first run fills the disk's cache
    shutil.rmtree(folder)
    ours, exact = np.array(seconds["footfit"]), np.array(seconds[EXACT])
    medians = {name: tuple(np.median(each, axis=0)) for name, each in seconds.items()}
    ratio = np.median(ours / exact, axis=0)
    return Searched(first_s, *medians.pop("footfit"), *ratio, medians)


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
    rows, searches, matches, stores = [], [], [], []
    for size, path in paths.items():
        match_s, ratio, megabytes = match_row(path, paths[sizes[0]], runs)
        searches.append(search_row(path, Path(tempfile.mkdtemp(dir=scratch)), runs))
        matches.append(match_s)
        stored = "-"
        if size <= MOST_STORED:
            store_s, store_ratio, *_ = storing(measured, size, scratch, min(runs, 3))
            stores.append(store_s)
            stored = f"{store_s:.2f} s, {store_ratio:.1f}"
        found = searches[-1]
        rows.append(
            [
                f"{size:,}",
                f"{match_s:.2f} s, {ratio:.2f}",
                f"{megabytes:.0f} MB",
                f"{found.cold_s:.3f} s, {found.cold:.2f}",
                f"{found.warm_s:.3f} s, {found.warm:.2f}",
                f"{found.first_s:.2f} s",
                stored,
            ]
        )
        print(" | ".join(rows[-1]), flush=True)
    head = [
        "lasts",
        f"`match`, times that of {sizes[0]}",
        "its peak memory",
        "search by flare, cold, times memory-mapped brute force",
        "warm, times the same",
        "the first search after a change",
        "storing measured lasts, times writing the same rows in one transaction",
    ]
    fitted = (
        f"Fitted exponents (time grows as lasts to this power): `match`"
        f" {exponent(sizes, matches):.2f}, search cold"
        f" {exponent(sizes, [each.cold_s for each in searches]):.2f}, warm"
        f" {exponent(sizes, [each.warm_s for each in searches]):.2f}, storing"
        f" {exponent(sizes[: len(stores)], stores):.2f}."
    )
    return f"{markdown(head, rows)}\n{fitted}\n\n{peer_table(sizes, searches)}"


def peer_table(sizes: Sequence[int], searches: Sequence[Searched]) -> str:
    """The seconds of each peer by size, cold and warm, and those of footfit."""
    head = ["cold and warm, in seconds", *(f"{size:,} lasts" for size in sizes)]
    rows = [["footfit, with names and ties"]]
    rows[0] += [f"{each.cold_s:.3f}, {each.warm_s:.3f}" for each in searches]
    for name in searches[0].peers:
        pairs = [each.peers[name] for each in searches]
        rows.append([PEERS[name].title, *(f"{cold:.3f}, {warm:.3f}" for cold, warm in pairs)])
    return markdown(head, rows)


if __name__ == "__main__":
    main()
