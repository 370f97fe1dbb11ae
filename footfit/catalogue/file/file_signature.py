"""The marks that tell a catalogue from any other file, and one schema from another."""

from __future__ import annotations

import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from footfit.catalogue.file.descriptors import HANDLES
from footfit.errors import CatalogueNotWritable, NotACatalogue

FileKind = Literal["missing", "empty", "catalogue", "interrupted"]


@dataclass(frozen=True, slots=True)
class Marks:
    """Where SQLite's file format keeps its marks, and footfit's own.

    ``application_id`` is "Foot" in ASCII; ``revisions`` are Alembic's, oldest first, and
    ``user_version`` mirrors the last one as a number for other programs to read.
    """

    magic: bytes = b"SQLite format 3\0"
    journal_magic: bytes = bytes.fromhex("d9d505f920a163d7")
    application_id_at: int = 68
    header_bytes: int = 100
    application_id: int = 0x466F6F74
    revisions: tuple[str, ...] = ("0001",)


MARKS = Marks()


def kind_of_file(path: Path) -> FileKind:
    """What lies at ``path``, told from its first 100 bytes: nothing is opened for writing.

    "interrupted" is a file that a live journal beside it has still to settle.

    Raises
    ------
    NotACatalogue
        A folder, a device, another program's database or any other file.
    CatalogueNotWritable
        The file is there and may not even be read.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise NotACatalogue("is not a regular file; name a catalogue file", str(path))
        header = HANDLES.first_bytes(path, MARKS.header_bytes)
    except FileNotFoundError:
        return "missing"
    except OSError as error:
        raise CatalogueNotWritable(
            f"cannot be read ({error.strerror}); check who may read the file and its folder",
            str(path),
        ) from error
    if not header:
        return "empty"
    if header.startswith(MARKS.magic):
        if int.from_bytes(header[MARKS.application_id_at :][:4], "big") == MARKS.application_id:
            return "catalogue"
    elif has_live_journal(path):
        return "interrupted"
    raise NotACatalogue("is not a footfit catalogue and was left as it is", str(path))


def has_live_journal(path: Path) -> bool:
    """Is there a journal to undo a write that is going on, or that a kill or a power cut ended?"""
    journal = path.with_name(path.name + "-journal")
    try:
        return HANDLES.first_bytes(journal, len(MARKS.journal_magic)) == MARKS.journal_magic
    except OSError:
        return False
