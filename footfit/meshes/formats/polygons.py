"""Polygons cut into triangles, as their outline runs, whichever corner comes first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from footfit.errors import DamagedMesh, TooLarge
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct, row_dots
from footfit.meshes.formats.raw import doubles
from footfit.meshes.read_limits import Limits
from footfit.results.values import Notice

_EXACT = 2.0**53  # up to this size a double holds every integer
Triples = list[tuple[int, int, int]]


@dataclass(frozen=True, slots=True)
class PolygonSettings:
    """When a polygon bends inward, and which ones may have no outline.

    Attributes
    ----------
    flat : float
        A corner counts as straight if its triangle has less than this share of the polygon's area.
    small : float
        A polygon whose outline crosses itself is cut into a fan if it is smaller than this, over
        the diagonal of the mesh. No cut of it moves the surface farther than that: 5 mm of a foot.
    """

    flat: float = 1e-9
    small: float = 0.02


POLYGONS = PolygonSettings()


def polygon_triangles(
    vertices: Floats, corners: Ints, counts: Ints, limits: Limits
) -> tuple[Ints, tuple[Notice, ...]]:
    """The triangles of polygons, in the polygons' order, and what to say of them.

    A quadrangle is cut along its shorter diagonal, if both lie inside. A longer polygon becomes a
    fan if it is convex, and is cut ear by ear if it is not. Both are seen along the polygon's area
    vector, so a polygon may be slightly bent. No choice depends on which corner comes first.

    Parameters
    ----------
    vertices : (n, 3) float64
    corners : (sum of counts,) int64
        The polygons' vertices, one polygon after the other.
    counts : (p,) int64
        How many corners each polygon has; with fewer than three it gives no triangle.
    limits : Limits

    Returns
    -------
    triangles : (m, 3) int64
    notices : tuple of Notice
        ``polygons_crossed``: the outline of some small polygons crosses itself.

    Raises
    ------
    TooLarge
        A polygon has more corners than ``limits.polygon_corners``.
    DamagedMesh
        The outline of a large polygon crosses itself.

    Examples
    --------
    The fourth corner of an arrowhead lies inside the triangle of the others:

    >>> from footfit.meshes.read_limits import LIMITS
    >>> arrowhead = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 0]])
    >>> polygon_triangles(arrowhead, np.arange(4), np.array([4]), LIMITS)[0].tolist()
    [[1, 2, 3], [1, 3, 0]]
    """
    if len(counts) and counts.max() > limits.polygon_corners:
        raise TooLarge(
            f"a face has {int(counts.max()):,} corners and footfit reads up to"
            f" {limits.polygon_corners:,}: export triangles"
        )
    if len(counts) and (counts == 3).all():
        return corners.reshape(-1, 3), ()
    begins, sizes = np.cumsum(counts) - counts, np.maximum(counts - 2, 0)
    places = np.cumsum(sizes) - sizes
    triangles = np.empty((int(sizes.sum()), 3), dtype=np.int64)
    measurable = _is_measurable(vertices, corners)
    crossed = 0
    for count in distinct(counts[counts > 2]).tolist():
        chosen = np.flatnonzero(counts == count)
        polygons = corners[begins[chosen, None] + np.arange(count)]
        if count == 3 or not measurable:  # a bad number or index is refused after this
            cut, bad = _fans(polygons), np.empty(0, dtype=np.int64)
        elif count == 4:
            cut, bad = _quadrangles(vertices, polygons)
        else:
            cut, bad = _polygons(vertices, polygons)
        triangles[places[chosen, None] + np.arange(count - 2)] = cut
        _refuse_large(vertices, polygons[bad])
        crossed += len(bad)
    words = "small polygons cross themselves: they were cut into fans"
    return triangles, (Notice("polygons_crossed", f"{crossed:,} {words}"),) if crossed else ()


def _is_measurable(vertices: Floats, corners: Ints) -> bool:
    """Whether every corner is a vertex, and every vertex a finite place."""
    inside = corners.min(initial=0) >= 0 and corners.max(initial=0) < len(vertices)
    return bool(inside and np.isfinite([vertices.min(initial=0), vertices.max(initial=0)]).all())


def _refuse_large(vertices: Floats, polygons: Ints) -> None:
    """Refuse polygons (p, k) without a sound outline if one is large in its mesh."""
    if not len(polygons):
        return
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    reach = np.linalg.norm(np.ptp(vertices[polygons], axis=1), axis=1)
    if reach.max() > POLYGONS.small * diagonal:
        raise DamagedMesh(
            f"the outline of a face with {polygons.shape[1]} corners crosses itself: export the"
            " mesh as triangles"
        )


def _fans(polygons: Ints) -> Ints:
    """Polygons (p, k) as fans around their first corners, (p, k - 2, 3)."""
    after = np.stack([polygons[:, 1:-1], polygons[:, 2:]], axis=2)
    first = np.broadcast_to(polygons[:, :1, None], (*after.shape[:2], 1))
    return np.concatenate([first, after], axis=2)


def _quadrangles(vertices: Floats, polygons: Ints) -> tuple[Ints, Ints]:
    """Quadrangles (p, 4) as two triangles each, (p, 2, 3), and the rows that cross themselves."""
    a, b, c, d = (vertices[polygons[:, k]] for k in range(4))
    over, under = cross(b - a, c - a), cross(c - a, d - a)  # cut from a to c
    left, right = cross(c - b, d - b), cross(d - b, a - b)  # cut from b to d
    whole_area = over + under
    least = -POLYGONS.flat * row_dots(whole_area, whole_area)
    first, second = (
        np.minimum(row_dots(one, whole_area), row_dots(other, whole_area)) >= least
        for one, other in ((over, under), (left, right))
    )
    straight, other = row_dots(c - a, c - a), row_dots(d - b, d - b)
    lowest = np.minimum(polygons[:, 0], polygons[:, 2]) < np.minimum(polygons[:, 1], polygons[:, 3])
    shorter = (straight < other) | ((straight == other) & lowest)
    turned = np.where(first & second, ~shorter, second)
    cut = np.where(turned[:, None], np.roll(polygons, -1, axis=1), polygons)
    total = np.sqrt(row_dots(over, over)) + np.sqrt(row_dots(under, under))
    has_area = total > POLYGONS.flat * (straight + other)
    flipped = row_dots(whole_area, whole_area) <= POLYGONS.flat * np.square(total)
    return _fans(cut), np.flatnonzero(has_area & (flipped | ~(first | second)))


def _polygons(vertices: Floats, polygons: Ints) -> tuple[Ints, Ints]:
    """Polygons (p, k) as triangles, (p, k - 2, 3), and the rows that cross themselves."""
    turn = np.argmin(polygons, axis=1)[:, None] + np.arange(polygons.shape[1])
    polygons = np.take_along_axis(polygons, turn % polygons.shape[1], axis=1)
    cut, bad = _fans(polygons), []
    for row in np.flatnonzero(~_are_convex(vertices, polygons)).tolist():
        points = vertices[polygons[row]]
        ears = _ears(points, polygons[row].tolist())
        if ears is None:
            bad.append(row)
        else:
            cut[row] = polygons[row][np.array(ears)]
    return cut, np.array(bad, dtype=np.int64)


def _are_convex(vertices: Floats, polygons: Ints) -> Bools:
    """Which polygons (p, k) turn one way at every corner, and once around."""
    points = vertices[polygons]
    points = points - points[:, :1]
    edges = np.roll(points, -1, axis=1) - points
    fan = np.cross(points[:, 1:-1], points[:, 2:])
    area = fan.sum(axis=1)
    corner = np.cross(edges, np.roll(edges, -1, axis=1))
    least = -POLYGONS.flat * np.einsum("pk,pk->p", area, area)[:, None]
    turns, covers = (
        (np.einsum("pkc,pc->pk", parts, area) >= least).all(axis=1) for parts in (corner, fan)
    )
    return np.asarray(turns & covers & (area != 0.0).any(axis=1))


# ---------------------------------------------------------------- ears


def _ears(points: Floats, ids: list[int]) -> Triples | None:
    """A polygon's triangles, cut off ear by ear, the one with the shortest cut first.

    Parameters
    ----------
    points : (k, 3)
        The corners. They are seen along the polygon's area vector.
    ids : list of int
        The corners' vertices, which decide between equal cuts.

    Returns
    -------
    list of triples, or None
        Rows of ``points``; None if no ear is left because the outline crosses itself.
    """
    away = points - points.mean(axis=0)
    vector = np.cross(away, np.roll(away, -1, axis=0)).sum(axis=0)
    size = float(np.linalg.norm(vector))
    if size <= POLYGONS.flat * float(np.square(away).sum()):
        flat = np.linalg.matrix_rank(away, tol=POLYGONS.flat * float(np.abs(away).max())) < 2
        return [(0, k, k + 1) for k in range(1, len(points) - 1)] if flat else None
    ring = _Ring((away @ _across(vector / size).T).tolist(), POLYGONS.flat * size)
    cuts = {k: cut for k in range(len(ids)) if (cut := _cut(ring, k, away, ids)) is not None}
    triangles: Triples = []
    while len(triangles) < len(ids) - 3:
        if not cuts:
            return None
        ear = min(cuts, key=cuts.__getitem__)
        del cuts[ear]
        before, after = ring.before[ear], ring.after[ear]
        triangles.append((before, ear, after))
        ring.remove(ear)
        for corner in (before, after):
            cut = _cut(ring, corner, away, ids)
            if cut is None:
                cuts.pop(corner, None)
            else:
                cuts[corner] = cut
        if not cuts and ring.size > 3:  # what was blocked by a corner that is gone
            cuts = {k: cut for k in ring.corners() if (cut := _cut(ring, k, away, ids)) is not None}
    a, b, c = ring.corners()
    return [*triangles, (a, b, c)] if ring.doubled_area(a, b, c) >= -ring.least else None


def _cut(
    ring: _Ring, corner: int, points: Floats, ids: list[int]
) -> tuple[bool, float, int] | None:
    """What an ear is chosen by: straight corners last, then the shortest cut; None for no ear.

    An edge that goes out and comes back the same way is cut off at once: its cut has no length.
    """
    ends = points[ring.before[corner]] - points[ring.after[corner]]
    square = float(ends @ ends)
    kind = ring.ear(corner)
    return None if kind is None else (kind == "straight" and square > 0.0, square, ids[corner])


class _Ring:
    """The corners of a polygon in a plane that are still there, each with its two neighbours.

    ``least`` is the least area of a triangle that is not flat, doubled.
    """

    def __init__(self, points: list[list[float]], least: float) -> None:
        count = len(points)
        self.points, self.least = points, least
        self.before = {k: (k - 1) % count for k in range(count)}
        self.after = {k: (k + 1) % count for k in range(count)}
        # Only a corner that bends inward can lie in an ear. None comes to bend inward later.
        self.inward = {k for k in range(count) if self._bend(k) <= least}

    @property
    def size(self) -> int:
        """How many corners are left."""
        return len(self.after)

    def corners(self) -> list[int]:
        """The corners that are left, around the polygon."""
        ring = [min(self.after)]
        while self.after[ring[-1]] != ring[0]:
            ring.append(self.after[ring[-1]])
        return ring

    def remove(self, corner: int) -> None:
        """Join the two neighbours of a corner."""
        before, after = self.before.pop(corner), self.after.pop(corner)
        self.after[before], self.before[after] = after, before
        self.inward.discard(corner)

    def ear(self, corner: int) -> Literal["ear", "straight"] | None:
        """Whether a corner is an ear, or lies between its neighbours; None if it is neither."""
        a, b, c = self.before[corner], corner, self.after[corner]
        if abs(self._bend(corner)) <= self.least:
            return "straight"
        if self._bend(corner) < 0.0:
            return None
        ends = [self.points[k] for k in (a, b, c)]
        (x0, x1), (y0, y1) = ((min(line), max(line)) for line in zip(*ends, strict=True))
        for k in self.inward:
            x, y = self.points[k]
            if not (x0 <= x <= x1 and y0 <= y <= y1) or self.points[k] in ends:
                continue
            if all(self.doubled_area(*side, k) >= 0.0 for side in ((a, b), (b, c), (c, a))):
                return None
        return "ear"

    def doubled_area(self, a: int, b: int, c: int) -> float:
        """Twice the signed area of three corners' triangle."""
        (x0, y0), (x1, y1), (x2, y2) = self.points[a], self.points[b], self.points[c]
        return (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0)

    def _bend(self, corner: int) -> float:
        return self.doubled_area(self.before[corner], corner, self.after[corner])


def _across(normal: Floats) -> Floats:
    """Two unit vectors (2, 3) across a unit vector, counter-clockwise about it."""
    least = np.eye(3)[int(np.argmin(np.abs(normal)))]
    first = np.cross(normal, least)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(normal, first)])


def whole(values: NDArray[np.generic]) -> Ints:
    """Indices as integers.

    Raises
    ------
    DamagedMesh
        An index is not a whole number.
    """
    if values.dtype.kind in "iu":
        return values.astype(
            np.int64
        )  # an index that wraps around is negative, and refused for that
    numbers = doubles(values)
    exact = np.abs(numbers) < _EXACT  # False for NaN
    if not exact.all() or (numbers != np.floor(numbers)).any():
        raise DamagedMesh("a face index is not a whole number: export the mesh again")
    return numbers.astype(np.int64)
