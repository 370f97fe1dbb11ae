"""kill -9 at a random moment of a script."""

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
from pathlib import Path

from tests.torture.scripts import Script, Truth, content, finished, observed, truth
from tests.torture.tally import Tally

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "sample_data" / "lasts"


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

    Every other kill is timed from an acknowledgement, not from the start: on a machine that is
    busy now and idle then, it meets unfinished work all the same.
    """
    tally = Tally(f"kill -9: {script.name}")
    known = truth(script, folder / "undisturbed")
    span_s = _span_s(script, folder)
    generator = random.Random(seed)
    for trial in range(count):
        place = folder / f"kill-{trial}"
        place.mkdir()
        script.prepare(place)
        child = run(script, place)
        wait_s, steps = span_s * generator.uniform(0.0, 1.0), len(known.states) - 1
        if trial % 2:
            child.heard(generator.randrange(steps))
            wait_s /= steps
        time.sleep(wait_s)
        child.kill()
        acknowledged, code = child.wait()
        tally.trials += 1
        tally.struck += code == -signal.SIGKILL
        judge(tally, known, place, acknowledged, f"trial {trial}")
        shutil.rmtree(place)
    return tally


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


def _span_s(script: Script, folder: Path) -> float:
    """How long a script takes in a child."""
    place = folder / "timed"
    place.mkdir()
    script.prepare(place)
    begun = time.monotonic()
    run(script, place).wait()
    return time.monotonic() - begun


def command_trials(folder: Path, count: int, seed: int, lasts: int = 3) -> Tally:
    """kill -9 of the real command with two workers, on real meshes; run again, it goes on."""
    tally = Tally("kill -9: footfit ingest-last --jobs 2")
    scans = [str(path) for path in sorted(SAMPLES.glob("*.stl"))[:lasts]]
    undisturbed = folder / "undisturbed"
    begun = time.monotonic()
    _ingesting(undisturbed, scans).communicate()
    span_s, wanted = time.monotonic() - begun, content(undisturbed)
    generator = random.Random(seed)
    for trial in range(count):
        path = folder / f"killed-{trial}"
        process = _ingesting(path, scans)
        time.sleep(span_s * generator.uniform(0.1, 0.8))
        os.killpg(process.pid, signal.SIGKILL)
        out, _ = process.communicate()
        told = {json.loads(line)["last"] for line in out.splitlines() if line.endswith("}")}
        tally.trials += 1
        tally.struck += len(told) < lasts
        again, _ = _ingesting(path, scans).communicate()
        unchanged = {
            line["last"]
            for line in map(json.loads, again.splitlines())
            if line["status"] == "unchanged"
        }
        if not told <= unchanged:
            tally.breach(f"trial {trial}: {told - unchanged} was acknowledged and is not there")
        if content(path) != wanted:
            tally.breach(f"trial {trial}: the rerun ends elsewhere")
    return tally


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
