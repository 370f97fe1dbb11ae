"""Wavefront OBJ: only the ``v`` and ``f`` lines. Materials and other files are never opened."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.meshes.formats.foreign import is_text, known_foreign
from footfit.meshes.formats.polygons import polygon_triangles
from footfit.meshes.formats.raw import RawMesh, check_counts
from footfit.meshes.formats.tokens import (
    Lines,
    coordinates,
    floats,
    integers,
    text_lines,
    unix_text,
)
from footfit.meshes.read_limits import Limits

_SNIFFED_BYTES = 1_000_000
_VERTEX_LINE = re.compile(rb"^[ \t]*v[ \t]+[-+.\d]", re.MULTILINE)
_COMMENT = re.compile(rb"#[^\n]*")
_CONTINUED = re.compile(rb"\\[ \t\r]*\n")
_TEXTURE_AND_NORMAL = re.compile(rb"/\S*")
_SPACE = ord(" ")


def is_obj(data: bytes) -> bool:
    """Whether the content is text of no other known kind, with a vertex line near the beginning."""
    if not is_text(data) or known_foreign(data) is not None:
        return False
    return _VERTEX_LINE.search(unix_text(data[:_SNIFFED_BYTES])) is not None


def read_obj(data: bytes, limits: Limits) -> RawMesh:
    """The vertices and faces of an OBJ file; polygons become triangles, groups are one mesh.

    Raises
    ------
    DamagedMesh
        A coordinate is missing or not a number, or a face names vertex 0 or one that is not there.
    TooLarge
        More vertices or faces, or a longer face, than ``limits`` allow.
    """
    check_counts(data.count(b"\nv "), data.count(b"\nf "), limits)  # before the work
    text = _CONTINUED.sub(b" ", unix_text(data))
    rows = text_lines(_COMMENT.sub(b"", text))
    is_vertex, is_face = _starting_with(rows, b"v"), _starting_with(rows, b"f")
    check_counts(int(is_vertex.sum()), int(is_face.sum()), limits)
    vertices = _vertices(rows, is_vertex)
    sizes = rows.counts[is_face] - 1
    named = _TEXTURE_AND_NORMAL.sub(b"", _text_of(rows, is_face))
    indices = integers(named, int(sizes.sum()))
    known = np.repeat(np.cumsum(is_vertex, dtype=np.int64)[is_face], sizes)
    corners = _absolute(indices, known)
    return RawMesh(vertices, *polygon_triangles(vertices, corners, sizes, limits))


def _starting_with(rows: Lines, keyword: bytes) -> Bools:
    """Which lines begin with the one-letter word ``keyword``, (k,)."""
    at = rows.words[rows.first[:-1]]
    following = np.append(rows.buffer, _SPACE)[at + 1]
    return np.asarray((rows.buffer[at] == keyword[0]) & (following <= _SPACE))


def _text_of(rows: Lines, chosen: Bools) -> bytes:
    """The chosen lines without their first letter."""
    change = np.zeros(len(rows.buffer) + 1, dtype=np.int8)
    change[rows.lines[chosen, 0]] += 1
    change[np.minimum(rows.lines[chosen, 1] + 1, len(rows.buffer))] -= 1
    inside = np.cumsum(change[:-1], dtype=np.int8).astype(bool)
    inside[rows.words[rows.first[:-1][chosen]]] = False
    kept: NDArray[np.uint8] = rows.buffer[inside]
    return kept.tobytes()


def _vertices(rows: Lines, is_vertex: Bools) -> Floats:
    counts = rows.counts[is_vertex] - 1
    values = floats(_text_of(rows, is_vertex), int(counts.sum()))
    return coordinates(values, np.cumsum(counts) - counts, counts)


def _absolute(indices: Ints, known: Ints) -> Ints:
    """Indices that count from 0. An OBJ counts from 1, or backwards from the last vertex so far.

    ``known`` is the number of vertices before each index. A positive index may name a vertex that
    comes later (many exporters write faces first), so the caller checks those.
    """
    if (indices == 0).any():
        raise DamagedMesh("a face names vertex 0, but an OBJ counts from 1: export it again")
    absolute = np.where(indices > 0, indices - 1, known + indices)
    if absolute.min(initial=0) < 0:
        raise DamagedMesh("a face counts back beyond the first vertex: export the mesh again")
    return absolute
