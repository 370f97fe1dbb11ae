"""The shadow of a surface on a plane, as one closed outline.

The shadow is the union of all projected faces. Along any straight line through it, the union is a
few intervals, which are exact. A grid of such lines is cut into cells, and the outline is joined
from cell to cell (marching squares) through the exact ends of the intervals.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.sections import sections_across
from footfit.geometry.numeric.arrays import Bools, Floats, Ints

GRID_MM = 0.2
"""The pitch of the lines. A curve with a radius of 1 mm is cut short by .005 mm."""
BEFORE = 1.382
"""How far before the shadow the grid begins: no line of it lies along a straight edge."""
CORNER_DEG = 15.0
"""Where the outline turns by more from one cell to the next but one, it has a corner between."""


@dataclass(frozen=True, slots=True)
class _Lines:
    """The shadow along parallel lines: intervals, each shifted by its line times ``apart``.

    So all intervals ascend, and one search finds the interval of a place on any line.
    """

    starts: Floats
    ends: Floats
    apart: float

    def interval(self, line: Ints, place: Floats) -> tuple[Floats, Floats]:
        """The last interval that begins before each place on its line; (start, end)."""
        shift = line * self.apart
        row = np.maximum(np.searchsorted(self.starts, place + shift, side="right") - 1, 0)
        return self.starts[row] - shift, self.ends[row] - shift


def shadow_outline(points: Floats, faces: Ints, grid_mm: float = GRID_MM) -> Floats:
    """The outer outline (k, 2) of the largest piece of a shadow, counter-clockwise.

    See :func:`shadow_outlines`.

    Examples
    --------
    >>> corners = np.array([[0.0, 0], [4, 0], [4, 3], [0, 3]])
    >>> outline = shadow_outline(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    >>> outline.min(axis=0).round(6).tolist(), outline.max(axis=0).round(6).tolist()
    ([0.0, 0.0], [4.0, 3.0])
    """
    return shadow_outlines(points, faces, grid_mm)[0]


def shadow_outlines(
    points: Floats, faces: Ints, grid_mm: float = GRID_MM, least: float = 1.0
) -> tuple[Floats, ...]:
    """The outer outlines (k, 2) of the pieces of a shadow, the largest first, counter-clockwise.

    Parameters
    ----------
    points : (n, 2)
        The vertices in the plane of the shadow, mm.
    faces : (m, 3)
    grid_mm : float
    least : float
        Pieces whose area is a smaller share of the largest one's are left out.
    """
    used = points[faces].reshape(-1, 2)
    low, high = used.min(axis=0) - BEFORE * grid_mm, used.max(axis=0) + 1.5 * grid_mm
    size = np.ceil((high - low) / grid_mm).astype(np.int64) + 1
    u, v = (low[axis] + grid_mm * np.arange(size[axis]) for axis in (0, 1))
    columns, rows = _lines(points, faces, u), _lines(points[:, ::-1], faces, v)
    i, j = np.meshgrid(np.arange(len(u)), np.arange(len(v)), indexing="ij")
    start, end = columns.interval(i.ravel(), v[j.ravel()])
    inside = ((start <= v[j.ravel()]) & (v[j.ravel()] <= end)).reshape(i.shape)
    loops = [_placed(loop, inside, (u, v), (columns, rows)) for loop in _edge_loops(inside)]
    loops.sort(key=_area, reverse=True)
    kept = [loop for loop in loops if _area(loop) >= least * _area(loops[0])]
    return tuple(_with_corners(loop, 1.5 * grid_mm) for loop in kept)


def _with_corners(loop: Floats, most_mm: float) -> Floats:
    """A closed polyline (n, 2) with the corners that its cells cut off.

    A corner is where the straight ways before and after a cell meet, if that is near to the cell.
    """
    end, after = np.roll(loop, -1, axis=0), np.roll(loop, -2, axis=0)
    arrives, leaves, chord = loop - np.roll(loop, 1, axis=0), after - end, end - loop
    turn = _cross(arrives, leaves)
    lengths = np.linalg.norm(arrives, axis=1) * np.linalg.norm(leaves, axis=1)
    sharp = np.abs(turn) > np.sin(np.radians(CORNER_DEG)) * lengths
    turn = np.where(sharp, turn, 1.0)
    ahead, back = _cross(chord, leaves) / turn, _cross(arrives, chord) / turn
    corner = loop + ahead[:, None] * arrives
    near = np.maximum(np.linalg.norm(corner - loop, axis=1), np.linalg.norm(corner - end, axis=1))
    kept = sharp & (ahead > 0.0) & (back > 0.0) & (near < most_mm)
    return np.insert(loop, np.flatnonzero(kept) + 1, corner[kept], axis=0)


def _cross(first: Floats, second: Floats) -> Floats:
    return np.asarray(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def _lines(points: Floats, faces: Ints, at: Floats) -> _Lines:
    """The shadow along the lines on which the first coordinate is ``at`` (k,)."""
    flat = np.column_stack([points, np.zeros(len(points))])
    cut = sections_across(flat, faces, at)
    place = cut.points[:, :, 1]
    apart = 4.0 * float(np.ptp(points[:, 1])) + 1.0
    start, end = place.min(axis=1) + cut.plane * apart, place.max(axis=1) + cut.plane * apart
    order = np.argsort(start, kind="stable")
    start, reached = start[order], np.maximum.accumulate(end[order])
    first = np.concatenate([[True], start[1:] > reached[:-1] + 1e-9])
    last = np.concatenate([first[1:], [True]])
    return _Lines(start[first], reached[last], apart)


def _edge_loops(inside: Bools) -> list[Ints]:
    """The grid's edges that the outline crosses, as closed walks with the inside on the left.

    An edge is (i, j, axis): it goes from the node (i, j) by one along the axis.
    """
    corners = (inside[:-1, :-1], inside[1:, :-1], inside[1:, 1:], inside[:-1, 1:])
    leaves = np.array([corners[k] & ~corners[(k + 1) % 4] for k in range(4)])
    enters = np.array([~corners[k] & corners[(k + 1) % 4] for k in range(4)])
    edges = np.array([[0, 0, 0], [1, 0, 1], [0, 1, 0], [0, 0, 1]])  # of a cell: below, right ...
    onward: dict[tuple[int, ...], tuple[int, ...]] = {}
    for k in range(4):
        cells = np.argwhere(leaves[k])
        choices = np.array([enters[(k + step) % 4][leaves[k]] for step in (1, 2, 3)])
        to = (k + 1 + np.argmax(choices, axis=0)) % 4
        place = np.pad(cells, ((0, 0), (0, 1)))
        here, there = (place + edges[k]).tolist(), (place + edges[to]).tolist()
        onward.update(zip(map(tuple, here), map(tuple, there), strict=True))
    loops = []
    while onward:
        first, edge = onward.popitem()
        walk = [first]
        while edge != first:
            walk.append(edge)
            edge = onward.pop(edge)
        loops.append(np.array(walk))
    return loops


def _placed(
    loop: Ints, inside: Bools, grid: tuple[Floats, Floats], lines: tuple[_Lines, _Lines]
) -> Floats:
    """Where the outline crosses the edges (k, 3) of a walk, (k, 2)."""
    i, j, axis = loop.T
    result = np.column_stack([grid[0][i], grid[1][j]])
    columns, rows = lines
    for along, across, known in ((0, j, rows), (1, i, columns)):
        of = axis == along
        near = grid[along][(i if along == 0 else j)[of]]
        far = grid[along][(i if along == 0 else j)[of] + 1]
        starts_inside = inside[i[of], j[of]]
        start, end = known.interval(across[of], np.where(starts_inside, near, far))
        result[of, along] = np.clip(np.where(starts_inside, end, start), near, far)
    return result


def _area(loop: Floats) -> float:
    """The area inside a closed polyline (n, 2), + counter-clockwise."""
    x, y = loop.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
