"""Which vertices, edges and faces of a triangle mesh belong together.

Faces are (m, 3) int64 indices into ``n`` vertices. Nothing here looks at coordinates, and nothing
drops a face.
"""

from __future__ import annotations

from functools import reduce

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Ints, distinct


def half_edges(faces: Ints) -> Ints:
    """The directed edges of the faces, (3 m, 2) int64; row 3 f + c runs from corner c of face f."""
    return np.stack([faces, faces[:, [1, 2, 0]]], axis=2).reshape(-1, 2)


def edges(faces: Ints) -> Ints:
    """The undirected edges, each once, (k, 2) int64 with the lower index first, sorted.

    Examples
    --------
    >>> edges(np.array([[0, 1, 2], [2, 1, 3]])).tolist()
    [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]
    """
    order, starts, _ = edge_groups(faces)
    return np.sort(half_edges(faces)[order[starts]], axis=1)


def sorted_keys(keys: Ints) -> tuple[Ints, Ints]:
    """The stable order of non-negative keys (n,), and the keys in that order.

    Examples
    --------
    >>> [part.tolist() for part in sorted_keys(np.array([7, 5, 7, 0]))]
    [[3, 1, 0, 2], [0, 5, 7, 7]]
    """
    count = len(keys)
    if count == 0 or int(keys.max()) < np.iinfo(np.int64).max // count - 1:
        words = np.sort(keys * count + np.arange(count))  # key and index in one word: fast
        return words % max(count, 1), words // max(count, 1)
    order = np.argsort(keys, kind="stable").astype(np.int64)
    return order, keys[order]


def edge_groups(faces: Ints) -> tuple[Ints, Ints, Ints]:
    """Half-edges (3 m,) in the order of their edges, each edge's first place in it, and its count.

    A half-edge has the number of its row in :func:`half_edges`.
    """
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    span = int(faces.max(initial=0)) + 1
    order, ordered = sorted_keys(np.minimum(start, end) * span + np.maximum(start, end))
    starts = np.flatnonzero(np.diff(ordered, prepend=-1))
    return order, starts, np.diff(np.append(starts, len(ordered)))


def boundary_edges(faces: Ints) -> Ints:
    """Edges that lie in exactly one face, (k, 2) int64, directed as that face runs them.

    Examples
    --------
    >>> boundary_edges(np.array([[0, 1, 2], [2, 1, 3]])).tolist()
    [[0, 1], [2, 0], [1, 3], [3, 2]]
    """
    order, starts, counts = edge_groups(faces)
    single: Ints = half_edges(faces)[np.sort(order[starts[counts == 1]])]
    return single


def boundary_vertices(faces: Ints, n_vertices: int) -> Bools:
    """Whether each vertex lies on a boundary edge, (n_vertices,) bool."""
    on_boundary = np.zeros(n_vertices, dtype=bool)
    on_boundary[boundary_edges(faces)] = True
    return on_boundary


def boundary_loops(faces: Ints) -> list[Ints]:
    """The boundary as closed loops of vertices, the last joined to the first.

    Seen from outside, a loop of consistently wound faces has the surface on its left. Loops that
    touch in a vertex are split there, so that no loop meets a vertex twice. Where the winding is
    not consistent, some pieces do not close; they are returned as they are.

    Examples
    --------
    >>> [loop.tolist() for loop in boundary_loops(np.array([[0, 1, 2], [2, 1, 3]]))]
    [[0, 1, 3, 2]]
    """
    successors: dict[int, list[int]] = {}
    for start, end in boundary_edges(faces).tolist():
        successors.setdefault(start, []).append(end)
    loops: list[Ints] = []
    for start in sorted(successors):
        while successors[start]:
            loops.extend(_loops_from(start, successors))
    return loops


def _loops_from(start: int, successors: dict[int, list[int]]) -> list[Ints]:
    """Walk from ``start`` until no edge is left; each vertex met again closes a loop."""
    loops: list[Ints] = []
    path, place = [start], {start: 0}
    while successors.get(path[-1]):
        following = successors[path[-1]].pop()
        if following not in place:
            place[following] = len(path)
            path.append(following)
            continue
        cut = place[following]
        loops.append(np.array(path[cut:], dtype=np.int64))
        for vertex in path[cut + 1 :]:
            del place[vertex]
        del path[cut + 1 :]
    return [*loops, np.array(path, dtype=np.int64)] if len(path) > 1 else loops


def face_components(faces: Ints, n_vertices: int) -> Ints:
    """The connected component of each face, (m,) int64.

    Faces that share a vertex are connected. Components count from 0 in the order of their
    lowest vertex.

    Examples
    --------
    >>> face_components(np.array([[4, 5, 6], [0, 1, 2], [2, 1, 3]]), 7).tolist()
    [1, 0, 0]
    """
    if len(faces) == 0:
        return np.empty(0, dtype=np.int64)
    lowest = lowest_connected(faces, n_vertices)[faces[:, 0]]
    labels: Ints = np.unique(lowest, return_inverse=True)[1].astype(np.int64).reshape(-1)
    return labels


