"""One mutant against the tests that reach it, in a copy of the tree."""

from __future__ import annotations

import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from tools.mutants import processes, scratch, watch
from tools.mutants.draw import Mutant

TEST_SECONDS, TEST_TIMES = 20.0, 10.0
"""A test may take this long, and this many times as long as it took: then the mutant hangs."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a mutant: ``caught``, ``survived`` or ``not reached``, and by which test."""

    mutant: Mutant
    word: str
    tests: int
    test: str | None
    seconds: float


def tried(mutant: Mutant, plan: dict[str, float], tree: Path, folder: Path) -> Outcome:
    """Run the planned tests on the mutant until one fails that passes without it."""
    began = time.monotonic()
    left = dict(plan)
    while left:
        test, word = _first_failure(mutant, left, tree, folder)
        if test is None or test not in left:  # nothing failed, or nothing could be collected
            break
        if _first_failure(None, {test: left[test]}, tree, folder)[1] == "survived":
            break
        print(f"{test} fails without a mutant too: it is left out here", flush=True)
        del left[test]
    else:
        test, word = None, "not reached"
    return Outcome(mutant, word, len(plan), test, time.monotonic() - began)


def _first_failure(
    mutant: Mutant | None, plan: dict[str, float], tree: Path, folder: Path
) -> tuple[str | None, str]:
    """The first test of the plan that fails, and "caught" or "survived"."""
    copy = scratch.copied(tree, folder)
    if mutant is not None:
        _change(copy / mutant.path, mutant)
    limits = {test: TEST_SECONDS + TEST_TIMES * seconds for test, seconds in plan.items()}
    listed, log = folder / "plan.json", folder / "log.jsonl"
    listed.write_text(json.dumps(limits), encoding="utf-8")
    log.touch()
    files = sorted({test.partition("::")[0] for test in plan})
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "tools.mutants.watch"]
    command += ["-p", "no:cacheprovider", *files]
    known = scratch.environment(copy) | {watch.PLAN: str(listed), watch.LOG: str(log)}
    longest = max(limits.values()) + 3.0 * sum(plan.values()) + 60
    code = processes.run(command, copy, known, longest)
    if code == 0:
        return None, "survived"
    events = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
    failed = [event["failed"] for event in events if "failed" in event]
    begun = [event["began"] for event in events if "began" in event]
    return next(iter(failed), begun[-1] if begun else None), "caught"


def _change(path: Path, mutant: Mutant) -> None:
    """Write the mutated module, and remove the compiled one: it may look as new."""
    path.write_text(mutant.mutation.applied(path.read_text(encoding="utf-8")), encoding="utf-8")
    for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*.pyc"):
        compiled.unlink()
