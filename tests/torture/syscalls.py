"""Every write of a script fails once: strace injects the error, and its log shows that it did."""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from tests.torture.kills import forked, judge
from tests.torture.power import straced
from tests.torture.scripts import SCRIPTS, Script, mesh_copy, truth
from tests.torture.tally import Tally

LOADED = ("alembic.command", "footfit.catalogue.rows.schema", "sqlalchemy.dialects.sqlite")
"""What the first write of a process imports: loaded once, before the children begin."""
RUNS: tuple[dict[str, str], ...] = (
    dict.fromkeys(("fdatasync", "fsync", "unlink", "ftruncate"), "EIO") | {"pwrite64": "ENOSPC"},
    {"pwrite64": "EIO"},
)
"""Which call fails how; one run of strace has one error for each call."""


def failing_trials(folder: Path, script: Script, every: int, seed: int) -> Tally:
    """Each ``every``-th call of each kind: a documented exit code, before or after, rerun whole.

    strace fails one call number, the same for every process that it follows, and one that no
    script reaches by itself: so each child first makes as many idle calls as bring its own k-th
    one to that number.
    """
    tally = Tally(f"failing calls: {script.name}")
    known = truth(script, folder / "undisturbed")
    (folder / "prepared").mkdir()
    script.prepare(folder / "prepared")
    made = _calls(script, folder)
    codes: Counter[int] = Counter()
    for run, faults in enumerate(RUNS):
        place, log = folder / f"run-{run}", folder / f"log-{run}"
        place.mkdir()
        children = [
            f"{call}:{made[call] + 1}:{k}"
            for call in faults
            for k in range(1 + seed % every, made[call] + 1, every)
        ]
        for child in children:
            shutil.copytree(folder / "prepared", place / child)
        options = ["-e", f"trace={','.join(faults)}"]
        for call, error in faults.items():
            options += ["-e", f"inject={call}:error={error}:when={made[call] + 1}"]
        name = script.name.split(",")[0]
        straced(options, log, "tests.torture.syscalls", name, str(place), *children)
        injected = {
            int(line.split()[0]) for line in log.read_text().splitlines() if "INJECTED" in line
        }
        for child in json.loads((place / "children.json").read_text()):
            what = f"{child['name']} {faults[child['name'].split(':')[0]]}"
            tally.trials += 1
            tally.struck += child["pid"] in injected
            codes[child["code"]] += 1
            _judge_words(tally, child, what)
            judge(tally, known, place / child["name"], child["acknowledged"], what)
        shutil.rmtree(place)
        log.unlink()
    tally.facts |= {f"exit {code}": count for code, count in sorted(codes.items())}
    return tally


def _calls(script: Script, folder: Path) -> Counter[str]:
    """How many calls of each kind an undisturbed run makes."""
    place, log = folder / "counted", folder / "log-counted"
    place.mkdir()
    script.prepare(place)
    kinds = ",".join(RUNS[0])
    name = script.name.split(",")[0]
    straced(["-e", f"trace={kinds}"], log, "tests.torture.worker", name, str(place))
    return Counter(re.findall(r"^\d+ +(\w+)\(", log.read_text(), re.M))


def _judge_words(tally: Tally, child: dict[str, Any], what: str) -> None:
    """Exit 6 with one line, or 0 where the call could fail without harm; never a bug."""
    lines = child["said"].splitlines()
    if child["code"] not in (0, 6) or len(lines) != (child["code"] != 0):
        tally.breach(f"{what}: exit {child['code']}: {child['said']}")


# ------------------------------------------------------------------ under strace


def main(name: str, folder: str, *children: str) -> None:
    """Fork a child for each ``call:number:k``; write what became of them to ``children.json``."""
    script, place = SCRIPTS[name], Path(folder)
    for seed in range(2):  # made once, not in every child
        mesh_copy(seed)
    for module in LOADED:
        import_module(module)
    found = [_child(script, place / child) for child in children]
    (place / "children.json").write_text(json.dumps(found))


def _child(script: Script, here: Path) -> dict[str, Any]:
    """Run a script in a child whose k-th call is the one that fails."""
    call, number, k = here.name.split(":")
    idle_calls = int(number) - int(k)
    child = forked(lambda acknowledge: _failing(script, here, call, idle_calls, acknowledge))
    acknowledged, code = child.wait()
    said = here.with_name(f"{here.name}.said").read_text()
    return {
        "name": here.name,
        "pid": child.pid,
        "acknowledged": acknowledged,
        "code": code,
        "said": said,
    }


def _failing(
    script: Script, place: Path, call: str, idle_calls: int, acknowledge: Callable[[], None]
) -> int:
    """A script behind footfit's own boundary, after so many idle calls."""
    from footfit.cli.boundary import run_guarded

    said = os.open(place.with_name(f"{place.name}.said"), os.O_WRONLY | os.O_CREAT)
    os.dup2(said, 2)
    sys.stderr = os.fdopen(2, "w")
    for _ in range(idle_calls):
        IDLE[call]()

    def work(**_: object) -> None:
        for _step in script.work(place, 0):
            acknowledge()

    return run_guarded(work, [])


def _idle(function: Callable[..., object], *arguments: object) -> Callable[[], None]:
    """A call that changes nothing, whatever it answers."""

    def call() -> None:
        with suppress(OSError):
            function(*arguments)

    return call


_NULL = os.open(os.devnull, os.O_RDWR)
IDLE = {
    "pwrite64": _idle(os.pwrite, _NULL, b".", 0),
    "fdatasync": _idle(os.fdatasync, _NULL),
    "fsync": _idle(os.fsync, _NULL),
    "unlink": _idle(os.unlink, "/nowhere/to/be/found"),
    "ftruncate": _idle(os.ftruncate, _NULL, 0),
}


if __name__ == "__main__":
    main(*sys.argv[1:])
