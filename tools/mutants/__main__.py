"""Draw mutants, run the tests that reach each, and name the survivors: see docs/testing.md.

``python -m tools.mutants --seed 1 --count 200 [footfit/geometry ...]``
"""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from queue import SimpleQueue

from tools.mutants import processes, scratch, summary
from tools.mutants.draw import Mutant, drawn
from tools.mutants.reach import Reach, reach
from tools.mutants.trial import Outcome, tried

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / ".mutants"
EQUIVALENTS = ROOT / "tools" / "equivalent_mutants.toml"
HIGHEST = 10_000


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="*", default=["footfit"], help="modules or folders")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200, help="how many mutants to try")
    parser.add_argument("--workers", type=int, default=2, help="how many at the same time")
    parser.add_argument(
        "--seconds", type=float, default=60.0, help="of tests for each mutant, the fastest first"
    )
    parser.add_argument("--tests", nargs="*", default=[], help="only these files of tests")
    parser.add_argument("--only-list", action="store_true", help="print the mutants, run nothing")
    options = parser.parse_args()
    modules = _modules(ROOT, options.paths)
    mutants, left_out = _chosen(modules, options.seed, options.count)
    if options.only_list:
        print("\n".join(mutant.name for mutant in mutants))
        return
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended by a signal"))
    with tempfile.TemporaryDirectory(prefix="footfit-mutants-") as name:
        tree = scratch.template(ROOT, Path(name) / "template")
        known = reach(tree, KEPT / "reach", options.workers, options.tests)
        outcomes = _tried(mutants, known, tree, options)
        title = f"Seed {options.seed}, {' '.join(options.paths)}"
        summary.write(KEPT / f"seed-{options.seed}", ROOT, title, outcomes)
    for outcome in outcomes:
        if outcome.word != "caught":
            print(f"\n{outcome.mutant.name}\n{summary.diff(ROOT, outcome.mutant)}")
    print(f"\n{summary.counts(outcomes)}; {left_out} drawn that are listed as equivalent")


def _modules(root: Path, paths: Sequence[str]) -> list[Path]:
    """The modules that the paths name."""
    named = [root / path for path in paths]
    modules = [path for path in named if path.suffix == ".py"]
    return modules + [module for path in named for module in path.glob("**/*.py")]


def _chosen(modules: Sequence[Path], seed: int, count: int) -> tuple[list[Mutant], int]:
    """The first ``count`` mutants of a seed that are not equivalent, and how many were."""
    listed = summary.equivalents(EQUIVALENTS)
    mutants: list[Mutant] = []
    left_out = 0
    for mutant in drawn(ROOT, modules, seed, min(HIGHEST, count + 10 * len(listed))):
        if any(known.means(mutant) for known in listed):
            left_out += 1
        else:
            mutants.append(mutant)
        if len(mutants) == count:
            break
    return mutants, left_out


def _tried(
    mutants: Sequence[Mutant], known: Reach, tree: Path, options: argparse.Namespace
) -> list[Outcome]:
    """Every mutant's outcome, told as it comes."""
    folders: SimpleQueue[Path] = SimpleQueue()
    for worker in range(options.workers):
        folders.put(tree.parent.parent / f"worker-{worker}")
    with processes.workers(options.workers) as pool:
        outcomes = []
        for outcome in pool.map(partial(_try_one, known, tree, folders, options.seconds), mutants):
            outcomes.append(outcome)
            print(f"{len(outcomes):>4} {summary.line_of(outcome)}", flush=True)
        return outcomes


def _try_one(
    known: Reach, tree: Path, folders: SimpleQueue[Path], seconds: float, mutant: Mutant
) -> Outcome:
    folder = folders.get()
    try:
        return tried(mutant, known.plan(mutant, seconds), tree, folder)
    finally:
        folders.put(folder)


if __name__ == "__main__":
    main()
