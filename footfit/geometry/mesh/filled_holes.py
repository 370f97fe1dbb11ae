"""Facets that a program closed a hole with: large ones, or small ones that all lie in one plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, unit
from footfit.geometry.mesh.topology import edge_groups, lowest_connected
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct, row_dots, row_lengths
from footfit.geometry.numeric.quantiles import median


@dataclass(frozen=True, slots=True)
class FillingSettings:
    """What tells a filling from a surface; lengths over L, areas over L squared.

    Attributes
    ----------
    long, longer : float
        Facets that meet in an edge longer than both, over L and over the mesh's median edge,
        belong together.
    larger : float
        They are a filling if their longest edges are so many times as long as the edges around
        them. No hole is filled evenly: its rim is as fine as the scan. Decimated meshes reach 3.4.
    beyond : float
        And so many times as long as the longest edges of the facets beyond their rim: a mesh of
        slender strips has long facets next to each other. Fillings have 2.7 or more.
    crease_deg : float
        And if the surface bends where they begin: by so much, times how much larger they are. Where
        it hardly bends, they hardly differ from it. What it bends by elsewhere, as with noise, is
        taken off.
    level_deg : float
        Faces that meet by less are level: they say nothing of how much the surface bends.
    wall : float
        Walls of a cut meet at an edge whose cosine is less.
    area, plane_area, plane_faces : float, float, int
        The least area of large facets, and of facets in a plane, and how many of these there are
        at least: of a decimated mesh a few facets may lie in a plane.
    normal_bins, bin_area, counted : int, float, int
        Normals are counted in so many bins each way. A plane fills one, or four neighbours. About
        so many faces are counted.
    level : float
        How far the unit normals of neighbours in a plane may differ.
    thickness : float
        How far facets in a plane may lie from it.
    known : float
        A patch of which so much is known to be a lid or a flat sole is no filling.
    """

    long: float = 0.05
    longer: float = 3.0
    larger: float = 4.0
    beyond: float = 2.0
    crease_deg: float = 60.0
    level_deg: float = 0.1
    wall: float = 0.8
    area: float = 0.004
    plane_area: float = 0.008
    plane_faces: int = 30
    normal_bins: int = 256
    bin_area: float = 0.0015
    counted: int = 12_000
    level: float = 0.002
    thickness: float = 0.001
    known: float = 0.5


FILLING = FillingSettings()


@dataclass(frozen=True, slots=True)
class _Patches:
    """Patches of faces: the faces' rows, and the number of the patch of each, (k,)."""

    rows: Ints
    label: Ints

    def sums(self, values: Floats) -> Floats:
        """The sum of the values (k,) of each patch's faces, (patches,)."""
        return np.bincount(self.label, weights=values).astype(np.float64)


def filled_faces(
    vertices: Floats, faces: Ints, length: float, known: Bools, *, plane_is_shape: bool
) -> Bools:
    """Which faces (m,) a program closed a hole with.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
    length : float
        Of the shape, in the unit of the vertices.
    known : (m,) bool
        Faces that are flat in their own right: the lid of a leg, a sole on the ground.
    plane_is_shape : bool
        Whether a plane may be a part of the shape, as the cuts of a last are. Then facets in a
        plane are no filling.
    """
    filled = np.zeros(len(faces), dtype=bool)
    patches = [_large_facets(vertices, faces, length, apart=plane_is_shape)]
    if not plane_is_shape:
        patches.append(_planes(vertices, faces, length, known))
    for each in patches:
        if not len(each.rows):
            continue
        areas = row_lengths(area_vectors(vertices, faces[each.rows]))
        filling = each.sums(areas * known[each.rows]) < FILLING.known * each.sums(areas)
        if plane_is_shape:
            filling &= ~_lie_in_planes(vertices, faces, each, length)
        filled[each.rows[filling[each.label]]] = True
    return filled


def _lie_in_planes(vertices: Floats, faces: Ints, patches: _Patches, length: float) -> Bools:
    """Which patches are thinner than ``FILLING.thickness``, (patches,)."""
    flat = np.zeros(int(patches.label.max()) + 1, dtype=bool)
    for number in range(len(flat)):
        points = vertices[distinct(faces[patches.rows[patches.label == number]])]
        normal = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2][-1]
        flat[number] = np.ptp(points @ normal) < FILLING.thickness * length
    return flat


# ---------------------------------------------------------------- large facets


