"""kill -9 at a random moment of a script."""

from __future__ import annotations

import os
import random
import shutil
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tests.torture.scripts import Script, Truth, finished, observed, truth
from tests.torture.tally import Tally


@dataclass
class Child:
    """A forked process in a group of its own; each byte in its pipe is an acknowledgement."""

    pid: int
    pipe: int

    def kill(self) -> None:
        """End the whole group without a word."""
        try:
            os.killpg(self.pid, signal.SIGKILL)
        except ProcessLookupError:  # before it had a group
            os.kill(self.pid, signal.SIGKILL)

    def wait(self) -> tuple[int, int]:
        """The acknowledgements, and the exit code (negative: the signal)."""
        acknowledged = 0
        while data := os.read(self.pipe, 1 << 16):
            acknowledged += len(data)
        os.close(self.pipe)
        _, status = os.waitpid(self.pid, 0)
        return acknowledged, os.waitstatus_to_exitcode(status)


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
    """0 corrupt, 0 half, 0 acknowledged lost, and the rest of the work leads to the same end."""
    tally = Tally(f"kill -9: {script.name}")
    known = truth(script, folder / "undisturbed")
    span_s = _span_s(script, folder)
    generator = random.Random(seed)
    for trial in range(count):
        place = folder / f"kill-{trial}"
        place.mkdir()
        script.prepare(place)
        child = run(script, place)
        time.sleep(span_s * generator.uniform(0.0, 1.0))
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
