"""What a command takes against an earlier version of footfit: processor and clock, in one run.

    python -m benchmarks.earlier CHECKOUT [--runs 15] [--write]

CHECKOUT is the source tree of the earlier version, such as `git worktree add --detach` makes. Both
run by this Python, as whole processes in turn, each on a catalogue of its own sample lasts, after
their bytecode was compiled. The time of one `align` is the slope between few meshes and many.
"""

from __future__ import annotations

import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.speed import spread
from benchmarks.tables import markdown, put
from footfit.meshes.write import encoded_mesh
from tests.distortions import moved, random_pose
from tools.lasts import LastSpec, last_mesh

ROOT = Path(__file__).resolve().parents[1]
SEED = 20261129
RINGS, SEGMENTS = 182, 124  # 45,044 faces
FEW, MANY = 2, 10
HEADS = ["what", "processor / earlier", "clock / earlier", "processor seconds", "earlier"]


@dataclass(frozen=True)
class Took:
    """One process: what it took of a processor, and by the clock, in seconds."""

    processor: float
    clock: float

    def over(self, other: Took, count: int = 1) -> Took:
        """What this process took more than another one, for each of ``count``."""
        return Took((self.processor - other.processor) / count, (self.clock - other.clock) / count)


@dataclass(frozen=True)
class Version:
    """A version of footfit, by its source tree."""

    tree: Path
    folder: Path  # of its own

    def run(self, *words: str) -> Took:
        """Run a command, its output thrown away."""
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(
            [sys.executable, "-m", "footfit", *words],
            env=os.environ | {"PYTHONPATH": str(self.tree)},
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=True,
        )
        clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        user, system = after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime
        return Took(user + system, clock)

    def prepared(self) -> Version:
        """The version with its bytecode compiled, and a catalogue of its sample lasts."""
        compiled = [sys.executable, "-m", "compileall", "-q", str(self.tree / "footfit")]
        subprocess.run(compiled, env=os.environ | {"PYTHONDONTWRITEBYTECODE": ""}, check=True)
        lasts, manifest = "sample_data/lasts", "sample_data/lasts.csv"
        paths = str(self.tree / lasts), "--manifest", str(self.tree / manifest)
        self.run("ingest-last", *paths, "--catalogue", self.catalogue)
        return self

    @property
    def catalogue(self) -> str:
        """Its catalogue of the sample lasts."""
        return str(self.folder / "lasts.footfit")


def row(
    title: str, versions: tuple[Version, Version], take: Callable[[Version], Took], runs: int
) -> list[str]:
    """A command by both versions in turn, after one run of each that does not count."""
    for version in versions:
        take(version)
    pairs = [tuple(map(take, versions)) for _ in range(runs)]
    now, earlier = zip(*pairs, strict=True)
    return [
        title,
        spread([a.processor / b.processor for a, b in pairs]),
        spread([a.clock / b.clock for a, b in pairs]),
        f"{statistics.median(each.processor for each in now):.3f}",
        f"{statistics.median(each.processor for each in earlier):.3f}",
    ]


def main() -> None:
    """Print the table; with --write put it into docs/speed.md."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("checkout", type=Path)
    parser.add_argument("--runs", type=int, default=15)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        trees = {"now": ROOT, "earlier": options.checkout.resolve()}
        for part in trees:
            (folder / part).mkdir()
        now, earlier = (Version(tree, folder / part).prepared() for part, tree in trees.items())
        foot = str(ROOT / "sample_data" / "feet" / "mh008_R.stl")
        vertices, faces = last_mesh(LastSpec(rings=RINGS, segments=SEGMENTS))
        rng, meshes = np.random.default_rng(SEED), []
        for number in range(MANY):
            meshes.append(str(folder / f"last-{number}.stl"))
            data = encoded_mesh(moved(vertices, random_pose(rng)), faces, "stl")
            Path(meshes[-1]).write_bytes(data)

        def match(version: Version) -> Took:
            return version.run("match", foot, "--catalogue", version.catalogue)

        def align(version: Version) -> Took:
            few = version.run("align", *meshes[:FEW], "--json")
            return version.run("align", *meshes, "--json").over(few, MANY - FEW)

        rows = [
            row("`footfit match foot.stl` cold, sample lasts", (now, earlier), match, options.runs),
            row(
                f"`footfit align`, each further last, {len(faces):,} faces, heel 25 mm",
                (now, earlier),
                align,
                options.runs,
            ),
        ]
    table = markdown(HEADS, rows)
    print(f"seed {SEED}, {options.runs} runs\n\n{table}")
    if options.write:
        put("speed.md", "earlier", table)


if __name__ == "__main__":
    main()
