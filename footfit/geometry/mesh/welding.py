"""Which vertices of a mesh are equal or nearly equal, and which are used.

``vertices`` is (n, 3) float64 in any unit, ``faces`` (m, 3) int64.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.topology import lowest_connected
from footfit.geometry.numeric.arrays import Bools, Floats, Ints

# Odd constants of the splitmix64 generator: they spread the bits of a coordinate over the key.
_MIX = np.array([0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB], dtype=np.uint64)
_NO_FACES = np.empty((0, 3), dtype=np.int64)
_GRIDS = 4  # one more than there are axes


@dataclass(frozen=True, slots=True)
class RoundingSettings:
    """How far apart rounding may put two points that were the same.

    Attributes
    ----------
    extent : float
        As a share of the diagonal of all points.
    coordinate : float
        As a share of the largest coordinate, of which float32 keeps 24 bits.
    """

    extent: float = 1e-5
    coordinate: float = 5e-7


ROUNDING = RoundingSettings()


def welded_vertices(vertices: Floats, faces: Ints) -> tuple[Floats, Ints, Ints]:
    """Merge vertices with exactly equal coordinates (-0.0 equals 0.0).

    Parameters
    ----------
    vertices : (n, 3) float64
        Finite coordinates, any unit.
    faces : (m, 3) int64

    Returns
    -------
    vertices : (k, 3) float64
        In the order of their first occurrence; those that no face uses are kept.
    faces : (m, 3) int64
        The same faces in the same order; collapsed faces are kept.
    source_to_vertex : (n,) int64
        The merged vertex of each given vertex.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, -0.0], [1, 1, 0], [0, 1, 0]])
    >>> _, faces, source = welded_vertices(corners, np.array([[0, 1, 2], [3, 4, 5]]))
    >>> source.tolist(), faces.tolist()
    ([0, 1, 2, 1, 3, 2], [[0, 1, 2], [1, 3, 2]])
    """
    if len(vertices) == 0:
        return vertices.copy(), faces.copy(), np.empty(0, dtype=np.int64)
    points = np.ascontiguousarray(vertices, dtype=np.float64) + 0.0  # + 0.0 makes -0.0 a 0.0
    order, starts = _runs_of_equals(points)
    group = np.cumsum(starts) - 1
    first = np.minimum.reduceat(order, np.flatnonzero(starts))
    rank = np.empty(len(first), dtype=np.int64)
    by_first = np.argsort(first)
    rank[by_first] = np.arange(len(first))
    source_to_vertex = np.empty(len(points), dtype=np.int64)
    source_to_vertex[order] = rank[group]
    return points[first[by_first]], source_to_vertex[faces], source_to_vertex


def _runs_of_equals(points: Floats) -> tuple[Ints, Bools]:
    """An order with equal points side by side, and where in it a new point starts.

    Each point gets a word that holds a hash and its index. To sort those words is several times as
    fast as a lexical sort of three columns. Where two different points share a hash, the lexical
    sort is done instead.
    """
    bits = points.view(np.uint64)
    hashed = np.zeros(len(points), dtype=np.uint64)
    for column in range(3):
        hashed = (hashed ^ bits[:, column]) * _MIX[column]
        hashed ^= hashed >> np.uint64(29)
    index_bits = np.uint64(max(1, int(len(points) - 1).bit_length()))
    word = (hashed << index_bits) | np.arange(len(points), dtype=np.uint64)
    word.sort()
    order = (word & ((np.uint64(1) << index_bits) - np.uint64(1))).astype(np.int64)
    starts = _starts(points[order])
    hashes = word >> index_bits
    if np.count_nonzero(starts) != 1 + np.count_nonzero(hashes[1:] != hashes[:-1]):
        order = np.lexsort(points.T).astype(np.int64)
        starts = _starts(points[order])
    return order, starts


def _starts(ordered: Floats) -> Bools:
    starts = np.ones(len(ordered), dtype=bool)
    starts[1:] = np.any(ordered[1:] != ordered[:-1], axis=1)
    return starts


def rounding_distance(points: Floats) -> float:
    """How far apart rounding may put two points (k, 3) that were the same."""
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    return max(ROUNDING.extent * diagonal, ROUNDING.coordinate * float(np.abs(points).max()))


def nearby_vertices(points: Floats, cell: float) -> Ints:
    """For each point (k, 3) the lowest index of its cluster, (k,).

    Points in the same cell of a grid are in one cluster. There are four grids, shifted against each
    other by a quarter of a cell. Each axis can separate points closer than that in one grid only,
    so all points closer than a quarter of a cell along every axis are in one cluster.

    Examples
    --------
    >>> nearby_vertices(np.array([[0.0, 0, 0], [5, 5, 5], [0.9, -0.9, 0.9]]), 4.0).tolist()
    [0, 1, 0]
    """
    links = []
    for shift in np.arange(_GRIDS) / _GRIDS:
        place = welded_vertices(np.floor(points / cell + shift), _NO_FACES)[2]
        first = np.unique(place, return_index=True)[1]
        links.append(np.stack([first[place], np.arange(len(points))], axis=1))
    return lowest_connected(np.concatenate(links), len(points))


def without_unused_vertices(vertices: Floats, faces: Ints) -> tuple[Floats, Ints, Ints]:
    """The mesh without the vertices that no face uses.

    Returns
    -------
    vertices : (k, 3)
        In the same order.
    faces : (m, 3)
    new_number : (n,)
        Each given vertex's row in ``vertices``; -1 where it was dropped.

    Examples
    --------
    >>> corners = np.arange(12.0).reshape(4, 3)
    >>> _, faces, new_number = without_unused_vertices(corners, np.array([[1, 2, 3]]))
    >>> faces.tolist(), new_number.tolist()
    ([[0, 1, 2]], [-1, 0, 1, 2])
    """
    used = np.zeros(len(vertices), dtype=bool)
    used[faces] = True
    new_number = np.where(used, np.cumsum(used) - 1, -1)
    return vertices[used], new_number[faces], new_number


def has_distinct_corners(faces: Ints) -> Bools:
    """False for every face that names a vertex twice, (m,)."""
    a, b, c = faces.T
    return np.asarray((a != b) & (b != c) & (c != a))
