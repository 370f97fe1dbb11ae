"""Output files: written beside and renamed, never over an existing one unasked."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from footfit.cli.console import answer
from footfit.cli.options import STDOUT
from footfit.errors import BadOption, OutputExists
from footfit.pipeline.export import file_kind


def refuse_existing(*paths: Path | None, force: bool, kinds: tuple[str, ...] | None = None) -> None:
    """Stop before any work where an output could not be written at its end.

    ``kinds`` are the suffixes that the outputs may have, None any.

    Raises
    ------
    OutputExists
        A file is there and ``force`` is not given.
    BadOption
        The folder does not exist, the path is a folder or no path, the suffix is another.
    """
    for path in paths:
        if path is None or (path == STDOUT and kinds is None):
            continue
        try:
            _refuse(path, force=force)
        except OSError as error:  # a name too long, a folder closed to us
            raise BadOption(f"cannot be written: {error.strerror}", str(path)) from error
        if kinds is not None:
            file_kind(path, kinds)


def _refuse(path: Path, *, force: bool) -> None:
    if path.is_dir():
        raise BadOption("is a folder; name a file in it", str(path))
    if not path.parent.is_dir():
        raise BadOption(f"the folder {path.parent} does not exist; make it first", str(path))
    if path.exists() and not force:
        raise OutputExists("exists; add --force to replace it", str(path))


def write_output(path: Path, data: bytes | str, *, force: bool) -> None:
    """Write the whole of ``data`` to ``path``, or nothing.

    Raises
    ------
    OutputExists, BadOption
        As `refuse_existing`; also where the system refuses the write.
    """
    refuse_existing(path, force=force)
    content = data.encode("utf-8") if isinstance(data, str) else data
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    except OSError as error:
        raise BadOption(f"cannot be written: {error.strerror}", str(path)) from error
    beside = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        beside.chmod(0o666 & ~_umask())
        if force:
            beside.replace(path)
        else:  # a file that came meanwhile is not ours to replace: link refuses, rename does not
            os.link(beside, path)
    except FileExistsError as error:
        raise OutputExists("exists; add --force to replace it", str(path)) from error
    except OSError as error:
        raise BadOption(f"cannot be written: {error.strerror}", str(path)) from error
    finally:
        beside.unlink(missing_ok=True)


def one_answer(csv: Path | None, *, as_json: bool) -> None:
    """Refuse two answers on one stdout.

    Raises
    ------
    BadOption
        ``--csv -`` together with ``--json``.
    """
    if csv == STDOUT and as_json:
        raise BadOption("--csv - and --json both write to stdout; give --csv a file")


def write_or_answer(path: Path, text: str, *, force: bool) -> None:
    """Write ``text`` to the file, or to stdout where the path is ``-``.

    Raises
    ------
    OutputExists, BadOption
        As `write_output`.
    """
    if path == STDOUT:
        answer(text)
    else:
        write_output(path, text, force=force)


def _umask() -> int:
    """The process's umask, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
