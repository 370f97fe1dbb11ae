"""A file is written whole or not at all: it gets its name once it is complete and on the disk."""

from __future__ import annotations

import errno
import hashlib
import os
import re
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from footfit.errors import BadOption, OutputExists

KEPT_OF_NAME = 40
"""So many characters of a file's name come back in that of its partial file: a name of 255 bytes
leaves no room for more.
"""
_NOT_IN_NAMES = frozenset('<>:"/\\|?*#%')
"""What Windows takes in no name; # and % end or change the address of a page."""
_RESERVED = re.compile(r"con|prn|aux|nul|(com|lpt)[0-9]")
_NAME_BYTES = 180
"""A name has at most 255 bytes; a page is kept, sent and put into other folders."""


def require_free(path: Path, *, replace: bool) -> None:
    """Refuse a path that no file could be given at the end.

    Raises
    ------
    OutputExists
        There is a file, and it may not be replaced.
    BadOption
        The path is a folder or ``-``, or its folder does not exist.
    """
    if path == Path("-"):
        raise BadOption("- stands for stdout, and this goes to a file; name the file")
    if path.is_dir():
        raise BadOption("is a folder; name a file in it", str(path))
    require_folder(path)
    if path.exists() and not replace:
        raise _exists(path)


def require_folder(path: Path) -> None:
    """Refuse a path whose folder is missing: it may be mistyped, so nothing makes the folder.

    Raises
    ------
    BadOption
        Its folder does not exist.
    """
    if not path.parent.is_dir():
        words = f"the folder {path.parent} does not exist: check the path, or make the folder first"
        raise BadOption(words, str(path))


def safe_file_name(name: str, ending: str) -> str:
    """A name that every system takes for a file, from any text; two texts may give one name.

    Examples
    --------
    >>> safe_file_name("Ann/Bob: 42?", ".html"), safe_file_name("con", ".html")
    ('Ann_Bob_ 42_.html', '_con.html')
    >>> safe_file_name("..", ".html"), len(safe_file_name("long" * 99, ".html"))
    ('_.html', 184)
    """
    plain = unicodedata.normalize("NFC", name)
    kept = "".join("_" if c in _NOT_IN_NAMES or not c.isprintable() else c for c in plain)
    kept = kept.strip(" .").removeprefix("-") or "_"
    if _RESERVED.fullmatch(kept.partition(".")[0].casefold()):
        kept = f"_{kept}"
    if len(kept.encode()) > _NAME_BYTES:  # a digest tells long names apart
        digest = hashlib.sha256(plain.encode("utf-8", "replace")).hexdigest()[:8]
        kept = f"{kept.encode()[: _NAME_BYTES - 10].decode('utf-8', 'ignore')}~{digest}"
    return kept + ending


@contextmanager
def partial_beside(final: Path) -> Iterator[Path]:
    """Make an empty file with a name of its own beside ``final``; remove it after the block.

    Raises
    ------
    OSError
        The folder is missing or takes no file.
    """
    prefix = f".{final.name[:KEPT_OF_NAME]}."
    import tempfile

    descriptor, name = tempfile.mkstemp(dir=final.parent, prefix=prefix, suffix=".partial")
    os.close(descriptor)
    partial = Path(name)
    try:
        yield partial
    finally:
        for left in (partial, partial.with_name(f"{partial.name}-journal")):  # SQLite's journal
            left.unlink(missing_ok=True)


def give_name(partial: Path, final: Path, *, replace: bool) -> None:
    """Give a complete file its final name, so that it also has it after a power cut.

    Raises
    ------
    OutputExists
        There is a file of that name, and it may not be replaced.
    OSError
        The system refuses.
    """
    with suppress(PermissionError):  # FAT keeps no permissions
        partial.chmod(0o666 & ~_umask())
    try:
        if replace:
            partial.replace(final)
        else:
            _give_free_name(partial, final)
    except FileExistsError as error:
        raise _exists(final) from error
    sync(final.parent)


def _give_free_name(partial: Path, final: Path) -> None:
    """Name a file, but never replace one that was made meanwhile: link refuses to, rename does not.

    FAT and some network drives have no links. There the name is taken by an empty file first. A
    kill at that moment leaves the empty file.
    """
    try:
        os.link(partial, final)
    except FileExistsError:
        raise
    except (OSError, AttributeError):  # the drive, or the system, has no links
        os.close(os.open(final, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
        try:
            partial.replace(final)
        except OSError:
            final.unlink()
            raise


def sync(path: Path) -> None:
    """Wait until a file, or the list of names in a folder, is on the disk.

    Raises
    ------
    OSError
        The disk does not take it.
    """
    is_folder = path.is_dir()
    if is_folder and os.name == "nt":  # Windows opens no folder
        return
    descriptor = os.open(path, os.O_RDONLY if is_folder else os.O_RDWR)
    try:
        os.fsync(descriptor)
    except OSError as error:  # some network drives keep no list of names to wait for
        if not is_folder or error.errno not in (errno.EINVAL, errno.ENOTSUP):
            raise
    finally:
        os.close(descriptor)


def _exists(path: Path) -> OutputExists:
    return OutputExists("exists; add --force to replace it", str(path))


def _umask() -> int:
    """The process's umask, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
