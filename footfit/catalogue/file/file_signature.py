"""The marks that tell a catalogue from any other file, and one schema from another."""

from __future__ import annotations

import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from footfit.catalogue.file.descriptors import DESCRIPTORS
from footfit.errors import CatalogueNotWritable, NotACatalogue

FileKind = Literal["missing", "empty", "catalogue", "interrupted"]


@dataclass(frozen=True, slots=True)
class Signature:
    """The marks of SQLite's file format, where they stand, and footfit's own.

    ``application_id`` is "Foot" in ASCII. ``revisions`` are Alembic's, oldest first;
    ``user_version`` repeats the last one as a number for other programs to read.
    """

    magic: bytes = b"SQLite format 3\0"
    journal_magic: bytes = bytes.fromhex("d9d505f920a163d7")
    application_id_at: int = 68
    header_bytes: int = 100
    application_id: int = 0x466F6F74
    revisions: tuple[str, ...] = ("0001", "0002", "0003", "0004", "0005")


SIGNATURE = Signature()
NOT_A_CATALOGUE = "is not a footfit catalogue and was left as it is"


def kind_of_file(path: Path) -> FileKind:
    """What lies at ``path``, told from its first 100 bytes: nothing is opened for writing.

    "interrupted" is a file whose journal still has to be played back.

    Raises
    ------
    NotACatalogue
        A folder, a device, another program's database or any other file.
    CatalogueNotWritable
        The file is there and cannot even be read.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise NotACatalogue("is not a regular file; name a catalogue file", str(path))
        header = DESCRIPTORS.first_bytes(path, SIGNATURE.header_bytes)
    except FileNotFoundError:
        return "missing"
    except OSError as error:
        raise CatalogueNotWritable(
            f"cannot be read ({error.strerror}); check who may read the file and its folder",
            str(path),
        ) from error
    if not header:
        return "empty"
    if header.startswith(SIGNATURE.magic):
        mark = header[SIGNATURE.application_id_at :][:4]
        if int.from_bytes(mark, "big") == SIGNATURE.application_id:
            return "catalogue"
    elif has_live_journal(path):
        return "interrupted"
    raise NotACatalogue(NOT_A_CATALOGUE, str(path))


def has_live_journal(path: Path) -> bool:
    """Whether a journal lies beside the file: of a write that goes on, or that was cut short."""
    journal = path.with_name(path.name + "-journal")
    try:
        start = DESCRIPTORS.first_bytes(journal, len(SIGNATURE.journal_magic))
    except OSError:
        return False
    return start == SIGNATURE.journal_magic
