"""SIGINT and SIGTERM to the real command at random moments of an ingest."""

from __future__ import annotations

import json
import os
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

from footfit.catalogue.store import open_catalogue
from footfit.errors import NoCatalogue
from tests import records
from tests.torture.tally import Tally

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "sample_data" / "lasts.csv"
LONG_S = 10.0
"""Far past the two seconds, which a busy machine may not keep, and far from the 30 s of a lock."""
CODES = {signal.SIGINT: 130, signal.SIGTERM: 143}


def signal_trials(folder: Path, count: int, seed: int, jobs: int, until_s: float) -> Tally:
    """Ended within 2 s with 130 or 143, no child left, and as many lasts as it says.

    Until the program has loaded, the system ends it: -2 or -15, in a shell 130 or 143 as well.
    """
    tally = Tally(f"SIGINT, SIGTERM, {jobs} jobs")
    generator = random.Random(seed)
    slowest_s = 0.0
    for trial in range(count):
        path = folder / f"signal-{trial}" / "lasts.footfit"
        path.parent.mkdir()
        number = generator.choice(list(CODES))
        command = ["ingest-last", "--manifest", str(SAMPLES), "--catalogue", str(path), "--json"]
        process = subprocess.Popen(
            [sys.executable, "-m", "footfit", *command, "--jobs", str(jobs)],
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            preexec_fn=_hearing,
        )
        told = ""
        if trial % 2:  # in the midst of the work, however slow the machine is
            told = first_lines(process, generator.randrange(1, 4))
            time.sleep(generator.uniform(0.0, until_s / 10))
        else:
            time.sleep(generator.uniform(0.0, until_s))
        begun = time.monotonic()
        if generator.random() < 0.5:
            process.send_signal(number)  # as a service manager does
        else:
            os.killpg(process.pid, number)  # as a terminal does
        out, said = process.communicate(timeout=60)
        out = told + out
        slowest_s = max(slowest_s, time.monotonic() - begun)
        tally.trials += 1
        tally.struck += process.returncode != 0
        _judge(tally, path, number, process, out, said)
        shutil.rmtree(path.parent)
    tally.facts["slowest s"] = round(slowest_s, 2)
    return tally


def first_lines(process: subprocess.Popen[str], count: int) -> str:
    """The first lines that a process answers, byte by byte: ``communicate`` gets the rest."""
    assert process.stdout is not None
    told = b""
    while told.count(b"\n") < count and (byte := os.read(process.stdout.fileno(), 1)):
        told += byte
    return told.decode()


def _hearing() -> None:
    """Hear SIGINT even where these trials run in the background, which ignores it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _judge(
    tally: Tally,
    path: Path,
    number: int,
    process: subprocess.Popen[str],
    out: str,
    said: str,
) -> None:
    code = process.returncode
    what = f"{signal.Signals(number).name} -> {code}"
    if code not in (0, CODES[signal.Signals(number)], -number):
        tally.breach(f"{what}: {said}")
    if "Traceback" in said and code != -number:  # Python itself was loading
        tally.breach(f"{what}: {said}")
    lines = [json.loads(line) for line in out.splitlines()]
    stored = _stored(path)
    told = {line["last"] for line in lines if line["status"] == "added"}
    if told != stored:
        tally.breach(f"{what}: it said {sorted(told)} and stored {sorted(stored)}")
    counted = re.search(r"after (\d+) of \d+ files", said)
    if counted and int(counted[1]) != len(lines):
        tally.breach(f"{what}: it said {counted[1]} files and answered {len(lines)}")
    if code > 0 and lines and not counted:  # without a line the batch had not begun
        tally.breach(f"{what}: no count: {said}")
    if not gone(process.pid):
        tally.breach(f"{what}: a child is left: {_left(process.pid)}")


def lock_trial(folder: Path) -> Tally:
    """A signal to a command that waits for another program's lock, which takes up to 30 s."""
    tally = Tally("SIGTERM while waiting for a lock", trials=1)
    path = folder / "lasts.footfit"
    with open_catalogue(path, write=True) as catalogue:
        catalogue.add(records.last("last", 0))
    holder = sqlite3.connect(path, isolation_level=None)
    holder.execute("BEGIN EXCLUSIVE")
    process = subprocess.Popen(
        [sys.executable, "-m", "footfit", "remove-last", "last", "--catalogue", str(path)],
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        process.wait(4.0)
        tally.breach("it did not wait for the lock")
    except subprocess.TimeoutExpired:
        tally.struck = 1
    begun = time.monotonic()
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=60)
    waited_s = time.monotonic() - begun
    holder.close()
    if waited_s > LONG_S or process.returncode != 143 or "ended by SIGTERM" not in said:
        tally.breach(f"exit {process.returncode} after {waited_s:.1f} s: {said}")
    tally.facts["slowest s"] = round(waited_s, 2)
    return tally


def _stored(path: Path) -> set[str]:
    try:
        with open_catalogue(path) as catalogue:
            return set(catalogue.names()) if not catalogue.findings() else {"damage"}
    except NoCatalogue:
        return set()


def _left(group: int) -> str:
    """The commands of a process group; one that has ended and that init has not asked after is
    none.
    """
    done = subprocess.run(
        ["ps", "-eo", "pgid=,pid=,ppid=,stat=,args="], capture_output=True, text=True, check=False
    )
    return "; ".join(
        line
        for line in done.stdout.splitlines()
        if line.split()[0] == str(group) and "Z" not in line.split()[3]
    )


def gone(group: int) -> bool:
    """Is nobody of a process group left, or soon?"""
    for _ in range(40):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.05)
    return not _left(group)
