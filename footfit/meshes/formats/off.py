"""OFF (and COFF, NOFF ...): the counts, then one vertex or face on each line."""

from __future__ import annotations

import re

import numpy as np

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.formats.polygons import polygon_triangles, whole
from footfit.meshes.formats.raw import RawMesh, check_counts
from footfit.meshes.formats.tokens import coordinates, floats, text_lines, unix_text
from footfit.meshes.read_limits import Limits

# ST, C, N: texture, colour and normal follow the coordinates. 4 and n would change the coordinates.
_MAGIC = re.compile(rb"\s*(?:ST)?C?N?OFF\b(?!\s*BINARY)", re.IGNORECASE)
_COUNTS = re.compile(rb"\s*(\d{1,15})\s+(\d{1,15})\s")
_COMMENT = re.compile(rb"#[^\n]*")


def is_off(data: bytes) -> bool:
    """Whether the text begins with an OFF keyword that this reader knows."""
    return _MAGIC.match(data.removeprefix(b"\xef\xbb\xbf")[:64]) is not None


def read_off(data: bytes, limits: Limits) -> RawMesh:
    """The vertices and faces of an OFF file; polygons become triangles, colours are ignored.

    Raises
    ------
    DamagedMesh
        There are fewer lines than the counts say, a word is not a number, or a face is impossible.
    TooLarge
        A count is over ``limits``.
    """
    early = _COUNTS.match(_numbers_of(data[: limits.header_bytes]))
    if early is not None:
        check_counts(int(early[1]), int(early[2]), limits)  # before the work
    text = _numbers_of(data)
    rows = text_lines(text)
    values = floats(text, len(rows.words))
    if len(rows.counts) == 0 or rows.counts[0] < 2:
        raise DamagedMesh("the OFF file lacks its counts: export it again")
    n_vertices, n_faces = (_count(value) for value in values[:2])
    check_counts(n_vertices, n_faces, limits)
    if n_vertices + n_faces > len(rows.counts) - 1:
        raise DamagedMesh(
            f"the OFF file declares {n_vertices:,} vertices and {n_faces:,} faces, but has only"
            f" {len(rows.counts) - 1:,} lines for them: it is cut off, export it again"
        )
    after = 1 + n_vertices
    vertices = coordinates(values, rows.first[1:after], rows.counts[1:after])
    ends = slice(after, after + n_faces)
    corners, sizes = _polygons(values, rows.first[ends], rows.counts[ends])
    return RawMesh(vertices, *polygon_triangles(vertices, corners, sizes, limits))


def _numbers_of(data: bytes) -> bytes:
    """The text without its keyword and its comments."""
    return _COMMENT.sub(b"", _MAGIC.sub(b"", unix_text(data), count=1))


def _count(value: float) -> int:
    if not (np.isfinite(value) and value >= 0 and value == int(value)):
        raise DamagedMesh("a count of the OFF file is not a whole number: export it again")
    return int(value)


def _polygons(values: Floats, first: Ints, counts: Ints) -> tuple[Ints, Ints]:
    """The corners of all faces, end to end, and how many each face has."""
    corners = values[first]
    if not ((corners >= 0) & (corners <= counts - 1)).all():
        raise DamagedMesh("a face of the OFF file lacks a corner: export it again")
    sizes = corners.astype(np.int64)
    step = np.arange(int(sizes.sum())) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return whole(values[np.repeat(first + 1, sizes) + step]), sizes
