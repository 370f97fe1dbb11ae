"""``python -m tests.torture [--seed N] [--scale X] [--only WORD] [--script WORD]``: long trials.

With ``--scale 1``: 2,800 kills, 1,100 power cuts and 250 without syncs, every write failing once,
1,000 flips and so on; about two hours on one core. The exit code is 1 where a promise broke.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from tests.torture import crowd, damage, full, kills, power, signals, syscalls, upgrades
from tests.torture.scripts import ALL, INGEST, Script
from tests.torture.tally import Tally, memory

Trial = tuple[str, Callable[[Path], Tally]]


COUNTS = dict(
    zip(
        ALL,
        ((400, 200), (370, 200), (200, 100), (1_000, 200), (400, 200), (400, 200)),
        strict=True,
    )
)
"""How many kills must strike each script, and how many power cuts it gets."""


def trials(scale: float, seed: int, script: str = "") -> Iterator[Trial]:
    """Every row of the table, with as many trials as ``scale`` asks for.

    ``script`` leaves out what is not a script whose name begins so.
    """

    def count(number: int) -> int:
        return max(1, round(number * scale))

    chosen = [each for each in ALL if each.name.startswith(script)]
    yield from _killing(chosen, count, seed)
    if power.strace_missing() is None:
        yield from _tracing(chosen, count, seed, scale)
    for each in chosen:
        yield "full", lambda f, s=each: full.file_limit_trials(f, s, count(20))
        if full.tmpfs_missing() is None:
            yield "full", lambda f, s=each: full.full_disk_trials(f, s, count(20))
    if script:
        return
    yield "kill", lambda folder: kills.command_trials(folder, count(30), seed)
    if power.strace_missing() is None:
        yield "power", lambda f: unsafe(f, "OFF", count(250), seed)
        yield "power", lambda f: unsafe(f, "FULL", count(250), seed)
    yield "writers", lambda folder: crowd.crowd_trials(folder, 8, count(25), 4)
    yield "backup", lambda folder: crowd.backup_trials(folder, count(50), seed)
    yield "migration", lambda folder: upgrades.failing_upgrade_trials(folder)
    for harm, number in zip(damage.HARMS, (1_000, 200, 200, 100), strict=True):
        yield "damage", lambda f, h=harm, n=number: damage.damage_trials(f, h, count(n), seed)
    yield "damage", damage.column_trials
    for jobs in (1, 2):
        yield "signal", lambda f, j=jobs: signals.signal_trials(f, count(50), seed, j, 8.0)
    yield "signal", signals.lock_trial


def _killing(chosen: list[Script], count: Callable[[int], int], seed: int) -> Iterator[Trial]:
    for script in chosen:
        number = count(COUNTS[script][0])
        yield "kill", lambda f, s=script, n=number: kills.kill_trials(f, s, n, seed)


def _tracing(
    chosen: list[Script], count: Callable[[int], int], seed: int, scale: float
) -> Iterator[Trial]:
    for script in chosen:
        number = count(COUNTS[script][1])
        yield "power", lambda f, s=script, n=number: power.cut_trials(f, s, n, seed)
    every = max(1, round(1 / scale))
    for script in chosen:
        yield "calls", lambda f, s=script: syscalls.failing_trials(f, s, every, seed)


def unsafe(folder: Path, synchronous: str, count: int, seed: int) -> Tally:
    """The same trials without footfit's settings: they must find what is bad, or show nothing."""
    tally = power.cut_trials(folder, INGEST, count, seed, synchronous)
    bad, tally.bad = len(tally.bad), []
    tally.facts["bad, as it must be"] = bad
    if synchronous == "OFF" and bad <= tally.trials / 2:
        tally.breach(f"only {bad} of {tally.trials} cuts were bad: the trials show nothing")
    return tally


def main() -> int:
    """Run the trials and print the table."""
    parser = argparse.ArgumentParser(prog="python -m tests.torture")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--only", default="", help="kill, power, calls, damage, full, ...")
    parser.add_argument("--script", default="", help="ingest, edit, migrate, group, ...")
    asked = parser.parse_args()
    print(f"seed {asked.seed}, scale {asked.scale}")
    for skipped in (power.strace_missing(), full.tmpfs_missing()):
        if skipped:
            print(f"left out: {skipped}")
    print(
        "| promise | trials | struck | broken | also | s |\n|---|---|---|---|---|---|", flush=True
    )
    broken = 0
    for kind, trial in trials(asked.scale, asked.seed, asked.script):
        if not kind.startswith(asked.only):
            continue
        folder, begun = (
            Path(tempfile.mkdtemp(prefix="footfit-torture-", dir=memory())),
            time.monotonic(),
        )
        try:
            tally = trial(folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        print(f"{tally.row()} {time.monotonic() - begun:.0f} |", flush=True)
        broken += len(tally.bad)
        for words in tally.bad[:20]:
            print(f"    {words}", file=sys.stderr)
    return 1 if broken else 0


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    sys.exit(main())
