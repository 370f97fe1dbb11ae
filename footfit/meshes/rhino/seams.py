"""Surfaces whose edges nearly meet become one: the render meshes of a model's patches.

A modeller meshes each patch by itself. Along a seam the two edges lie apart by the tolerance of the
model, and their vertices are in different places.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from footfit.geometry.mesh.topology import edge_groups, half_edges, lowest_connected
from footfit.geometry.mesh.welding import has_distinct_corners, welded_vertices
from footfit.geometry.numeric.arrays import Floats, Ints

ROUNDS = 3
"""Edges are split so often: a face can have two edges at seams, and a new edge another vertex."""
RIM_POINTS = 16
"""Points of an open edge to which the width of a gap is taken."""


@dataclass(frozen=True, slots=True)
class Patches:
    """Vertices (n, 3), faces (m, 3), and the ``patch`` (m,) that each face belongs to.

    ``widest`` is how far apart two things were at most that now meet.
    """

    vertices: Floats
    faces: Ints
    patch: Ints
    widest: float = 0.0

    def with_faces(self, faces: Ints, patch: Ints, distances: Floats) -> Patches:
        """The same patches with other faces, of which those without an area are left out."""
        sound = has_distinct_corners(faces)
        widest = max(self.widest, float(distances.max(initial=0.0)))
        return replace(self, faces=faces[sound], patch=patch[sound], widest=widest)

    def rim(self) -> tuple[Ints, Ints]:
        """The open edges (e, 2) and the face (e,) of each."""
        order, starts, counts = edge_groups(self.faces)
        single = np.sort(order[starts[counts == 1]])
        return half_edges(self.faces)[single], single // 3

    def open_gaps(self, wide: float) -> Floats:
        """How far starts of open edges (g,) lie from the rim of another patch, up to ``wide``."""
        from scipy.spatial import KDTree

        edges, face = self.rim()
        owner, shares = self.patch[face], np.arange(RIM_POINTS)[:, None, None] / RIM_POINTS
        start, end = self.vertices[edges[:, 0]], self.vertices[edges[:, 1]]
        along = start + shares * (end - start)
        gaps = [np.empty(0)]
        for name in np.unique(owner):
            ours, theirs = start[owner == name], along[:, owner != name].reshape(-1, 3)
            if len(theirs):
                distance, _ = KDTree(theirs).query(ours, distance_upper_bound=wide)
                gaps.append(distance[np.isfinite(distance) & (distance > 0.0)])
        return np.concatenate(gaps)


def closed_gaps(vertices: Floats, faces: Ints, patch: Ints, gap: float) -> Patches:
    """The patches with the gaps between them closed.

    First, rim vertices of two patches that are each other's nearest become one. Then an open edge
    takes in the rim vertices of the other patch that lie along it.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
    patch : (m,)
        The patch of each face.
    gap : float
        The widest gap that is closed, in the vertices' unit.
    """
    points, corners, _ = welded_vertices(vertices, faces)
    patches = Patches(points, corners, patch).with_faces(corners, patch, np.empty(0))
    patches = _with_equal_vertices(patches, gap)
    for _ in range(ROUNDS):
        before = len(patches.faces)
        patches = _with_split_edges(patches, gap)
        if len(patches.faces) == before:
            break
    return patches


def _with_equal_vertices(patches: Patches, gap: float) -> Patches:
    """The patches, in which rim vertices that are each other's nearest are one."""
    from scipy.spatial import KDTree

    edges, face = patches.rim()
    owner, points = patches.patch[face], patches.vertices
    rims = [np.unique(edges[owner == name]) for name in np.unique(owner)]
    boxes = [(points[rim].min(axis=0) - gap, points[rim].max(axis=0) + gap) for rim in rims]
    trees = [KDTree(points[rim]) for rim in rims]
    links, distances = [np.empty((0, 2), dtype=np.int64)], [np.empty(0)]
    for i, j in combinations(range(len(rims)), 2):
        if (boxes[i][0] > boxes[j][1]).any() or (boxes[j][0] > boxes[i][1]).any():
            continue
        distance, theirs = trees[j].query(points[rims[i]], distance_upper_bound=gap)
        near = np.flatnonzero(np.isfinite(distance))
        ours = trees[i].query(points[rims[j][theirs[near]]])[1] if len(near) else near
        near = near[ours == near]
        links.append(np.stack([rims[i][near], rims[j][theirs[near]]], axis=1))
        distances.append(distance[near])
    joined = lowest_connected(np.concatenate(links), len(points))
    return patches.with_faces(joined[patches.faces], patches.patch, np.concatenate(distances))


def _with_split_edges(patches: Patches, gap: float) -> Patches:
    """The patches, in which open edges take in the rim vertices of other patches along them."""
    from scipy.spatial import KDTree

    edges, face = patches.rim()
    if not len(edges):
        return patches
    points, faces = patches.vertices, patches.faces
    owned = np.stack([edges.ravel(), np.repeat(patches.patch[face], 2)], axis=1)
    rim, owner = np.unique(owned, axis=0).T
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    reach = 0.5 * np.linalg.norm(end - start, axis=1) + gap
    near = KDTree(points[rim]).query_ball_point(0.5 * (start + end), reach)
    fans: dict[int, Ints] = {}
    distances = [np.empty(0)]
    for (a, b), of, rows in zip(edges, face.tolist(), near, strict=True):
        found = np.unique(rim[rows][owner[rows] != patches.patch[of]])
        chain, away = _chain(points, a, b, found[(found != a) & (found != b)], gap)
        if of not in fans and len(away):
            third = faces[of][(faces[of] != a) & (faces[of] != b)]
            others = np.repeat(third, len(away) + 1)
            fans[of] = np.stack([chain[:-1], chain[1:], others], axis=1)
            distances.append(away)
    if not fans:
        return patches
    split = np.array(list(fans))
    more = np.repeat(patches.patch[split], [len(fan) for fan in fans.values()])
    return patches.with_faces(
        np.concatenate([np.delete(faces, split, axis=0), *fans.values()]),
        np.concatenate([np.delete(patches.patch, split), more]),
        np.concatenate(distances),
    )


def _chain(points: Floats, a: int, b: int, near: Ints, gap: float) -> tuple[Ints, Floats]:
    """The vertices from a to b over those of ``near`` that lie along the edge, and how far these
    lie from it.
    """
    way = points[b] - points[a]
    share = (points[near] - points[a]) @ way / (way @ way)
    away = np.linalg.norm(points[a] + share[:, None] * way - points[near], axis=1)
    on = np.flatnonzero((share > 0.0) & (share < 1.0) & (away <= gap))
    on = on[np.argsort(share[on], kind="stable")]
    return np.concatenate([[a], near[on], [b]]), away[on]
