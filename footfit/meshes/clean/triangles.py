"""From a file's triangles to a mesh: equal corners welded, each triangle once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.topology import boundary_edges, edge_groups, face_components, rows_differ
from footfit.geometry.mesh.welding import (
    has_distinct_corners,
    nearby_vertices,
    rounding_distance,
    welded_vertices,
)
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct
from footfit.meshes.clean.spikes import pressed_spikes
from footfit.results.values import Notice, count_notice


@dataclass(frozen=True, slots=True)
class WeldSettings:
    """When nearly equal corners are welded.

    Attributes
    ----------
    loose_ratio : float
        A closed surface has 0.5 vertices for each face. With more than this after the exact weld,
        rounding has moved the corners apart, and nearly equal ones are welded too.
    walled : float
        Faces that lie twice are a wall inside a solid if so much of their rim has two other faces.
    """

    loose_ratio: float = 1.2
    walled: float = 0.5


WELDING = WeldSettings()


@dataclass(frozen=True, slots=True)
class WeldedMesh:
    """A mesh in the file's numbers; its faces share vertices, and none is there twice.

    ``source_to_vertex`` (vertices of the file,) is the row of ``vertices`` that each became.
    ``collapsed`` counts the faces that were dropped because two of their corners were equal.
    """

    vertices: Floats
    faces: Ints
    source_to_vertex: Ints
    collapsed: int
    notices: tuple[Notice, ...]


def welded_mesh(vertices: Floats, faces: Ints) -> WeldedMesh:
    """Weld equal corners, drop repeated faces and faces that are no triangle, press spikes back.

    Where two closed bodies touch, the faces that they share lie inside the solid. Both go.

    Parameters
    ----------
    vertices : (n, 3) float64
        Finite, in any unit.
    faces : (m, 3) int64

    Returns
    -------
    WeldedMesh
        With notices ``near_vertices_welded``, ``inner_faces_removed``, ``duplicates_removed``,
        ``spikes_pressed``.
    """
    vertices, faces, source, notices = _welded(vertices, faces)
    distinct = has_distinct_corners(faces)
    faces = faces[distinct]
    once, pair = _equals(faces)
    inner = _inner_faces(faces, pair)
    words = "faces inside the solid, where two bodies touch, were removed"
    notices += count_notice("inner_faces_removed", int(inner.sum()), words)
    again = int((~once & ~inner).sum())
    notices += count_notice(
        *("duplicates_removed", again, "repeated faces were removed", "repeated face was removed")
    )
    faces = faces[once & ~inner]
    vertices, pressed = pressed_spikes(vertices, faces)
    notices += count_notice(
        "spikes_pressed",
        pressed,
        "spikes were pressed back into the surface",
        "spike was pressed back into the surface",
    )
    return WeldedMesh(vertices, faces, source, int((~distinct).sum()), notices)


def _welded(vertices: Floats, faces: Ints) -> tuple[Floats, Ints, Ints, tuple[Notice, ...]]:
    """The exact weld, and the weld of nearly equal corners if that leaves the faces apart."""
    points, joined, source = welded_vertices(vertices, faces)
    if len(points) <= WELDING.loose_ratio * len(faces):
        return points, joined, source, ()
    tolerance = rounding_distance(points[distinct(joined)])
    if not tolerance > 0.0:
        return points, joined, source, ()
    near, nearly, merged = welded_vertices(points[nearby_vertices(points, tolerance)], joined)
    if 2 * len(boundary_edges(nearly)) > len(boundary_edges(joined)):
        return points, joined, source, ()
    message = f"corners up to {tolerance:.2g} apart, in the file's unit, were joined"
    return near, nearly, merged[source], (Notice("near_vertices_welded", message),)


def _equals(faces: Ints) -> tuple[Bools, Ints]:
    """Which faces are the first with their three vertices, in any order, (m,); and equal pairs.

    The pairs (k, 2) are a face and the next one that is equal to it.
    """
    ordered = np.sort(faces, axis=1)
    span = int(faces.max(initial=0)) + 1
    pair = ordered[:, 0] * span + ordered[:, 1]
    if span**3 < np.iinfo(np.int64).max:
        keys = np.sort(pair * span + ordered[:, 2])
        if not (keys[1:] == keys[:-1]).any():
            return np.ones(len(faces), dtype=bool), np.empty((0, 2), dtype=np.int64)
    order = np.lexsort((ordered[:, 2], pair))
    again = np.zeros(len(faces), dtype=bool)
    again[1:] = ~rows_differ(ordered[order[1:]], ordered[order[:-1]])
    first = np.empty(len(faces), dtype=bool)
    first[order] = ~again  # the sort is stable: of equals the earliest comes first
    later = np.flatnonzero(again)
    return first, np.stack([order[later - 1], order[later]], axis=1)


def _inner_faces(faces: Ints, pairs: Ints) -> Bools:
    """Which faces (m,) lie inside a solid: twice, once each way, where two closed bodies touch.

    Two other faces end at each edge around such a wall, one of each body. Around a sheet that a
    program wrote with two sides there is none.
    """
    inner = np.zeros(len(faces), dtype=bool)
    opposite = _runs_upward(faces[pairs[:, 0]]) != _runs_upward(faces[pairs[:, 1]])
    pairs = pairs[opposite]
    if not len(pairs):
        return inner
    order, starts, counts = edge_groups(faces)
    edge, face = np.repeat(np.arange(len(starts)), counts), order // 3
    doubled = np.zeros(len(faces), dtype=np.int64)
    doubled[pairs] = 1
    walls = np.add.reduceat(doubled[face], starts)  # an edge within the wall has four
    patch = np.full(len(faces), -1, dtype=np.int64)
    patch[pairs[:, 0]] = face_components(faces[pairs[:, 0]], int(faces.max()) + 1)
    rim = (patch[face] >= 0) & (walls[edge] == 2)
    walled = (counts - walls)[edge[rim]] >= 2
    whole = np.bincount(patch[face[rim]], minlength=int(patch.max()) + 1)
    between = np.bincount(patch[face[rim]], weights=walled, minlength=len(whole))
    inner[pairs[((between >= WELDING.walled * whole) & (whole > 0))[patch[pairs[:, 0]]]]] = True
    return inner


def _runs_upward(faces: Ints) -> Bools:
    """Whether a face runs through its three vertices in rising order, from the lowest on, (k,)."""
    a, b, c = faces.T
    return np.asarray((a < b).astype(np.int64) + (b < c) + (c < a) == 2)
