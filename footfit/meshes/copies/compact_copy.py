"""The compact copy of a mesh that the catalogue keeps, so that no original file is needed.

The bytes begin with a header (magic, version, counts, step, origin). Then come the vertices as
multiples of the step, and the faces, compressed by zlib. Both are stored as differences to the row
before, and "shuffled": all lowest bytes first, which zlib compresses best.
"""

from __future__ import annotations

import math
import struct
import zlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfit.errors import CatalogueDamaged
from footfit.geometry.mesh.welding import (
    has_distinct_corners,
    welded_vertices,
    without_unused_vertices,
)
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.meshes.copies.deviation import largest_deviation_mm
from footfit.meshes.copies.lighter import lighter_mesh
from footfit.meshes.read_limits import LIMITS
from footfit.results import MeshCopy

COPY_FACES = 10_000
"""Of a compact copy, unless it needs more to be close enough."""
_HEADER = struct.Struct("<4sBxxxIId3d")
_MAGIC = b"ffmc"
_VERSION = 1
_COLUMN_BYTES = 4


@dataclass(frozen=True, slots=True)
class CopySettings:
    """How close a copy is, and how large one may be.

    Attributes
    ----------
    step_mm : float
        Coordinates are whole multiples of it: off by half of it at most.
    error_mm : float
        A copy that deviates further is made again with twice the faces.
    zlib_level : int
    """

    step_mm: float = 0.005
    error_mm: float = 0.25
    zlib_level: int = 9


COPY_SETTINGS = CopySettings()


def compact_copy(vertices_mm: Floats, faces: Ints, target_faces: int = COPY_FACES) -> MeshCopy:
    """A simplified, quantised and compressed copy, with its measured error.

    Parameters
    ----------
    vertices_mm : (n, 3) float64
    faces : (m, 3) int64
        At least one face.
    target_faces : int
        Where a copy of so many faces deviates by more than ``COPY_SETTINGS.error_mm``, the target
        is doubled, until nothing is simplified.

    Returns
    -------
    MeshCopy
        ``error_mm`` is the two-sided largest sampled distance between the given mesh and the copy
        as :func:`expanded_mesh` returns it.
    """
    vertices_mm, faces, _ = welded_vertices(vertices_mm, faces)
    while True:
        lighter, fewer = lighter_mesh(vertices_mm, faces, target_faces)
        data = _encoded(lighter, fewer)
        copy_vertices, copy_faces = expanded_mesh(data)
        error = largest_deviation_mm(vertices_mm, faces, copy_vertices, copy_faces)
        if error <= COPY_SETTINGS.error_mm or target_faces >= len(faces):
            return MeshCopy(data, len(copy_faces), error)
        target_faces *= 2


def limited_copy(copy: MeshCopy, most_faces: int) -> MeshCopy:
    """The copy with no more than ``most_faces``; itself where it has no more.

    Its ``error_mm`` is the copy's own and how far the lighter mesh lies from it.
    """
    if copy.faces <= most_faces:
        return copy
    vertices_mm, faces = expanded_mesh(copy.data)
    target, data = most_faces, copy.data
    lighter, fewer = vertices_mm, faces
    while len(fewer) > most_faces and target > most_faces // 2:  # it can end a little over it
        data = _encoded(*lighter_mesh(vertices_mm, faces, target))
        lighter, fewer = expanded_mesh(data)
        target -= 1 + len(fewer) - most_faces
    error_mm = copy.error_mm + largest_deviation_mm(vertices_mm, faces, lighter, fewer)
    return MeshCopy(data, len(fewer), error_mm)


