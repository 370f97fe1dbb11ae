"""STL, binary and ASCII. It has no unit, and three separate vertices for each facet."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh, EmptyMesh
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.formats.foreign import is_text
from footfit.meshes.formats.raw import RawMesh, check_counts, doubles
from footfit.meshes.formats.tokens import BLANK, floats, unix_text, word_offsets
from footfit.meshes.read_limits import Limits
from footfit.results.values import Notice, count_notice

HEADER_BYTES = 84
FACET = np.dtype([("normal", "<f4", (3,)), ("corners", "<f4", (9,)), ("attribute", "<u2")])
_TRAILING_BYTES = 4_096  # exporters append so much; with more, the count is wrong
_CHUNK_BYTES = 1_000_000  # the arrays of a chunk stay in a processor's cache
_LEAST_FACET_BYTES = 86  # of the shortest way to write a facet

# The 21 words of an ASCII facet: a keyword, or None where a number stands.
_POINT = ("vertex", None, None, None)
_GRAMMAR = (
    *("facet", "normal", None, None, None, "outer", "loop"),
    *(_POINT + _POINT + _POINT),
    *("endloop", "endfacet"),
)
_KEYWORDS = tuple((place, word.encode()) for place, word in enumerate(_GRAMMAR) if word)
_WORD_END = b" " * 8  # after the last word, so that eight bytes can be read at any word
_POINT_BOUNDS = (8, 11, 12, 15, 16, 19)  # a point's first word, and the one after its last
_LAST_FACET = re.compile(rb"endfacet\s", re.IGNORECASE)
_END = re.compile(rb"end[ \t]*solid", re.IGNORECASE)
_UNENDED = Notice("end_missing", "the ASCII STL has no endsolid line: its end may be missing")


def declared_facets(data: bytes) -> int | None:
    """The count in a binary STL's header; None where the header is not complete."""
    if len(data) < HEADER_BYTES:
        return None
    return int.from_bytes(data[HEADER_BYTES - 4 : HEADER_BYTES], "little")


def is_binary_stl(data: bytes) -> bool:
    """Whether the size is exactly as the count says. The words in the header do not matter."""
    count = declared_facets(data)
    return count is not None and len(data) == HEADER_BYTES + FACET.itemsize * count


def is_ascii_stl(data: bytes) -> bool:
    """Whether the text begins as that of an STL."""
    begins = data[:4096].removeprefix(b"\xef\xbb\xbf").lstrip().lower().startswith(b"solid")
    return begins and is_text(data)


