"""One part of a ZIP archive, read piece by piece and never past what it may expand to."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import TYPE_CHECKING

from footfit.errors import DamagedMesh, TooLarge, UnknownFormat
from footfit.meshes.read_limits import Limits

if TYPE_CHECKING:
    from zipfile import ZipFile, ZipInfo

_END, _END_64 = b"PK\5\6", b"PK\6\7"
_END_BYTES = 22
_COMMENT_BYTES = 65_535
_DIRECTORY_SIZE = slice(12, 16)
_PIECE_BYTES = 1_000_000
_SMALL_BYTES = 1_000_000  # what is no larger than this may be packed as tightly as it likes


def archive(data: bytes, limits: Limits) -> ZipFile:
    """A ZIP archive in memory whose directory has been seen to be short.

    Raises
    ------
    DamagedMesh
        It has no directory: it is cut off.
    TooLarge
        Its directory is longer than ``limits.document_bytes`` or lists over ``limits.parts``.
    """
    import zipfile

    tail = data[-_END_BYTES - _COMMENT_BYTES :]
    end = tail[tail.rfind(_END) :]
    if not end.startswith(_END) or len(end) < _END_BYTES:
        raise DamagedMesh("the archive has no directory at its end: it is cut off, copy it again")
    listed = int.from_bytes(end[_DIRECTORY_SIZE], "little")
    if _END_64 in tail or listed > limits.document_bytes:
        raise TooLarge("the archive lists far more parts than one mesh has: export the foot alone")
    found = zipfile.ZipFile(io.BytesIO(data))
    if len(found.filelist) > limits.parts:
        raise TooLarge(f"the archive has over {limits.parts:,} parts: export the foot alone")
    return found


def pieces(zipped: ZipFile, part: ZipInfo, limits: Limits) -> Iterator[bytes]:
    """The part's content in pieces; whatever it claims, no more than it declares comes out.

    Raises
    ------
    UnknownFormat
        Encrypted, or packed otherwise than by deflate (others ask for gigabytes to unpack).
    TooLarge
        It expands past ``limits.expanded_bytes``, or more than ``limits.expansion``-fold.
    """
    import zipfile

    if part.flag_bits & 1 or part.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise UnknownFormat("the archive is encrypted or packed in a rare way: export it again")
    most = max(limits.expansion * part.compress_size, _SMALL_BYTES)
    if part.file_size > min(limits.expanded_bytes, most):
        raise TooLarge(
            f"the archive expands from {part.compress_size:,} to {part.file_size:,} bytes,"
            " more than a mesh does: export the foot as STL"
        )
    with zipped.open(part) as stream:
        while piece := stream.read(_PIECE_BYTES):
            yield piece
