"""The command line in a process that notes what it touches.

``python -m tests.guarded_run LOG ARGS``. Python's audit events tell every socket, process and
opened file, from the first moment on. What is noted is written to LOG as JSON at the end.
GUARDED_BYTES, where set, bounds the address space. A batch is done in this process, where it is
seen, not in workers of its own.
"""

from __future__ import annotations

import json
import os
import resource
import sys
from pathlib import Path
from typing import Any

SOCKETS, PROCESSES = "sockets", "processes"
WRITTEN, READ = "written", "read"
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC


def main(log: str, arguments: list[str]) -> int:
    touched: dict[str, set[str]] = {SOCKETS: set(), PROCESSES: set(), WRITTEN: set(), READ: set()}

    def note(event: str, found: tuple[Any, ...]) -> None:
        if event.startswith("socket."):
            touched[SOCKETS].add(event)
        elif event in ("subprocess.Popen", "os.system", "os.exec", "os.posix_spawn"):
            touched[PROCESSES].add(event)
        elif event == "open" and isinstance(found[0], (str, bytes)):
            kind = WRITTEN if (found[2] or 0) & _WRITING else READ
            touched[kind].add(os.fsdecode(found[0]))

    sys.addaudithook(note)
    most = os.environ.get("GUARDED_BYTES")
    if most is not None:
        import numpy  # noqa: F401 - its BLAS maps what it never uses

        resource.setrlimit(resource.RLIMIT_AS, (int(most), int(most)))
    from footfit.cli.app import application
    from footfit.cli.boundary import run_guarded
    from footfit.pipeline.batch import runs

    apart = runs.outcomes
    runs.outcomes = lambda work, items, _jobs, **more: apart(work, items, runs.HERE, **more)

    sys.argv = ["footfit", *arguments]
    code = run_guarded(application(), arguments)
    noted = json.dumps({kind: sorted(names) for kind, names in touched.items()})
    Path(log).write_text(noted, encoding="utf-8", errors="backslashreplace")
    return code


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1], sys.argv[2:]))