def read_binary_stl(data: bytes, limits: Limits) -> RawMesh:
    """The facets of a binary STL: 84 bytes of header, 50 bytes a facet.

    Raises
    ------
    DamagedMesh
        The file is shorter than its count says, or so much longer that the count must be wrong.
    EmptyMesh, TooLarge
        There are no facets, or more than ``limits`` allow.
    """
    count = declared_facets(data)
    if count is None:
        raise DamagedMesh(
            f"a binary STL has at least {HEADER_BYTES} bytes: the file is cut off, copy it again"
        )
    needed = HEADER_BYTES + FACET.itemsize * count
    if len(data) < needed:
        raise DamagedMesh(
            f"the header declares {count:,} facets ({needed:,} bytes), but the file has"
            f" {len(data):,} bytes: it is cut off, copy or export it again"
        )
    trailing = len(data) - needed
    if trailing > max(_TRAILING_BYTES, (needed - HEADER_BYTES) // 100) or (trailing and not count):
        raise DamagedMesh(
            f"the header declares {count:,} facets, but {trailing:,} more bytes follow them:"
            " the count is wrong, export it again"
        )
    if count == 0:
        raise EmptyMesh("the STL holds no facets: export it again")
    check_counts(0, count, limits)
    facets = np.frombuffer(data, dtype=FACET, count=count, offset=HEADER_BYTES)
    notices = count_notice(
        "trailing_bytes",
        trailing,
        "bytes after the last facet were ignored",
        "byte after the last facet was ignored",
    )
    return _soup(doubles(facets["corners"].reshape(-1, 3)), notices)


def read_ascii_stl(data: bytes, limits: Limits) -> RawMesh:
    """The facets of an ASCII STL; several solids in one file are one mesh.

    Raises
    ------
    DamagedMesh
        The words are not those of facets, or the file ends within a facet.
    EmptyMesh, TooLarge
        There are no facets, or more than ``limits`` allow.
    """
    if len(data) > _LEAST_FACET_BYTES * limits.faces:  # before the work
        check_counts(0, data.count(b"endfacet"), limits)
    text = unix_text(data)
    corners, facets = [], 0
    for chunk in _chunks(text):
        corners.append(_corners_of(chunk))
        facets += len(corners[-1]) // 3
        check_counts(0, facets, limits)
    if facets == 0:
        raise EmptyMesh("the STL holds no facets: export it again")
    ended = _END.search(text, max(0, len(text) - limits.header_bytes)) is not None
    return _soup(np.concatenate(corners), () if ended else (_UNENDED,))


def _chunks(text: bytes) -> Iterator[bytes]:
    """Pieces of the text that end after a facet, so that a piece's words need little memory."""
    begin = 0
    while begin < len(text):
        end = begin + _CHUNK_BYTES
        if end < len(text):
            following = _LAST_FACET.search(text, end)
            end = following.end() if following else len(text)
        yield text[begin:end]
        begin = end


def _corners_of(chunk: bytes) -> Floats:
    """The corners in a piece of the text; most often it is nothing but lower-case facets."""
    try:
        return _facet_corners(chunk)
    except DamagedMesh:
        return _facet_corners(_without_solid_lines(chunk.lower()))


def _without_solid_lines(text: bytes) -> bytes:
    """The text without the lines that begin or end a solid."""
    pieces, begin = [], 0
    while (at := text.find(b"solid", begin)) >= 0:
        line = max(begin, text.rfind(b"\n", begin, at))
        end = text.find(b"\n", at)
        end = len(text) if end < 0 else end
        names = text[line:at].strip() in (b"", b"end")
        pieces.append(text[begin : line if names else end])
        begin = end
    return b"".join([*pieces, text[begin:]]) if pieces else text


def _facet_corners(text: bytes) -> Floats:
    """The corners (3 m, 3) in a lower-case text that is nothing but facets."""
    buffer = np.frombuffer(text + _WORD_END, dtype=np.uint8)
    words = word_offsets(buffer)
    if len(words) % len(_GRAMMAR):
        raise DamagedMesh("the ASCII STL ends within a facet: it is cut off, export it again")
    facets = words.reshape(-1, len(_GRAMMAR))
    starts = np.ndarray(len(text) + 1, dtype="<u8", buffer=buffer, strides=(1,))
    for place, keyword in _KEYWORDS:
        _check_keyword(starts[facets[:, place]], facets[:, place], buffer, keyword)
    bounds = facets[:, _POINT_BOUNDS].ravel()
    spans = np.diff(bounds, prepend=0, append=len(buffer))
    inside = np.repeat(np.arange(len(spans)) % 2 == 1, spans)  # from each point to after it
    return floats(buffer[inside].tobytes(), 9 * len(facets)).reshape(-1, 3)


def _check_keyword(
    words: NDArray[np.uint64], places: Ints, buffer: NDArray[np.uint8], keyword: bytes
) -> None:
    """Refuse the facets unless ``keyword`` stands at each of ``places``.

    ``words`` are the eight bytes at each place as a number; no keyword is longer.
    """
    wanted = np.uint64(int.from_bytes(keyword, "little"))
    mask = np.uint64((1 << 8 * len(keyword)) - 1)
    whole = buffer[places + len(keyword)] <= BLANK
    if not (whole.all() and ((words & mask) == wanted).all()):
        raise DamagedMesh(
            f"a facet of the ASCII STL lacks the word {keyword.decode()!r}: export it again"
        )


def _soup(corners: Floats, warnings: tuple[Notice, ...]) -> RawMesh:
    return RawMesh(corners, np.arange(len(corners), dtype=np.int64).reshape(-1, 3), warnings)