def lowest_connected(groups: Ints, n: int) -> Ints:
    """The lowest index that each of ``n`` is connected with, (n,).

    The members of each row of ``groups`` (k, d) are connected. In every round, each row gives its
    members' parents the lowest of them as parent, and each then takes its grandparent as parent.
    The number of rounds grows with the logarithm of ``n``.
    """
    parent = np.arange(n, dtype=np.int64)
    while True:
        members = parent[groups]
        lowest = reduce(np.minimum, members.T)  # NumPy is slow along an axis of three
        hooked = parent.copy()
        for column in range(groups.shape[1]):
            np.minimum.at(hooked, members[:, column], lowest)
        hooked = hooked[hooked]
        if np.array_equal(hooked, parent):
            return parent
        parent = hooked


def is_closed(faces: Ints) -> bool:
    """Whether every edge lies in exactly two faces (False for no faces)."""
    return len(faces) > 0 and bool(np.all(edge_groups(faces)[2] == 2))


def consistent_faces(faces: Ints) -> Ints:
    """The faces, with as few as possible turned over so that neighbours agree, (m, 3) int64.

    Neighbours are two faces that alone share an edge. Each piece follows its own majority. A piece
    with only one side (a Moebius band) stays as it is. Which side is outside is not decided here.

    Examples
    --------
    >>> consistent_faces(np.array([[0, 1, 2], [1, 2, 3], [2, 4, 3]])).tolist()
    [[1, 0, 2], [1, 2, 3], [2, 4, 3]]
    """
    pairs, disagree = _shared_edges(faces)
    if not disagree.any():
        return faces.copy()
    # Each face has two copies: as it is (2 f) and turned over (2 f + 1). Copies of neighbours that
    # agree are connected, so a piece with two sides falls into its two windings.
    twisted = disagree.astype(np.int64)
    links = np.concatenate(
        [
            np.stack([2 * pairs[:, 0], 2 * pairs[:, 1] + twisted], axis=1),
            np.stack([2 * pairs[:, 0] + 1, 2 * pairs[:, 1] + 1 - twisted], axis=1),
        ]
    )
    winding = lowest_connected(links, 2 * len(faces)).reshape(-1, 2)
    turned = winding[:, 1] < winding[:, 0]
    piece = winding.min(axis=1)
    members = np.bincount(piece, minlength=2 * len(faces))
    turns = np.bincount(piece, weights=turned, minlength=2 * len(faces))
    turned ^= (2 * turns > members)[piece] & (winding[:, 0] != winding[:, 1])
    wound = faces.copy()
    wound[turned] = faces[turned][:, [1, 0, 2]]
    return wound


def _shared_edges(faces: Ints) -> tuple[Ints, Bools]:
    """Pairs of faces (k, 2) that alone share an edge, and whether both run it the same way."""
    order, starts, counts = edge_groups(faces)
    first = starts[counts == 2]
    pairs = np.stack([order[first], order[first + 1]], axis=1)
    begins = half_edges(faces)[:, 0][pairs]
    return pairs // 3, begins[:, 0] == begins[:, 1]


def closed_fan_vertices(faces: Ints, n_vertices: int) -> Bools:
    """Whether the faces around each vertex are one closed, consistently wound fan, (n_vertices,).

    False on a boundary, at an edge of three faces or of two that run it the same way, where two
    fans touch in a vertex, and for a vertex without faces.
    """
    order, starts, counts = edge_groups(faces)
    ends = half_edges(faces)
    here, beyond = order[starts], order[np.minimum(starts + 1, len(order) - 1)]
    regular = (counts == 2) & (ends[here, 0] == ends[beyond, 1])
    closed = np.bincount(faces.ravel(), minlength=n_vertices) > 0
    closed[ends[here[~regular]]] = False
    # A half-edge has the number of the corner where it starts; a fan is corners joined over edges.
    here, beyond = here[regular], beyond[regular]
    across = np.append(beyond, here)
    following = across - across % 3 + (across + 1) % 3
    joined = np.stack([np.append(here, beyond), following], axis=1)
    roots = distinct(lowest_connected(joined, faces.size))
    fans = np.bincount(faces.ravel()[roots], minlength=n_vertices)
    single: Bools = closed & (fans == 1)
    return single


def rows_differ(faces: Ints, others: Ints) -> Bools:
    """Which rows differ, (m,); by columns, as NumPy is slow along an axis of three."""
    a, b, c = (faces != others).T
    return np.asarray(a | b | c)