def expanded_mesh(data: bytes) -> tuple[Floats, Ints]:
    """The mesh in a copy's bytes.

    Parameters
    ----------
    data : bytes
        From :func:`compact_copy`.

    Returns
    -------
    vertices_mm : (n, 3) float64
    faces : (m, 3) int64

    Raises
    ------
    CatalogueDamaged
        The bytes are not a copy: cut off, changed, or with counts over the limits.
    """
    try:
        magic, version, n, m, step, *origin = _HEADER.unpack_from(data)
    except struct.error as error:
        raise _damaged("it is cut off") from error
    if magic != _MAGIC or version != _VERSION:
        raise _damaged("its header is not one this version knows")
    if not (0 < n <= LIMITS.vertices and 0 < m <= LIMITS.faces):
        raise _damaged("its counts are impossible")
    if not (0.0 < step < 1.0 and all(math.isfinite(value) for value in origin)):
        raise _damaged("its scale is impossible")
    rows = _unpacked(data[_HEADER.size :], 3 * (n + m))
    steps, faces = rows[: 3 * n].reshape(-1, 3), rows[3 * n :].reshape(-1, 3)
    steps, faces = np.cumsum(steps, axis=0), np.cumsum(faces, axis=0)
    if faces.min() < 0 or faces.max() >= n:
        raise _damaged("a face names a vertex that is not there")
    return np.array(origin) + steps * step, faces


def _damaged(reason: str) -> CatalogueDamaged:
    return CatalogueDamaged(
        f"a stored mesh copy is damaged ({reason}): ingest the last again with --replace"
    )


def _encoded(vertices: Floats, faces: Ints) -> bytes:
    """The bytes: quantised, sorted so that neighbours follow each other, compressed."""
    origin = vertices.min(axis=0)
    steps = np.rint((vertices - origin) / COPY_SETTINGS.step_mm)
    steps, faces, _ = welded_vertices(steps, faces)
    faces = faces[has_distinct_corners(faces)]
    steps, faces, _ = without_unused_vertices(steps, faces)
    order = np.argsort(_interleaved(steps.astype(np.int64)), kind="stable")
    rank = np.empty(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    steps, faces = steps[order].astype(np.int64), _sorted_faces(rank[faces])
    header = _HEADER.pack(_MAGIC, _VERSION, len(steps), len(faces), COPY_SETTINGS.step_mm, *origin)
    rows = [np.diff(table, axis=0, prepend=0).ravel() for table in (steps, faces)]
    return header + _packed(np.concatenate(rows))


def _interleaved(steps: Ints) -> Ints:
    """Each row's bits interleaved (Morton order), so that rows near in space get near numbers."""
    codes = np.zeros(len(steps), dtype=np.int64)
    for bit in range(21):
        for axis in range(3):
            codes |= ((steps[:, axis] >> bit) & 1) << (3 * bit + axis)
    return codes


def _sorted_faces(faces: Ints) -> Ints:
    """The faces in rising order, each beginning at its lowest vertex; the winding stays."""
    lowest = np.argmin(faces, axis=1)
    turned = np.take_along_axis(faces, (lowest[:, None] + np.arange(3)) % 3, axis=1)
    return turned[np.lexsort(turned.T[::-1])]


def _packed(values: Ints) -> bytes:
    """Signed values as even and odd ones, so that small ones have zero high bytes; shuffled."""
    folded = ((values << 1) ^ (values >> 63)).astype("<u4")
    shuffled = folded.view(np.uint8).reshape(-1, _COLUMN_BYTES).T.tobytes()
    return zlib.compress(shuffled, COPY_SETTINGS.zlib_level)


def _unpacked(data: bytes, count: int) -> NDArray[np.int64]:
    inflater = zlib.decompressobj()
    try:
        shuffled = inflater.decompress(data, _COLUMN_BYTES * count)
        more = inflater.decompress(inflater.unconsumed_tail, 1)
    except zlib.error as error:
        raise _damaged("it does not decompress") from error
    if len(shuffled) != _COLUMN_BYTES * count or more or not inflater.eof or inflater.unused_data:
        raise _damaged("its length is not the one in its header")
    columns = np.frombuffer(shuffled, dtype=np.uint8).reshape(_COLUMN_BYTES, -1)
    folded = np.ascontiguousarray(columns.T).view("<u4").ravel().astype(np.int64)
    return (folded >> 1) ^ -(folded & 1)
