"""The kind of a file that is not a mesh, so that the message can name it."""

from __future__ import annotations

import re

_LOOKED_AT_BYTES = 4_096

_BEGINNINGS: tuple[tuple[bytes, str], ...] = (
    (
        b"version https://git-lfs",
        "a Git LFS pointer (the mesh itself was not fetched: git lfs pull)",
    ),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"II*\0", "a TIFF picture"),
    (b"MM\0*", "a TIFF picture"),
    (b"PK", "a ZIP archive (unpack it first)"),
    (b"\x1f\x8b", "a gzip archive (unpack it first)"),
    (b"BZh", "a bzip2 archive (unpack it first)"),
    (b"\xfd7zXZ", "an xz archive (unpack it first)"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive (unpack it first)"),
    (b"Rar!", "a RAR archive (unpack it first)"),
    (b"%PDF", "a PDF document"),
    (b"\xd0\xcf\x11\xe0", "an old Office document"),
    (b"SQLite format 3\0", "an SQLite database"),
    (b"Kaydara FBX", "an FBX model"),
    (b"ISO-10303-21", "a STEP model (export it as STL)"),
    (b"#VRML", "a VRML model (export it as STL)"),
    (b"# .PCD", "a PCD point cloud (mesh it first)"),
    (b"\x7fELF", "a program"),
    (b"MZ", "a program"),
    (b"#!/", "a script"),
    (b"\xff\xfe", "UTF-16 text"),
    (b"\xfe\xff", "UTF-16 text"),
)
_MARKUP: tuple[tuple[re.Pattern[bytes], str], ...] = (
    (re.compile(rb"\s*(<!doctype html|<html)", re.IGNORECASE), "an HTML page (a failed download?)"),
    (re.compile(rb"\s*<"), "XML"),
    (re.compile(rb"\s*[{\[]"), "JSON (a glTF text file? export it as GLB)"),
)
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1a\x1c-\x1f]")


def is_text(data: bytes) -> bool:
    """Whether the beginning has no control characters that text does not use."""
    return _CONTROL.search(data[:_LOOKED_AT_BYTES]) is None


def known_foreign(data: bytes) -> str | None:
    """The name of a kind of file that footfit certainly does not read, else None.

    Examples
    --------
    >>> known_foreign(b"<!DOCTYPE html><html>")
    'an HTML page (a failed download?)'
    """
    for magic, words in _BEGINNINGS:
        if data.startswith(magic):
            return words
    head = data[:_LOOKED_AT_BYTES].removeprefix(b"\xef\xbb\xbf")
    return next((words for pattern, words in _MARKUP if pattern.match(head)), None)


def likeness(data: bytes) -> str:
    """What the content looks like, as words after "looks like".

    Examples
    --------
    >>> likeness(b"dear last maker"), likeness(bytes(9))
    ('text without a mesh in it', 'binary data of no known kind')
    """
    plain = "text without a mesh in it" if is_text(data) else "binary data of no known kind"
    return known_foreign(data) or plain
