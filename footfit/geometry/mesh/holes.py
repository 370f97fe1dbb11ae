"""Small holes in a surface, closed by smooth caps, so that they move neither frame nor flare.

A scanner leaves holes where it did not look. A leg's cut, a missing sole or a missing half is not a
hole: only loops that are small against the length are closed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.caps import Facets, cap, extent_of, farthest_of
from footfit.geometry.mesh.topology import boundary_edges, boundary_loops
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class HoleSettings:
    """Everything numeric of what a hole is; lengths over L.

    largest, smallest
        A loop's extent: a larger loop is an opening, a smaller one changes nothing.
    most
        How many loops are closed, the largest first: a cracked scan has thousands.
    fewest_vertices
        Of a loop: one missing triangle stays open.
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
class ClosedMesh:
    """A mesh with its small holes closed: the given vertices and faces come first, unchanged.

    ``rims`` are all its boundary loops before, ``extents`` those of the closed ones, the largest
    first, in the vertices' unit.
    """

    vertices: Floats
    faces: Ints
    rims: tuple[Ints, ...]
    extents: tuple[float, ...]


def closed_mesh(vertices: Floats, faces: Ints, length: float) -> ClosedMesh:
    """The mesh with each small hole closed by a cap that continues the surface around it.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Wound outward.
    length : float
        Of the foot or last, about, in the unit of the vertices.

    Returns
    -------
    ClosedMesh
        With the same arrays if there is nothing to close.
    """
    rims = tuple(boundary_loops(faces))
    extents = np.array([extent_of(vertices[rim]) for rim in rims])
    small = (extents > HOLES.smallest * length) & (extents < HOLES.largest * length)
    small &= np.array([len(rim) >= HOLES.fewest_vertices for rim in rims], dtype=bool)
    order = [int(place) for place in np.argsort(-extents, kind="stable") if small[place]]
    if not order:
        return ClosedMesh(vertices, faces, rims, ())
    boundary, facets, closed = _Boundary.of(faces), Facets.of(vertices, faces), []
    points, triangles, count = [vertices], [faces], len(vertices)
    for rim in (rims[place][::-1] for place in order[: HOLES.most]):
        rim = np.roll(rim, -farthest_of(vertices[rim]))
        is_hole = boundary.is_hole(rim)
        patch = cap(vertices[rim], facets, HOLES.ring * length) if is_hole else None
        if patch is None:
            continue
        inner, corners = patch
        points.append(inner)
        triangles.append(np.append(rim, np.arange(len(inner)) + count)[corners])
        closed.append(extent_of(vertices[rim]))
        count += len(inner)
    return ClosedMesh(np.concatenate(points), np.concatenate(triangles), rims, tuple(closed))


@dataclass(frozen=True, slots=True)
class _Boundary:
    """A mesh's boundary edges as sorted numbers, and the vertices in which its loops touch."""

    span: int
    edges: Ints
    shared: Ints

    @classmethod
    def of(cls, faces: Ints) -> _Boundary:
        """The boundary of a mesh that has one."""
        edges = boundary_edges(faces)
        span = int(edges.max()) + 1
        starts, count = np.unique(edges[:, 0], return_counts=True)
        return cls(span, np.sort(edges[:, 1] * span + edges[:, 0]), starts[count > 1])

    def is_hole(self, rim: Ints) -> bool:
        """Whether a rim, run against the surface's way, is joined all around and stands alone.

        Two neighbours on it may not be joined if the winding breaks there. Two loops that touch in
        one vertex are told apart. If they touch in two, the order of the faces would decide which
        arc belongs to which, so neither is closed.
        """
        keys = rim * self.span + np.roll(rim, -1)
        joined = np.isin(keys, self.edges, assume_unique=True).all()
        return bool(joined and np.isin(rim, self.shared).sum() < 2)
