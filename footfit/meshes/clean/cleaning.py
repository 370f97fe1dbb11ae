"""From a file's triangles to a surface: welded, without debris, wound outward."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.errors import EmptyMesh
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.topology import (
    boundary_edges,
    consistently_wound,
    edges,
    face_components,
)
from footfit.geometry.mesh.welding import has_distinct_corners, welded, without_unused_vertices
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.meshes.clean.loose_pieces import kept_faces
from footfit.meshes.clean.spikes import pressed_spikes
from footfit.results import Notice


@dataclass(frozen=True, slots=True)
class CleanSettings:
    """What counts as nothing.

    Attributes
    ----------
    sliver : float
        A face whose area is below this share of the mean area has none.
    loose_ratio : float
        More vertices per face than this after the exact weld (a closed surface has 0.5) and the
        corners were rounded apart: they are welded once more within the tolerance below.
    near_extent, near_coordinate : float
        That tolerance: the larger of this share of the diagonal and of the largest coordinate.
    own_centre_share : float
        Outside is judged from a piece's own middle from this share of the largest piece's area
        on; a smaller open patch is judged from the whole's.
    """

    sliver: float = 1e-12
    loose_ratio: float = 1.2
    near_extent: float = 1e-5
    near_coordinate: float = 5e-7
    own_centre_share: float = 0.10


CLEAN_SETTINGS = CleanSettings()


@dataclass(frozen=True, slots=True)
class Cleaned:
    """A surface in the file's numbers.

    ``source_to_vertex`` (vertices of the file,) is the row of ``vertices`` each became, -1 where
    it was dropped. ``watertight``: every edge lies in exactly two faces (counted before faces
    without an area go, since those close a surface too).
    """

    vertices: Floats
    faces: Ints
    source_to_vertex: Ints
    watertight: bool
    warnings: tuple[Notice, ...]


def cleaned(vertices: Floats, faces: Ints, settings: CleanSettings = CLEAN_SETTINGS) -> Cleaned:
    """Weld, drop what has no area or stands twice, keep the pieces that matter, wind outward.

    Parameters
    ----------
    vertices : (n, 3) float64
        Finite, in any unit.
    faces : (m, 3) int64
    settings : CleanSettings

    Returns
    -------
    Cleaned
        With notices ``near_vertices_welded``, ``degenerate_removed``, ``duplicates_removed``,
        ``spikes_pressed``, those of :func:`footfit.meshes.clean.loose_pieces.kept_faces`,
        ``winding_fixed``, ``non_manifold``, ``open_mesh``.

    Raises
    ------
    EmptyMesh
        No face has an area.
    DamagedMesh
        The surface is in far too many pieces.
    """
    vertices, faces, source, notices = _welded(vertices, faces, settings)
    faces, collapsed, found = _each_once(faces)
    notices += found
    vertices, pressed = pressed_spikes(vertices, faces)
    notices += _counted("spikes_pressed", pressed, "spikes were pressed back into the surface")
    vectors = area_vectors(vertices, faces)
    areas = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    flat = areas <= settings.sliver * areas.mean() if len(areas) else areas == 0.0
    if flat.all():
        raise EmptyMesh("no triangle of the file has an area: export the mesh again")
    labels = face_components(faces, len(vertices))
    kept, found = kept_faces(vertices, faces, labels, areas)
    notices += found
    if not kept.all():
        faces, vectors, labels, flat = faces[kept], vectors[kept], labels[kept], flat[kept]
    faces, turned = _wound_outward(vertices, faces, vectors, labels, settings)
    notices += _counted("winding_fixed", turned, "faces looked inward and were turned over")
    watertight, found = _closure(faces)
    removed = collapsed + int(flat.sum())
    notices += _counted("degenerate_removed", removed, "faces without an area were removed")
    vertices, faces, new_number = without_unused_vertices(vertices, faces[~flat])
    return Cleaned(vertices, faces, new_number[source], watertight, notices + found)


def _each_once(faces: Ints) -> tuple[Ints, int, tuple[Notice, ...]]:
    """Faces of three different vertices, each once; how many had collapsed; what to say."""
    distinct = has_distinct_corners(faces)
    faces, collapsed = faces[distinct], int((~distinct).sum())
    once = _first_of_equals(faces)
    doubled = int((~once).sum())
    notices = _counted("duplicates_removed", doubled, "faces stood in the file twice")
    return faces[once], collapsed, notices


def _counted(code: str, count: int, words: str) -> tuple[Notice, ...]:
    return (Notice(code, f"{count:,} {words}"),) if count else ()


def _welded(
    vertices: Floats, faces: Ints, settings: CleanSettings
) -> tuple[Floats, Ints, Ints, tuple[Notice, ...]]:
    """The exact weld, and where it leaves the faces apart the weld of nearly equal corners."""
    points, joined, source = welded(vertices, faces)
    if len(points) <= settings.loose_ratio * len(faces):
        return points, joined, source, ()
    corners = points[np.unique(joined)]
    diagonal = float(np.linalg.norm(np.ptp(corners, axis=0)))
    far = float(np.abs(corners).max())
    tolerance = max(settings.near_extent * diagonal, settings.near_coordinate * far)
    if not tolerance > 0.0:
        return points, joined, source, ()
    near, nearly, merged = _nearly_welded(points, joined, tolerance)
    if 2 * len(boundary_edges(nearly)) > len(boundary_edges(joined)):
        return points, joined, source, ()
    message = f"corners up to {tolerance:.2g} (the file's unit) apart were taken as one"
    return near, nearly, merged[source], (Notice("near_vertices_welded", message),)


def _nearly_welded(vertices: Floats, faces: Ints, tolerance: float) -> tuple[Floats, Ints, Ints]:
    """Merge vertices that share a cell of a grid, then of the grid moved by half a cell."""
    source = np.arange(len(vertices))
    for shift in (0.0, 0.5):
        cells = np.floor(vertices / tolerance + shift)
        _, faces, group = welded(cells, faces)
        first = np.unique(group, return_index=True)[1]
        vertices, source = vertices[first], group[source]
    return vertices, faces, source


def _first_of_equals(faces: Ints) -> Bools:
    """False for every face whose three vertices an earlier face has, in any order, (m,)."""
    ordered = np.sort(faces, axis=1)
    span = int(faces.max(initial=0)) + 1
    pair = ordered[:, 0] * span + ordered[:, 1]
    if span**3 < np.iinfo(np.int64).max:
        keys = np.sort(pair * span + ordered[:, 2])
        if not (keys[1:] == keys[:-1]).any():
            return np.ones(len(faces), dtype=bool)
    order = np.lexsort((ordered[:, 2], pair))
    again = np.zeros(len(faces), dtype=bool)
    again[1:] = ~_any_differs(ordered[order[1:]], ordered[order[:-1]])
    first = np.empty(len(faces), dtype=bool)
    first[order] = ~again  # the sort is stable: of equals the earliest comes first
    return first


def _wound_outward(
    vertices: Floats, faces: Ints, vectors: Floats, labels: Ints, settings: CleanSettings
) -> tuple[Ints, int]:
    """Faces that agree with their neighbours and look away from the middle, and how many turned.

    The sum of A (c - g).N over a piece is three times the volume of a closed one whatever g is; of
    an open one its sign tells outside, with g the piece's centroid.
    """
    turned = _any_differs(consistently_wound(faces), faces)
    signs = np.where(turned, -1.0, 1.0)
    area = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    centres = (vertices[faces[:, 0]] + vertices[faces[:, 1]] + vertices[faces[:, 2]]) / 3.0
    middles = _middles(centres, area, labels, settings)
    outwardness = signs * np.einsum("ij,ij->i", centres - middles[labels], vectors)
    inward = np.bincount(labels, weights=outwardness) < 0.0
    turned ^= inward[labels]
    outward = np.where(turned[:, None], faces[:, [0, 2, 1]], faces)
    return outward, int(turned.sum())


def _middles(centres: Floats, area: Floats, labels: Ints, settings: CleanSettings) -> Floats:
    """The centroid of each piece, for small pieces that of the whole, (k, 3)."""
    areas = np.bincount(labels, weights=area)
    moments = np.stack(
        [np.bincount(labels, weights=area * centres[:, axis]) for axis in range(3)], axis=1
    )
    middles: Floats = moments / np.where(areas > 0.0, areas, 1.0)[:, None]
    middles[areas < settings.own_centre_share * areas.max()] = moments.sum(axis=0) / areas.sum()
    return middles


def _any_differs(faces: Ints, others: Ints) -> Bools:
    """Which rows differ, (m,); by columns, as NumPy is slow along an axis of three."""
    a, b, c = (faces != others).T
    return np.asarray(a | b | c)


def _closure(faces: Ints) -> tuple[bool, tuple[Notice, ...]]:
    """Whether every edge has exactly two faces, and what to say where not."""
    rims = len(boundary_edges(faces))
    crowded = 3 * len(faces) - rims - 2 * (len(edges(faces)) - rims)
    notices = _counted("non_manifold", crowded, "times more than two faces share an edge")
    notices += _counted("open_mesh", rims, "edges have one face only: the surface is open")
    return not notices, notices
