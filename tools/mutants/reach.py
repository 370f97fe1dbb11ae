"""Which tests reach which line, measured once for each file of tests and kept in ``.mutants/``."""

from __future__ import annotations

import ast
import hashlib
import json
import os
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from pathlib import Path

from tools.mutants import processes, watch
from tools.mutants.draw import Mutant
from tools.mutants.scratch import environment

SETTINGS = """\
[run]
branch = false
core = ctrace
parallel = true
source = {root}/footfit
data_file = {folder}/coverage
context = ${{{context}-}}
"""
EVERYWHERE = (
    *("footfit/**/*", "migrations/**/*", "sample_data/**/*", "pyproject.toml"),
    *("tests/[!t]*.py", "tests/torture/*.py", "tests/data/*"),
)
"""What every test may read: where it changes, everything is measured again."""

DOCTESTS = "footfit"
"""The doctests of all modules are measured as one file of tests."""


@dataclass(slots=True)
class Reach:
    """Where the tests went: ``lines[path][line]`` are names of tests and of shared fixtures."""

    seconds: dict[str, float] = field(default_factory=dict)
    fixtures: dict[str, list[str]] = field(default_factory=dict)
    lines: dict[str, dict[int, set[str]]] = field(
        default_factory=lambda: defaultdict(lambda: defaultdict(set))
    )
    uses: dict[str, set[tuple[str, int]]] = field(default_factory=lambda: defaultdict(set))

    def plan(self, mutant: Mutant, seconds: float) -> dict[str, float]:
        """The tests that reach a mutant, the fastest first, with the seconds that each takes.

        Tests beyond ``seconds`` in all are left out: a mutant that only they catch survives.
        """
        names = self._names(mutant)
        asked = {test for test, needs in self.fixtures.items() if names.intersection(needs)}
        tests = (names | asked) & self.seconds.keys()
        costs = {test: self._cost(test) for test in tests if not test.startswith(watch.FIXTURE)}
        ordered = sorted(costs.items(), key=lambda item: (item[1], item[0]))
        spent = accumulate(cost for _, cost in ordered)
        return {
            test: cost
            for number, ((test, cost), total) in enumerate(zip(ordered, spent, strict=True))
            if total <= seconds or number == 0
        }

    def _cost(self, test: str) -> float:
        shared = self.fixtures.get(test, [])
        return self.seconds[test] + sum(self.seconds.get(name, 0.0) for name in shared)

    def _names(self, mutant: Mutant) -> set[str]:
        """Tests and fixtures that run the mutant's lines, or that use the names it defines."""
        mutation = mutant.mutation
        here = self.lines[mutant.path]
        if mutation.names is None:
            first, last = mutation.reach
            return {name for line in range(first, last + 1) for name in here.get(line, ())}
        places = {place for name in mutation.names for place in self.uses.get(name, ())}
        known = {name for path, line in places for name in self.lines[path].get(line, ())}
        return known or {name for names in here.values() for name in names}


def reach(root: Path, cache: Path, workers: int, tests: Sequence[str] = ()) -> Reach:
    """The map of a tree, with what ``cache`` has of it and is still true; of some tests, or all."""
    every = sorted(str(path.relative_to(root)) for path in root.glob("tests/test_*.py"))
    files = [name for name in [*every, DOCTESTS] if not tests or name in tests]
    code = _digest(path for pattern in EVERYWHERE for path in root.glob(pattern))
    cache.mkdir(parents=True, exist_ok=True)
    found = Reach(uses=_uses(root))
    with processes.workers(workers) as pool:
        parts = pool.map(lambda name: _measured(root, cache, name, code), files)
        for part in parts:
            found.seconds |= part["seconds"]
            found.fixtures |= part["fixtures"]
            for path, names in part["lines"].items():
                for name, lines in names.items():
                    for line in lines:
                        found.lines[path][line].add(name)
    return found


def _measured(root: Path, cache: Path, name: str, code: str) -> dict[str, dict]:
    """What the tests of one file reach, from the cache or measured now."""
    own = "" if name == DOCTESTS else _digest([root / name])
    key = hashlib.sha256(f"{code}{own}".encode()).hexdigest()[:16]
    slug = name.replace("/", "-").removesuffix(".py")
    kept = cache / f"{slug}.{key}.json"
    if not kept.is_file():
        print(f"measuring {name}", flush=True)
        for old in cache.glob(f"{slug}.*.json"):
            old.unlink()
        kept.write_text(json.dumps(_measure(root, name)), encoding="utf-8")
    known: dict[str, dict] = json.loads(kept.read_text(encoding="utf-8"))
    return known


def _measure(root: Path, name: str) -> dict[str, object]:
    """Run one file of tests under coverage, a name for each test; failures count as tests too."""
    from coverage import CoverageData

    with tempfile.TemporaryDirectory(prefix="footfit-reach-") as folder:
        settings, times = Path(folder) / "coverage.ini", Path(folder) / "times.json"
        places = {"root": root, "folder": folder, "context": watch.CONTEXT}
        settings.write_text(SETTINGS.format(**places), encoding="utf-8")
        command = [sys.executable, "-m", "coverage", "run", f"--rcfile={settings}", "-m", "pytest"]
        command += ["-q", "-p", "tools.mutants.watch", "-p", "no:cacheprovider", name]
        known = environment(root) | {
            watch.TIMES: str(times),
            "COVERAGE_PROCESS_START": str(settings),
        }
        said = Path(folder) / "said.txt"
        with said.open("wb") as output:
            code = processes.run(command, root, known, output=output)
        words = said.read_text(encoding="utf-8", errors="replace").strip()
        if not times.is_file():
            raise SystemExit(f"{name} could not be measured:\n{words}")
        if code:
            print(f"{name}, measured: {words.splitlines()[-1]}", flush=True)
        lines: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
        for part in sorted(Path(folder).glob("coverage.*")):
            if part == settings:
                continue
            data = CoverageData(basename=str(part))
            data.read()
            for file in data.measured_files():
                path = os.path.relpath(file, root)
                for line, contexts in data.contexts_by_lineno(file).items():
                    for context in filter(None, contexts):
                        lines[path][context].append(line)
        spent: dict[str, object] = json.loads(times.read_text(encoding="utf-8"))
        return spent | {"lines": lines}


def _digest(paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in sorted(paths):
        if path.is_file() and "__pycache__" not in path.parts:
            digest.update(f"{path.name}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def _uses(root: Path) -> dict[str, set[tuple[str, int]]]:
    """Where each name is read: in ``settings.width``, or alone."""
    uses: dict[str, set[tuple[str, int]]] = defaultdict(set)
    for path in root.glob("footfit/**/*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load):
                name = node.attr if isinstance(node, ast.Attribute) else node.id
                uses[name].add((str(path.relative_to(root)), node.lineno))
    return uses
