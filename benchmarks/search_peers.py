"""What else finds the nearest profiles: brute force over mapped files, and vector libraries.

    python -m benchmarks.search_peers make NAME FOLDER
    python -m benchmarks.search_peers ask NAME FOLDER FOOT

`write_profiles` puts the profiles of all lasts into a folder: as they are (float64, 5 channels of
47 stations), and as vectors of float32, of the 185 numbers that count, scaled so that the squared
distance of two vectors is D^2. Only the first peer gives the exact answer that footfit gives. The
others are anchors: they answer in float32, without names, ties, labels or damage. ``ask`` prints
processor seconds, cold and warm, then the rows of the five nearest. Cold is the first question of a
process, with the opening of the file. A library that is not installed is left out.
"""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from footfit.catalogue.store import open_catalogue
from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.flare.profile_distance import (
    DISTANCE,
    distance_parts,
    inside,
    total_distance,
)
from footfit.geometry.numeric.arrays import Floats

PROFILES, VECTORS, SQUARES = "profiles.f8", "vectors.f4", "squares.f4"
NEAREST, WARM = 5, 3
ROWS = 4096
"""So many rows at a time: their differences stay in the processor's cache."""
Question = tuple[FlareProfile, Floats]
"""The flare of a foot, and the same as a vector of float32."""


def write_profiles(catalogue: Path, folder: Path, stations: Floats) -> list[str]:
    """Write the profiles of all lasts of a catalogue into a folder; return their names."""
    names: list[str] = []
    files = [(folder / name).open("wb") for name in (PROFILES, VECTORS, SQUARES)]
    with open_catalogue(catalogue) as opened:
        for _, part in opened.block_lasts().chunks(("plan", "bottom")):
            assert part.flare is not None
            assert part.flare.plan is not None
            assert part.flare.bottom is not None
            curves = np.concatenate([part.flare.plan[:, None], part.flare.bottom], axis=1)
            vectors = vectors_of(curves, stations)
            squares = np.square(vectors).sum(axis=1)
            for file, array in zip(files, (curves, vectors, squares), strict=True):
                file.write(np.ascontiguousarray(array).data)
            names += part.names
    for file in files:
        file.close()
    return names


def vectors_of(curves: Floats, stations: Floats) -> Any:
    """Profiles (k, channels, stations) as vectors (k, 185) of float32."""
    part = inside(stations)
    scale = np.sqrt(np.array(DISTANCE.weights) / (part.stop - part.start)) / np.array(DISTANCE.sd)
    return (curves[:, :, part] * scale[:, None]).reshape(len(curves), -1).astype("<f4")


def _mapped(folder: Path, width: int) -> tuple[Any, Any]:
    vectors = np.memmap(folder / VECTORS, dtype="<f4", mode="r").reshape(-1, width)
    return vectors, np.memmap(folder / SQUARES, dtype="<f4", mode="r")


def _least(distance: Floats) -> list[int]:
    best = np.argpartition(distance, NEAREST)[:NEAREST]
    return best[np.argsort(distance[best])].tolist()


# ---------------------------------------------------------------- how each opens, and asks


def _exact(folder: Path, question: Question) -> Callable[[], list[int]]:
    foot = question[0]
    flat = np.memmap(folder / PROFILES, dtype="<f8", mode="r")
    curves = flat.reshape(-1, len(CHANNELS), len(foot.stations))

    def ask() -> list[int]:
        distance = np.empty(len(curves))
        for at in range(0, len(curves), ROWS):
            part = curves[at : at + ROWS]
            each = [part[:, channel] for channel in range(len(CHANNELS))]
            distance[at : at + ROWS] = total_distance(distance_parts(foot, each))
        return _least(distance)

    return ask


def _product(folder: Path, question: Question) -> Callable[[], list[int]]:
    own = question[1]
    vectors, squares = _mapped(folder, len(own))
    return lambda: _least(squares - 2.0 * (vectors @ own))


def _faiss(folder: Path, question: Question) -> Callable[[], list[int]]:
    import faiss

    faiss.omp_set_num_threads(1)
    index = faiss.read_index(str(folder / "faiss"), faiss.IO_FLAG_MMAP)
    return lambda: index.search(question[1][None], NEAREST)[1][0].tolist()


def _make_faiss(folder: Path, width: int) -> None:
    import faiss

    index = faiss.IndexFlatL2(width)
    vectors, _ = _mapped(folder, width)
    for at in range(0, len(vectors), 1 << 16):
        index.add(np.ascontiguousarray(vectors[at : at + (1 << 16)]))
    faiss.write_index(index, str(folder / "faiss"))


