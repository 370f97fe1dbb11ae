"""kill -9 at a random moment of a random step of a script."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from tests.torture.scripts import Script, Truth, content, finished, observed, truth
from tests.torture.signals import first_lines
from tests.torture.tally import Tally

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "sample_data" / "lasts"
TRIALS_PER_STRIKE = 6
"""A kill misses where the script ended before it: so many trials for each that must strike."""


@dataclass
class Child:
    """A forked process in a group of its own; each byte in its pipe is an acknowledgement."""

    pid: int
    pipe: int
    acknowledged: int = 0

    def heard(self, count: int) -> None:
        """Wait until so many acknowledgements have come, or the end."""
        while self.acknowledged < count and os.read(self.pipe, 1):
            self.acknowledged += 1

    def kill(self) -> None:
        """End the whole group without a word."""
        try:
            os.killpg(self.pid, signal.SIGKILL)
        except ProcessLookupError:  # before it had a group
            os.kill(self.pid, signal.SIGKILL)

    def wait(self) -> tuple[int, int]:
        """The acknowledgements, and the exit code (negative: the signal)."""
        while data := os.read(self.pipe, 1 << 16):
            self.acknowledged += len(data)
        os.close(self.pipe)
        _, status = os.waitpid(self.pid, 0)
        return self.acknowledged, os.waitstatus_to_exitcode(status)


def forked(work: Callable[[Callable[[], None]], int | None]) -> Child:
    """Run ``work(acknowledge)`` in a child whose modules are loaded already."""
    sys.stdout.flush()
    sys.stderr.flush()
    ready, ack = os.pipe()
    pid = os.fork()
    if pid:
        os.close(ack)
        return Child(pid, ready)
    code = 70
    try:
        os.setsid()
        code = work(lambda: os.writev(ack, [b"."]) and None) or 0
    finally:
        os._exit(code)


def run(script: Script, folder: Path, done: int = 0) -> Child:
    """A script in a child."""

    def work(acknowledge: Callable[[], None]) -> None:
        for _ in script.work(folder, done):
            acknowledge()

    return forked(work)


def kill_trials(folder: Path, script: Script, count: int, seed: int) -> Tally:
    """0 corrupt, 0 half, 0 acknowledged lost, and the rest of the work leads to the same end.

    There are as many trials as it takes for ``count`` kills to strike unfinished work, up to
    ``TRIALS_PER_STRIKE`` for each.
    """
    tally = Tally(f"kill -9: {script.name}")
    known = truth(script, folder / "undisturbed")
    steps_s = _script_steps_s(script, folder, len(known.states) - 1)
    generator = random.Random(seed)
    while tally.struck < count and tally.trials < TRIALS_PER_STRIKE * count:
        place = folder / f"kill-{tally.trials}"
        place.mkdir()
        script.prepare(place)
        child = run(script, place)
        step, wait_s = _moment(steps_s, generator)
        child.heard(step)
        time.sleep(wait_s)
        child.kill()
        acknowledged, code = child.wait()
        judge(tally, known, place, acknowledged, f"trial {tally.trials}")
        tally.trials += 1
        tally.struck += code == -signal.SIGKILL and acknowledged < len(steps_s)
        shutil.rmtree(place)
    return tally


def _moment(steps_s: list[float], generator: random.Random) -> tuple[int, float]:
    """When to kill: after so many steps, and so many seconds into the next one.

    The wait is timed from the step before, not from the start. So a machine that was busy when
    the steps were timed, and is idle now, still has work to do when the kill comes.
    """
    step = generator.randrange(len(steps_s))
    return step, steps_s[step] * generator.uniform(0.0, 1.0)


def _seconds_between(marks_s: list[float]) -> list[float]:
    return [after - before for before, after in pairwise(marks_s)]


def judge(
    tally: Tally, known: Truth, place: Path, acknowledged: int, what: str, rerun: bool = True
) -> None:
    """Note a breach unless a folder is before or after its next step and leads to the same end."""
    try:
        found = observed(place)
        steps = known.steps_of(found, acknowledged)
        if steps is None:
            tally.breach(f"{what}: after {acknowledged} acknowledged steps: {found}")
        elif rerun and finished(known.script, place, steps) != known.states[-1]:
            tally.breach(f"{what}: the rerun from step {steps} ends elsewhere")
    except Exception as error:  # noqa: BLE001 - whatever it is, the promise is broken
        tally.breach(f"{what}: after {acknowledged} acknowledged steps: {error!r}")


def _script_steps_s(script: Script, folder: Path, steps: int) -> list[float]:
    """How long each step of a script takes in a child, at its quickest of three runs."""
    runs = []
    for number in range(3):
        place = folder / f"timed-{number}"
        place.mkdir()
        script.prepare(place)
        marks_s = [time.monotonic()]
        child = run(script, place)
        for step in range(1, steps + 1):
            child.heard(step)
            marks_s.append(time.monotonic())
        child.wait()
        runs.append(_seconds_between(marks_s))
    return [min(step) for step in zip(*runs, strict=True)]


def command_trials(folder: Path, count: int, seed: int, lasts: int = 3) -> Tally:
    """kill -9 of the real command with two workers, on real meshes; run again, it goes on.

    ``count`` kills must strike, as in ``kill_trials``.
    """
    tally = Tally("kill -9: footfit ingest-last --jobs 2")
    scans = [str(path) for path in sorted(SAMPLES.glob("*.stl"))[:lasts]]
    steps_s = _command_steps_s(folder / "undisturbed", scans)
    wanted = content(folder / "undisturbed")
    generator = random.Random(seed)
    while tally.struck < count and tally.trials < TRIALS_PER_STRIKE * count:
        path = folder / f"killed-{tally.trials}"
        process = _ingesting(path, scans)
        step, wait_s = _moment(steps_s, generator)
        out = first_lines(process, step)
        time.sleep(wait_s)
        os.killpg(process.pid, signal.SIGKILL)
        out += process.communicate()[0]
        told = {json.loads(line)["last"] for line in out.splitlines() if line.endswith("}")}
        again, _ = _ingesting(path, scans).communicate()
        unchanged = {
            line["last"]
            for line in map(json.loads, again.splitlines())
            if line["status"] == "unchanged"
        }
        if not told <= unchanged:
            lost = told - unchanged
            tally.breach(f"trial {tally.trials}: {lost} was acknowledged and is not there")
        if content(path) != wanted:
            tally.breach(f"trial {tally.trials}: the rerun ends elsewhere")
        tally.trials += 1
        tally.struck += len(told) < lasts
    return tally


def _command_steps_s(path: Path, scans: list[str]) -> list[float]:
    """How long the command takes to each of its lines."""
    marks_s = [time.monotonic()]
    process = _ingesting(path, scans)
    for _ in scans:
        first_lines(process, 1)
        marks_s.append(time.monotonic())
    process.communicate()
    return _seconds_between(marks_s)


def _ingesting(path: Path, scans: list[str]) -> subprocess.Popen[str]:
    options = ["--catalogue", str(path), "--json", "--quiet", "--jobs", "2"]
    return subprocess.Popen(
        [sys.executable, "-m", "footfit", "ingest-last", *scans, *options],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
