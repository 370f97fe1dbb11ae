"""Small holes in a surface, closed by smooth caps, so that a frame and a flare do not see them.

A scanner leaves holes where it did not look. A leg's cut, a missing sole or a missing half is no
hole: only loops that are small against the length are closed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.caps import Cap, Facets, cap, extent_of, farthest_of
from footfit.geometry.mesh.topology import boundary_edges, boundary_loops
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class HoleSettings:
    """Everything numeric of what a hole is; lengths over L.

    largest, smallest
        A loop's extent: what is larger is an opening, what is smaller changes nothing.
    most
        Loops that are closed, the largest first: a cracked scan has thousands.
    fewest_vertices
        Of a loop: one missing triangle is left.
    ring
        The distance between the rings of a cap.
    """

    largest: float = 0.26
    smallest: float = 0.012
    most: int = 64
    fewest_vertices: int = 4
    ring: float = 0.01


HOLES = HoleSettings()


@dataclass(frozen=True, slots=True)
class Filled:
    """A mesh whose small holes are closed: the given vertices and faces come first, unchanged.

    ``rims`` are all its boundary loops before, ``extents`` those of the closed ones, the largest
    first, in the vertices' unit.
    """

    vertices: Floats
    faces: Ints
    rims: tuple[Ints, ...]
    extents: tuple[float, ...]


def filled(vertices: Floats, faces: Ints, length: float, settings: HoleSettings = HOLES) -> Filled:
    """The mesh with each small hole closed by a cap that goes on as the surface comes in.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Wound outward.
    length : float
        Of the foot or last, about, in the unit of the vertices.

    Returns
    -------
    Filled
        With the same arrays where there is nothing to close.
    """
    rims = tuple(boundary_loops(faces))
    extents = np.array([extent_of(vertices[rim]) for rim in rims])
    small = (extents > settings.smallest * length) & (extents < settings.largest * length)
    small &= np.array([len(rim) >= settings.fewest_vertices for rim in rims], dtype=bool)
    order = [int(place) for place in np.argsort(-extents, kind="stable") if small[place]]
    if not order:
        return Filled(vertices, faces, rims, ())
    edges, facets, closed = boundary_edges(faces), Facets.of(vertices, faces), []
    points, triangles, count = [vertices], [faces], len(vertices)
    joined, shared = _joined(edges), _met_more_than_once(edges)
    for rim in (rims[place][::-1] for place in order[: settings.most]):
        rim = np.roll(rim, -farthest_of(vertices[rim]))
        is_hole = _closes(rim, *joined) and np.isin(rim, shared).sum() < 2
        found = cap(vertices[rim], facets, settings.ring * length) if is_hole else None
        if found is None:
            continue
        points.append(found.points)
        triangles.append(_numbered(found, rim, count))
        closed.append(extent_of(vertices[rim]))
        count += len(found.points)
    return Filled(np.concatenate(points), np.concatenate(triangles), rims, tuple(closed))


def _joined(edges: Ints) -> tuple[int, Ints]:
    """The boundary's edges as numbers, sorted, against the surface's way; and their base."""
    span = int(edges.max()) + 1
    return span, np.sort(edges[:, 1] * span + edges[:, 0])


def _closes(rim: Ints, span: int, known: Ints) -> bool:
    """Whether each vertex of a rim is joined to the next: where winding breaks, one may not be."""
    wanted = rim * span + np.roll(rim, -1)
    return bool(np.isin(wanted, known, assume_unique=True).all())


def _met_more_than_once(edges: Ints) -> Ints:
    """The vertices in which loops touch.

    Two loops that touch in one are told apart. In two, which arc belongs to which would hang on
    the order of the faces, and so neither is closed.
    """
    starts, count = np.unique(edges[:, 0], return_counts=True)
    return np.asarray(starts[count > 1])


def _numbered(found: Cap, rim: Ints, count: int) -> Ints:
    """A cap's triangles with the mesh's own indices; its inner vertices count from ``count``."""
    inner = np.arange(len(found.points)) + count
    return np.append(rim, inner)[found.triangles]
