"""How long the command line takes, as ratios against peers in the same run.

    python -m benchmarks.speed [--runs 7] [--lasts 100] [--write]

Whole processes, taken in turn (A B A B ...), so that a machine that slows down slows both; the
median and the spread over the runs. Peak memory is the operating system's own accounting.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.tables import markdown, put
from footfit.meshes.write import encoded_mesh
from tests.distortions import decimated, subdivided
from tests.reading import read_scan
from tools.lasts import last_mesh, varied

ROOT = Path(__file__).resolve().parents[1]
SEED = 20261124
FOOT_FACES = 30_000
LAST_FACES = 35_000


@dataclass(frozen=True)
class Timed:
    """One process: wall seconds and peak MB."""

    seconds: float
    megabytes: float


WRAPPER = """
import resource, subprocess, sys, time
start = time.perf_counter()
code = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
seconds = time.perf_counter() - start
print(code, seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024)
"""
"""A small parent: a child's peak memory starts at its parent's, and this benchmark is large."""


def timed(*command: str) -> Timed:
    """Run a command to its end, its output thrown away."""
    wrapped = [sys.executable, "-S", "-c", WRAPPER, *command]
    done = subprocess.run(wrapped, capture_output=True, text=True, check=True)
    code, seconds, megabytes = done.stdout.split()
    if code != "0":
        raise RuntimeError(f"failed: {' '.join(command)}")
    return Timed(float(seconds), float(megabytes))


def in_turn(first: list[str], second: list[str], runs: int) -> tuple[list[Timed], list[Timed]]:
    """Both commands ``runs`` times in turn, after one run of each that does not count."""
    timed(*first)
    timed(*second)
    pairs = [(timed(*first), timed(*second)) for _ in range(runs)]
    return [a for a, _ in pairs], [b for _, b in pairs]


def spread(values: list[float], digits: int = 2) -> str:
    """Median and range."""
    middle, low, high = statistics.median(values), min(values), max(values)
    return f"{middle:.{digits}f} ({low:.{digits}f}-{high:.{digits}f})"


def foot_file(folder: Path) -> Path:
    """A sample foot of `FOOT_FACES` faces, binary STL."""
    source = sorted((ROOT / "sample_data" / "feet").glob("*.stl"))[0]
    scan = read_scan(source)
    vertices, faces = subdivided(scan.vertices_mm, scan.faces)
    vertices, faces = decimated(vertices, faces, len(faces) / FOOT_FACES)
    path = folder / "foot.stl"
    path.write_bytes(encoded_mesh(vertices, faces, "stl"))
    return path


def last_files(folder: Path, count: int, faces: int) -> Path:
    """``count`` different lasts of about ``faces`` faces each, binary STL."""
    rng = np.random.default_rng(SEED)
    folder.mkdir()
    rings = round((faces / 2 / 1.2) ** 0.5 * 1.2)
    for i in range(count):
        spec = varied(rng, rings=rings, segments=round(rings / 1.2))
        vertices, triangles = last_mesh(spec)
        (folder / f"last-{i:03d}.stl").write_bytes(encoded_mesh(vertices, triangles, "stl"))
    return folder


def main() -> None:
    """Print the table; with --write put it into docs/speed.md."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--lasts", type=int, default=100)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    footfit = [sys.executable, "-m", "footfit"]
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        foot, catalogue = foot_file(folder), str(folder / "lasts.footfit")
        library = last_files(folder / "lasts", options.lasts, 6_000)
        stock = [*footfit, "ingest-last", str(library), "--side", "right", "--jobs", "2"]
        timed(*stock, "--catalogue", catalogue)

        load = [sys.executable, "-c", f"import trimesh; trimesh.load_mesh({str(foot)!r})"]
        for words in ([], ["--json"]):
            match = [*footfit, "match", str(foot), "--catalogue", catalogue, *words]
            ours, peer = in_turn(match, load, options.runs)
            ratios = [a.seconds / b.seconds for a, b in zip(ours, peer, strict=True)]
            rows.append(
                [
                    f"`footfit match foot.stl {' '.join(words)}` cold, {options.lasts} lasts",
                    "`import trimesh; trimesh.load_mesh` of the same file",
                    spread(ratios),
                    spread([a.seconds for a in ours]),
                    f"{max(a.megabytes for a in ours):.0f} MB",
                ]
            )

        bare = [sys.executable, "-c", "import typer, rich"]
        ours, peer = in_turn([*footfit, "-h"], bare, options.runs)
        rows.append(
            [
                "`footfit -h`",
                "`python -c 'import typer, rich'`",
                spread([a.seconds / b.seconds for a, b in zip(ours, peer, strict=True)]),
                spread([a.seconds for a in ours]),
                f"{max(a.megabytes for a in ours):.0f} MB",
            ]
        )

        rows.append(ingest_row(footfit, folder, options.runs))
    table = markdown(["what", "peer", "time / peer", "seconds", "peak memory"], rows)
    print(f"seed {SEED}, {options.runs} runs, one core each\n\n{table}")
    if options.write:
        put("speed.md", "speed", table)


def ingest_row(footfit: list[str], folder: Path, runs: int) -> list[str]:
    """Lasts of 35k faces a second on one core: the slope between a short and a long batch."""
    few, many = 2, 8  # a single file needs no second process
    short = last_files(folder / "few", few, LAST_FACES)
    long = last_files(folder / "many", many, LAST_FACES)
    each, memory = [], 0.0
    for i in range(max(3, runs // 2)):
        took = []
        for library in (short, long):
            catalogue = str(folder / f"{library.name}-{i}.footfit")
            command = [*footfit, "ingest-last", str(library), "--side", "right"]
            run = timed(*command, "--catalogue", catalogue)
            took.append(run.seconds)
            memory = max(memory, run.megabytes)
        each.append((took[1] - took[0]) / (many - few))
    load = [
        sys.executable,
        "-c",
        f"import trimesh; trimesh.load_mesh({str(short / 'last-000.stl')!r})",
    ]
    peer = statistics.median(timed(*load).seconds for _ in range(3))
    return [
        "`footfit ingest-last`, each further last of 35k faces, one core",
        "`import trimesh; trimesh.load_mesh` of one of them",
        spread([seconds / peer for seconds in each]),
        f"{spread(each)}: {1 / statistics.median(each):.1f} lasts a second",
        f"{memory:.0f} MB",
    ]


if __name__ == "__main__":
    main()
