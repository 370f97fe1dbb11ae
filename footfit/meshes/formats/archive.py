"""One part of a ZIP archive, read piece by piece, up to the size that it may expand to."""

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
_SMALL_BYTES = 1_000_000  # a part up to this size may be packed as tightly as it likes


def archive(data: bytes, limits: Limits) -> ZipFile:
    """A ZIP archive in memory, after its directory has been checked to be short.

    Raises
    ------
    DamagedMesh
        It has no directory, because it is cut off.
    TooLarge
        Its directory is over ``limits.document_bytes`` or lists over ``limits.parts``.
    """
    import zipfile

    tail = data[-_END_BYTES - _COMMENT_BYTES :]
    end = tail[tail.rfind(_END) :]
    if not end.startswith(_END) or len(end) < _END_BYTES:
        raise DamagedMesh("the archive has no directory at its end: it is cut off, copy it again")
    listed = int.from_bytes(end[_DIRECTORY_SIZE], "little")
    if _END_64 in tail or listed > limits.document_bytes:
        raise TooLarge("the archive lists far more parts than one mesh has: export the foot alone")
    zipped = zipfile.ZipFile(io.BytesIO(data))
    if len(zipped.filelist) > limits.parts:
        raise TooLarge(f"the archive has over {limits.parts:,} parts: export the foot alone")
    return zipped


def pieces(zipped: ZipFile, part: ZipInfo, limits: Limits) -> Iterator[bytes]:
    """The part's content in pieces, together no more bytes than it declares.

    Raises
    ------
    UnknownFormat
        The part is encrypted, or packed by another method than deflate. Other methods may need
        gigabytes of memory.
    TooLarge
        It expands to over ``limits.expanded_bytes``, or over ``limits.expansion`` times its size.
    """
    import zipfile

    if part.flag_bits & 1 or part.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise UnknownFormat(
            "the archive is encrypted or packed by a rare method: export it again without that"
        )
    most = max(limits.expansion * part.compress_size, _SMALL_BYTES)
    if part.file_size > min(limits.expanded_bytes, most):
        raise TooLarge(
            f"the archive expands from {part.compress_size:,} to {part.file_size:,} bytes, which is"
            " more than a mesh does: export the foot as STL"
        )
    with zipped.open(part) as stream:
        while piece := stream.read(_PIECE_BYTES):
            yield piece
