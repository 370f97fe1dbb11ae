"""A mesh file read as the command line reads it."""

from __future__ import annotations

import os
from typing import Any

from footfit.errors import FootfitError
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.pipeline.scan.reading import read
from footfit.results import Scan


def read_scan(path: str | os.PathLike[str], **options: Any) -> Scan:
    """The scan in a file; ``options`` are those of ReadingOptions. Errors name the file."""
    name = os.fspath(path)
    try:
        return read(Source(name), ReadingOptions(**options))
    except FootfitError as error:
        raise error.at(name) from error


def scan_from_bytes(
    data: bytes,
    path: str | None = None,
    format: str | None = None,  # noqa: A002  the option's name
    **options: Any,
) -> Scan:
    """The scan in the content of a file."""
    return read(Source(path, data, format), ReadingOptions(**options))
