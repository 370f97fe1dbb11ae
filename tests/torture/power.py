"""Power cuts at random moments of a script, replayed from what strace recorded."""

from __future__ import annotations

import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

from tests.torture.disk import CALLS, Disk, Event, events
from tests.torture.kills import judge
from tests.torture.scripts import Script, truth
from tests.torture.tally import Tally

ROOT = Path(__file__).resolve().parents[2]
RERUN_EVERY = 5


def strace_missing() -> str | None:
    """Why there is no strace, or None."""
    if shutil.which("strace") is None:
        return "strace is not installed (Debian: apt-get install strace)"
    done = subprocess.run(["strace", "-o", os.devnull, "true"], capture_output=True, check=False)
    return None if done.returncode == 0 else f"strace may not trace here: {done.stderr.decode()!r}"


def straced(options: list[str], log: Path, *arguments: str) -> None:
    """Run this package's worker under strace."""
    command = [
        "strace",
        "-f",
        "--seccomp-bpf",
        "-qq",
        "-o",
        str(log),
        *options,
        sys.executable,
        "-B",
        "-m",
    ]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [*command, *arguments], cwd=ROOT, env=environment, capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr.decode()


def recorded(script: Script, folder: Path, synchronous: str) -> tuple[Disk, list[Event]]:
    """The disk before an undisturbed run of a script, and what the run did to it."""
    place, log = folder / f"recorded-{synchronous}", folder / f"log-{synchronous}"
    place.mkdir()
    script.prepare(place)
    before = Disk.of(place)
    found = folder / "before"
    shutil.copytree(place, found)
    name = script.name.split(",")[0]
    options = ["-xx", "-s", "10000000", "-e", f"trace={CALLS}"]
    straced(options, log, "tests.torture.worker", name, str(place), synchronous)
    for path in found.iterdir():
        shutil.copy(path, place / path.name)  # names as they were, for the reader
    happened = list(events(log, _as_before(place, found)))
    shutil.rmtree(found)
    log.unlink()
    return before, happened


def _as_before(place: Path, found: Path) -> Path:
    """The folder with the names that it had before the run."""
    shutil.rmtree(place)
    shutil.copytree(found, place)
    return place


def cut_trials(
    folder: Path, script: Script, count: int, seed: int, synchronous: str = "EXTRA"
) -> Tally:
    """0 bad with the settings of footfit; with synchronous OFF most are."""
    tally = Tally(f"power cut: {script.name}, synchronous {synchronous}")
    known = truth(script, folder / "undisturbed")
    before, happened = recorded(script, folder, synchronous)
    acknowledged = sum(event.kind == "ack" for event in happened)
    if acknowledged != len(known.states) - 1:
        tally.breach(f"the record has {acknowledged} acknowledgements: it shows nothing")
    generator = random.Random(seed)
    moments = sorted(generator.randrange(len(happened)) for _ in range(count))
    disk, at = before, 0
    for trial, moment in enumerate(moments):
        while at <= moment:
            disk.happen(happened[at])
            at += 1
        place = folder / f"cut-{trial}"
        place.mkdir()
        disk.cut(place, generator)
        tally.trials += 1
        tally.struck += disk.acknowledged < acknowledged
        rerun = trial % RERUN_EVERY == 0
        judge(tally, known, place, disk.acknowledged, f"cut at event {moment}", rerun=rerun)
        shutil.rmtree(place)
    tally.facts["events"] = len(happened)
    tally.facts["syncs"] = sum(event.kind.startswith("sync") for event in happened)
    return tally
