"""The least girth by brute force: every plane of a grid, and scipy's convex hull.

It shares no code with footfit: a section is where the mesh's edges cross the plane.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from scipy.spatial import ConvexHull

EITHER_WAY_DEG = np.arange(-45.0, 45.1, 1.0)
FORWARD_DEG = np.arange(0.0, 45.1, 1.5)
TURNS_DEG = np.arange(-12.0, 12.1, 2.0)


def edges_of(faces: np.ndarray) -> np.ndarray:
    """Every edge of a mesh once, (e, 2)."""
    return np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)


def hull_perimeter(vertices, edges, place, normal, farthest=None) -> float:
    """The perimeter of the convex hull of a section.

    ``farthest`` (direction, limit): points farther in a direction do not count.
    """
    height = (vertices - place) @ normal
    start, end = edges[height[edges[:, 0]] * height[edges[:, 1]] < 0.0].T
    share = height[start] / (height[start] - height[end])
    points = vertices[start] + share[:, None] * (vertices[end] - vertices[start])
    if farthest is not None:
        points = points[points @ farthest[0] < farthest[1]]
    plane = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2][:2]
    return float(ConvexHull(points @ plane.T).area)  # scipy calls the perimeter of a flat hull area


def turned(axis, direction, deg):
    """A direction turned about an axis (Rodrigues)."""
    axis = axis / np.linalg.norm(axis)
    cosine, sine = np.cos(np.radians(deg)), np.sin(np.radians(deg))
    along = axis * (axis @ direction) * (1.0 - cosine)
    return direction * cosine + np.cross(axis, direction) * sine + along


def least_about(vertices, edges, start, end, upright, farthest=None) -> float:
    """The least girth of all planes through two places."""
    line = end - start
    normal = np.cross(line, upright)
    normal = normal / np.linalg.norm(normal)
    planes = (turned(line, normal, deg) for deg in EITHER_WAY_DEG)
    return min(hull_perimeter(vertices, edges, start, plane, farthest) for plane in planes)


def least_over(vertices, edges, place) -> float:
    """The least girth of all planes over a place that lean forward, turned in plan."""
    return min(hull_perimeter(vertices, edges, place, plane) for plane in _leaning_planes())


def _leaning_planes() -> Iterable[np.ndarray]:
    for turn in TURNS_DEG:
        across = turned(np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0]), turn)
        ahead = np.cross(across, [0.0, 0.0, 1.0])
        for lean in FORWARD_DEG:  # the upper end goes ahead, so the normal's front goes down
            yield turned(across, ahead, lean)


def least_girths(shape) -> dict[str, float]:
    """The four girths by brute force, at the places of a shape."""
    vertices, edges = shape.vertices_mm, edges_of(shape.faces)
    across = np.array([0.0, 1.0, 0.0])
    crown, base = shape.instep_crown.place, shape.heel_base
    along = (crown - base) / np.linalg.norm(crown - base)
    farthest = (along, crown @ along + 0.1 * shape.length_mm)
    return {
        "ball_girth_least": least_about(vertices, edges, *shape.joints, shape.upright),
        "waist_girth_least": least_over(vertices, edges, shape.waist_crown.place),
        "instep_girth_least": least_over(vertices, edges, crown),
        "heel_girth_instep": least_about(vertices, edges, base, crown, across, farthest),
    }