def _usearch(folder: Path, question: Question) -> Callable[[], list[int]]:
    from usearch.index import MetricKind, search

    vectors, _ = _mapped(folder, len(question[1]))
    return lambda: search(
        vectors, question[1], NEAREST, MetricKind.L2sq, exact=True, threads=1
    ).keys.tolist()


def _duckdb(folder: Path, question: Question) -> Callable[[], list[int]]:
    import duckdb

    connection = duckdb.connect(str(folder / "duckdb"), read_only=True, config={"threads": 1})
    width = len(question[1])
    select = (
        f"SELECT row FROM profile ORDER BY array_distance(vector, ?::FLOAT[{width}])"
        f" LIMIT {NEAREST}"
    )
    own = question[1].tolist()
    return lambda: [row for (row,) in connection.execute(select, [own]).fetchall()]


def _make_duckdb(folder: Path, width: int) -> None:
    import duckdb

    vectors, _ = _mapped(folder, width)
    with duckdb.connect(str(folder / "duckdb")) as connection:
        connection.execute(f"CREATE TABLE profile (row BIGINT, vector FLOAT[{width}])")
        columns = ", ".join(f"c{i}" for i in range(width))
        for at in range(0, len(vectors), 1 << 16):
            part = np.ascontiguousarray(vectors[at : at + (1 << 16)].T)
            arrays = {f"c{i}": part[i] for i in range(width)}
            connection.register("part", arrays | {"row": np.arange(at, at + part.shape[1])})
            connection.execute(f"INSERT INTO profile SELECT row, [{columns}] FROM part")


def _sqlite_vec(folder: Path, question: Question) -> Callable[[], list[int]]:
    connection = _with_vectors(folder / "sqlite")
    select = f"SELECT rowid FROM profile WHERE vector MATCH ? AND k = {NEAREST} ORDER BY distance"
    own = question[1].tobytes()
    return lambda: [row - 1 for (row,) in connection.execute(select, [own]).fetchall()]


def _make_sqlite_vec(folder: Path, width: int) -> None:
    vectors, _ = _mapped(folder, width)
    with _with_vectors(folder / "sqlite") as connection:
        connection.execute(f"CREATE VIRTUAL TABLE profile USING vec0(vector float[{width}])")
        rows = ((at + 1, vector.tobytes()) for at, vector in enumerate(vectors))
        connection.executemany("INSERT INTO profile (rowid, vector) VALUES (?, ?)", rows)


def _with_vectors(path: Path) -> Any:
    """A connection with the extension; Python's own `sqlite3` may be built without extensions."""
    import apsw
    import sqlite_vec

    connection = apsw.Connection(str(path))
    connection.enable_load_extension(True)
    connection.load_extension(sqlite_vec.loadable_path())
    return connection


@dataclass(frozen=True, slots=True)
class Peer:
    """A way to find the nearest profiles: its file is made once, then it opens it and is asked."""

    title: str
    open: Callable[[Path, Question], Callable[[], list[int]]]
    make: Callable[[Path, int], None] = lambda _folder, _width: None
    libraries: tuple[str, ...] = ("numpy",)


PEERS = {
    "exact": Peer("memory-mapped brute force, float64", _exact),
    "product": Peer("memory-mapped matrix product, float32", _product),
    "faiss": Peer("faiss flat", _faiss, _make_faiss, ("faiss",)),
    "usearch": Peer("usearch exact", _usearch, libraries=("usearch", "tqdm")),
    "sqlite-vec": Peer("sqlite-vec", _sqlite_vec, _make_sqlite_vec, ("sqlite_vec", "apsw")),
    "duckdb": Peer("DuckDB", _duckdb, _make_duckdb, ("duckdb",)),
}
"""The first one is exact; scale.md's anchors follow."""


def installed() -> list[str]:
    """The peers whose libraries are there."""
    return [name for name, peer in PEERS.items() if all(map(find_spec, peer.libraries))]


def main() -> None:
    """Make a peer's file, or ask it: see above."""
    what, name, folder, *foot = sys.argv[1:]
    if what == "make":
        PEERS[name].make(Path(folder), int(foot[0]))
        return
    import footfit

    flare = footfit.flare(foot[0]).flare
    curves = [flare.curvature[channel] for channel in CHANNELS]
    question = (flare, vectors_of(np.array([curves], dtype=np.float64), flare.stations)[0])
    for library in PEERS[name].libraries:
        importlib.import_module(library)
    start = time.process_time()
    ask = PEERS[name].open(Path(folder), question)
    nearest = ask()
    cold = time.process_time() - start
    warm = []
    for _ in range(WARM):
        start = time.process_time()
        ask()
        warm.append(time.process_time() - start)
    print(cold, min(warm), *nearest)


if __name__ == "__main__":
    main()
