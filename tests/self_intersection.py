"""Whether a surface cuts itself: every edge against every face near it.

It shares no code with footfit.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

NEAR = 1e-9
"""Of an edge or a face: what touches in a corner does not cut."""


def welded(vertices, faces):
    """A mesh whose equal corners are one: two corners at one place do not cut each other."""
    places, number = np.unique(np.asarray(vertices, dtype=np.float64), axis=0, return_inverse=True)
    return places, number.reshape(-1)[faces]


def self_intersections(vertices, faces) -> int:
    """How many pairs of an edge and a face cut each other without a common corner."""
    vertices, faces = welded(vertices, faces)
    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    ends, corners = vertices[edges], vertices[faces]
    edge_middle, face_middle = ends.mean(axis=1), corners.mean(axis=1)
    edge_reach = np.linalg.norm(ends - edge_middle[:, None], axis=2).max(axis=1)
    face_reach = np.linalg.norm(corners - face_middle[:, None], axis=2).max(axis=1)
    tree = cKDTree(edge_middle)
    count = 0
    for start in range(0, len(faces), 4000):
        some = slice(start, start + 4000)
        near = tree.query_ball_point(face_middle[some], face_reach[some] + edge_reach.max())
        face = np.repeat(np.arange(start, start + len(near)), [len(each) for each in near])
        edge = np.concatenate([np.asarray(each, dtype=np.int64) for each in near])
        apart = np.linalg.norm(edge_middle[edge] - face_middle[face], axis=1)
        shared = (edges[edge][:, :, None] == faces[face][:, None, :]).any(axis=(1, 2))
        kept = ~shared & (apart < edge_reach[edge] + face_reach[face])
        count += int(_cuts(ends[edge[kept]], corners[face[kept]]).sum())
    return count


def _cuts(ends, corners):
    """Which segments (k, 2, 3) pass through which triangles (k, 3, 3): Moeller and Trumbore."""
    along = ends[:, 1] - ends[:, 0]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(along, second)
    volume = (first * normal).sum(axis=1)
    safe = np.where(np.abs(volume) > 1e-12, volume, np.nan)
    away = ends[:, 0] - corners[:, 0]
    u = (away * normal).sum(axis=1) / safe
    across = np.cross(away, first)
    v = (along * across).sum(axis=1) / safe
    at = (second * across).sum(axis=1) / safe
    inside = (u > NEAR) & (v > NEAR) & (u + v < 1.0 - NEAR)
    return inside & (at > NEAR) & (at < 1.0 - NEAR)
