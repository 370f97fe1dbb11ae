"""rhino3dm in a process of its own, watched: bytes in, bytes out, or the word that it failed."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

from footfit.meshes.read_limits import Limits

PROGRAM = Path(__file__).with_name("in_process.py")
INSTALL = "type pip install 'footfit[rhino]'"
"""What to do without the optional part that reads and writes ``.3dm``."""


@dataclass(frozen=True, slots=True)
class RhinoSettings:
    """What the process may take.

    Attributes
    ----------
    seconds : float
        A file of a million faces takes 10 s; rhino3dm looks through a damaged one for minutes.
    memory_bytes : int
    """

    seconds: float = 30.0
    memory_bytes: int = 3_500_000_000


RHINO = RhinoSettings()


class RhinoFailed(Exception):
    """The process ended without an answer, or took too long."""


def is_installed() -> bool:
    """Whether rhino3dm can be imported; it is not imported here."""
    return find_spec("rhino3dm") is not None


def run(verb: Literal["read", "write"], data: bytes, limits: Limits) -> bytes:
    """What ``in_process.py`` answers.

    Raises
    ------
    RhinoFailed
        There is no answer.
    """
    allowed = {
        "parts": limits.parts,
        "vertices": limits.vertices,
        "faces": limits.faces,
        "memory_bytes": RHINO.memory_bytes,
    }
    command = [sys.executable, "-P", str(PROGRAM), verb, json.dumps(allowed)]
    try:
        done = subprocess.run(command, input=data, capture_output=True, timeout=RHINO.seconds)
    except (subprocess.TimeoutExpired, OSError) as error:
        raise RhinoFailed from error
    if done.returncode != 0:
        raise RhinoFailed(done.stderr.decode(errors="replace")[-200:])
    return done.stdout
