"""The parts of a scene: where each one stands, and how they become one surface.

A GLB's nodes and a 3MF's components are the same idea: a tree whose nodes carry transforms and
whose leaves are meshes. A scanner cuts one surface into several of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from footfit.errors import DamagedMesh
from footfit.geometry.mesh.topology import boundary_edges
from footfit.geometry.mesh.welding import nearby_vertices, rounding_distance, welded_vertices
from footfit.geometry.numeric.arrays import Floats, Ints, distinct
from footfit.geometry.numeric.rotations import moved_points
from footfit.meshes.formats.raw import RawMesh
from footfit.meshes.read_limits import Limits
from footfit.results.values import Notice

_Key = TypeVar("_Key")


@dataclass(frozen=True, slots=True)
class Part:
    """``vertices`` (n, 3), ``faces`` (m, 3), and the (4, 4) transform that puts them in place."""

    vertices: Floats
    faces: Ints
    transform: Floats


def placed_nodes(
    roots: Iterable[_Key],
    node: Callable[[_Key], tuple[Floats, Sequence[_Key]]],
    limits: Limits,
) -> Iterator[tuple[_Key, Floats]]:
    """Each node of a scene with the (4, 4) transform from its own frame to the scene's.

    A node that is named twice comes twice.

    Parameters
    ----------
    roots : iterable of keys
    node : callable
        From a key to the node's own (4, 4) transform and the keys of its children.
    limits : Limits

    Raises
    ------
    DamagedMesh
        There are more than ``limits.parts`` nodes, which is also how a loop ends.
    """
    waiting = [(key, np.eye(4)) for key in roots][::-1]
    visited = 0
    while waiting:
        visited += 1
        if visited + len(waiting) > limits.parts:
            raise DamagedMesh(
                f"the file's objects contain each other, or there are over {limits.parts:,}:"
                " export the foot alone"
            )
        key, above = waiting.pop()
        own, children = node(key)
        with np.errstate(all="ignore"):  # `checked_mesh` refuses what is not finite
            transform = above @ own
        yield key, transform
        waiting += [(child, transform) for child in reversed(children)]


def joined_parts(parts: Sequence[Part], objects: int, unit: str) -> RawMesh:
    """All parts in place, as one mesh whose objects share the vertices of their seams.

    Parameters
    ----------
    parts : sequence of Part
        At least one.
    objects : int
        How many objects the parts belong to: an object of several materials has several parts.
    unit : str
        The unit that the file declares.

    Returns
    -------
    RawMesh
        With the notice ``objects_joined`` where there are several objects.

    Raises
    ------
    DamagedMesh
        A face names a vertex that its own part does not have.
    """
    vertices, faces, count = [], [], 0
    for part in parts:
        if part.faces.size and not 0 <= part.faces.min() <= part.faces.max() < len(part.vertices):
            raise DamagedMesh("a face names a vertex that is not there: export the mesh again")
        placed, wound = _in_place(part)
        vertices.append(placed)
        faces.append(wound + count)
        count += len(placed)
    points, triangles = np.concatenate(vertices), np.concatenate(faces)
    if objects < 2:
        return RawMesh(points, triangles, (), unit)
    notice = Notice("objects_joined", f"the file's {objects} objects are read as one surface")
    return RawMesh(_with_equal_seams(points, triangles), triangles, (notice,), unit)


def _in_place(part: Part) -> tuple[Floats, Ints]:
    """A part's vertices under its transform, and its faces; a mirrored part is wound back."""
    if np.array_equal(part.transform, np.eye(4)):
        return part.vertices, part.faces
    with np.errstate(all="ignore"):  # `checked_mesh` refuses what is not finite
        mirrored = np.linalg.det(part.transform[:3, :3]) < 0.0
        placed = moved_points(part.transform, part.vertices)
    return placed, part.faces[:, ::-1] if mirrored else part.faces


def _with_equal_seams(vertices: Floats, faces: Ints) -> Floats:
    """The vertices (n, 3), with nearly equal ones on open rims made exactly equal.

    Each part is stored in its own frame, so rounding moves the two sides of a seam apart. Vertices
    inside a part are not touched.
    """
    if not len(faces) or not np.isfinite(vertices).all():
        return vertices
    points, corners, source = welded_vertices(vertices, faces)
    rim = distinct(boundary_edges(corners))
    near = rounding_distance(points)
    if not len(rim) or not near > 0.0:
        return vertices
    points[rim] = points[rim][nearby_vertices(points[rim], 4.0 * near)]
    return points[source]
