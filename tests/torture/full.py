"""Disks and files that are full: a small tmpfs, a limit on the size of a file."""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.torture.kills import Child, forked, judge
from tests.torture.scripts import Script, truth
from tests.torture.tally import Tally


def tmpfs_missing() -> str | None:
    """Why no small file system can be mounted here, or None."""
    if os.geteuid() != 0:
        return "a small tmpfs can only be mounted by root"
    probe = Path("/tmp") / f"footfit-probe-{os.getpid()}"
    probe.mkdir()
    try:
        with _tmpfs(probe, 64):
            return None
    except OSError as error:
        return f"no tmpfs can be mounted here: {error}"
    finally:
        probe.rmdir()


@contextmanager
def _tmpfs(place: Path, kib: int) -> Iterator[None]:
    _mount("-t", "tmpfs", "-o", f"size={kib}k", "tmpfs", str(place))
    try:
        yield
    finally:
        subprocess.run(["umount", str(place)], check=False)


def _mount(*arguments: str) -> None:
    done = subprocess.run(["mount", *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise OSError(done.stderr.strip())


def full_disk_trials(folder: Path, script: Script, sizes: int) -> Tally:
    """A disk of each size: words and exit 6, what was stored is whole, more room completes it."""
    tally = Tally(f"full disk: {script.name}")
    known = truth(script, folder / "undisturbed")
    largest = sum(path.stat().st_size for path in (folder / "undisturbed").iterdir())
    for trial in range(sizes):
        place = folder / f"disk-{trial}"
        place.mkdir()
        kib = 8 + int(trial / sizes * 1.5 * largest / 1024)
        with _tmpfs(place, 4096):
            script.prepare(place)
            taken = sum(path.stat().st_size for path in place.iterdir()) // 1024
            _mount("-o", f"remount,size={taken + kib}k", str(place))
            child = _behind_the_boundary(script, place, folder / "said")
            acknowledged, code = child.wait()
            _mount("-o", "remount,size=64m", str(place))
            _judge(tally, code, folder / "said", f"{kib} KiB")
            judge(tally, known, place, acknowledged, f"{kib} KiB")
    return tally


def file_limit_trials(folder: Path, script: Script, sizes: int) -> Tally:
    """The same with RLIMIT_FSIZE, which SQLite meets as an I/O error."""
    tally = Tally(f"file limit: {script.name}")
    known = truth(script, folder / "undisturbed")
    largest = max(path.stat().st_size for path in (folder / "undisturbed").iterdir())
    for trial in range(sizes):
        place, limit = folder / f"limit-{trial}", int((trial + 0.5) / sizes * largest)
        place.mkdir()
        script.prepare(place)
        child = _behind_the_boundary(script, place, folder / "said", limit)
        acknowledged, code = child.wait()
        _judge(tally, code, folder / "said", f"{limit} bytes")
        judge(tally, known, place, acknowledged, f"{limit} bytes")
        shutil.rmtree(place)
    return tally


def _behind_the_boundary(
    script: Script, place: Path, said: Path, file_bytes: int | None = None
) -> Child:
    def work(acknowledge: Callable[[], None]) -> int:
        from footfit.cli.boundary import run_guarded

        handle = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(handle, 2)
        sys.stderr = os.fdopen(2, "w")
        if file_bytes is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, file_bytes))

        def steps(**_: object) -> None:
            for _step in script.work(place, 0):
                acknowledge()

        return run_guarded(steps, [])

    return forked(work)


def _judge(tally: Tally, code: int, said: Path, what: str) -> None:
    lines = said.read_text().splitlines()
    tally.trials += 1
    tally.struck += code == 6
    if code not in (0, 6) or len(lines) != (code != 0):
        tally.breach(f"{what}: exit {code}: {lines}")