def _large_facets(vertices: Floats, faces: Ints, length: float, *, apart: bool) -> _Patches:
    """Patches of facets much larger than the edges around them, with a crease around them.

    ``apart``: walls that meet in an edge are patches of their own.
    """
    columns = [np.ascontiguousarray(column)[faces.T] for column in vertices.T]
    x, y, z = (np.square(column[[1, 2, 0]] - column) for column in columns)
    squares = x + y + z  # (3, m): the edge from each corner on
    usual = float(np.sqrt(median(squares[:, :: max(1, len(faces) // 2000)])))
    least = max(FILLING.long * length, FILLING.longer * usual) ** 2
    large = (squares > least).any(axis=0)
    if not large.any():
        return _none()
    rim = np.zeros(len(vertices), dtype=bool)
    rim[faces[large]] = True
    near = np.flatnonzero(rim[faces].sum(axis=1) >= 2)  # the facets and their neighbours
    sides = np.sqrt(squares[:, near].T)
    order, starts, counts = edge_groups(faces[near])
    edge = sides.ravel()[order[starts]]
    pair = order[np.stack([starts, np.minimum(starts + 1, len(order) - 1)], axis=1)] // 3
    vectors = area_vectors(vertices, faces[near])
    areas, normals = row_lengths(vectors), unit(vectors)
    bend = row_dots(normals[pair[:, 0]], normals[pair[:, 1]]).clip(-1.0, 1.0)
    inside = (counts == 2) & (edge**2 > least)
    if apart:
        inside &= bend > FILLING.wall
    label = np.unique(lowest_connected(pair[inside], len(near)), return_inverse=True)[1].ravel()
    patches, longest = _Patches(near, label), sides.max(axis=1)
    size = patches.sums(areas * longest) / patches.sums(areas)
    outer = (counts == 2) & (edge**2 <= least) & (label[pair[:, 0]] != label[pair[:, 1]])
    around, total, beyond, crease = np.zeros((4, len(size)))
    for side in (0, 1):
        of = label[pair[outer, side]]
        around += np.bincount(of, minlength=len(size))
        total += np.bincount(of, edge[outer], len(size))
        beyond += np.bincount(of, longest[pair[outer, 1 - side]], len(size))
        crease += np.bincount(of, edge[outer] * np.arccos(bend[outer]), len(size))
    filling = patches.sums(areas) > FILLING.area * length**2
    filling &= (around > 0) & (size * around > FILLING.larger * total)
    filling &= size * around > FILLING.beyond * beyond
    filling &= np.bincount(label) > 1
    if not filling.any():
        return _none()
    usual_crease = total * usual_bend(vertices, faces)
    excess = np.sqrt(np.maximum(0.0, crease**2 - usual_crease**2))
    filling &= size * around * excess > np.radians(FILLING.crease_deg) * total**2
    return _chosen(patches, filling)


def usual_bend(vertices: Floats, faces: Ints) -> float:
    """By how much neighbours that are not level meet, the median, in radians."""
    normals = unit(area_vectors(vertices, faces))
    order, starts, counts = edge_groups(faces)
    first = starts[counts == 2]
    pair = np.stack([order[first], order[first + 1]], axis=1) // 3
    bend = np.arccos(row_dots(normals[pair[:, 0]], normals[pair[:, 1]]).clip(-1.0, 1.0))
    bend = bend[bend > np.radians(FILLING.level_deg)]
    return median(bend) if len(bend) else 0.0


# ---------------------------------------------------------------- planes


def _planes(vertices: Floats, faces: Ints, length: float, known: Bools) -> _Patches:
    """Patches of faces that lie in one plane to within rounding, as no scanned skin does."""
    step = max(1, len(faces) // FILLING.counted)
    vectors = area_vectors(vertices, faces[::step])
    areas = np.where(known[::step], 0.0, step * row_lengths(vectors))
    share = np.bincount(_normal_bin(vectors), areas, minlength=2 * FILLING.normal_bins**2)
    full = share > FILLING.bin_area * length**2
    if not full.any():
        return _none()
    vectors = area_vectors(vertices, faces)
    rows = np.flatnonzero(full[_normal_bin(vectors)] & ~known)
    vectors = vectors[rows]
    order, starts, counts = edge_groups(faces[rows])
    first = starts[counts == 2]
    pair = np.stack([order[first], order[first + 1]], axis=1) // 3
    normals = unit(vectors)
    level = row_lengths(normals[pair[:, 0]] - normals[pair[:, 1]]) < FILLING.level
    label = np.unique(lowest_connected(pair[level], len(rows)), return_inverse=True)[1].ravel()
    patches = _Patches(rows, label)
    wanted = patches.sums(row_lengths(vectors)) > FILLING.plane_area * length**2
    large = _chosen(patches, wanted & (np.bincount(label) >= FILLING.plane_faces))
    if not len(large.rows):
        return large
    return _chosen(large, _lie_in_planes(vertices, faces, large, length))


def _normal_bin(vectors: Floats) -> Ints:
    """The bin (m,) of each normal: its place in the octahedron's plan, and whether it looks up."""
    size = np.abs(vectors).sum(axis=1)
    x, y, z = vectors.T / np.where(size > 0.0, size, 1.0)
    bins = FILLING.normal_bins
    place = [(0.5 * bins * (axis + 1.0)).astype(np.int64).clip(0, bins - 1) for axis in (x, y)]
    return np.asarray((place[0] * bins + place[1]) * 2 + (z > 0.0))


def _none() -> _Patches:
    return _Patches(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def _chosen(patches: _Patches, wanted: Bools) -> _Patches:
    """Some of the patches, numbered anew."""
    kept = wanted[patches.label]
    label = (np.cumsum(wanted) - 1)[patches.label[kept]]
    return _Patches(patches.rows[kept], label)
