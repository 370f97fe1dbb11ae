"""A mesh file read as the command line reads it."""

from __future__ import annotations

import os
from typing import Any

from footfit.meshes.file_bytes import file_bytes
from footfit.meshes.read import scan_from_bytes
from footfit.meshes.read_limits import LIMITS, Limits
from footfit.results import Scan


def read_scan(path: str | os.PathLike[str], limits: Limits = LIMITS, **options: Any) -> Scan:
    """The scan in a file; the options are those of ``scan_from_bytes``."""
    name = os.fspath(path)
    return scan_from_bytes(file_bytes(name, limits), path=name, limits=limits, **options)
