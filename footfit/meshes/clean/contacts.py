"""Where closed bodies touch with other triangles on the two sides: those faces are in the solid."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, unit
from footfit.geometry.mesh.topology import edge_groups, lowest_connected
from footfit.geometry.mesh.welding import rounding_distance
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, row_dots, row_lengths


@dataclass(frozen=True, slots=True)
class ContactSettings:
    """When faces touch.

    Attributes
    ----------
    level : float
        Of neighbours in a plane, and of faces that touch, the unit normals differ by no more.
    rounding : float
        Faces that touch are so many times as far apart as rounding moves a corner, at most.
    corner : float
        A face is covered if its middle is, and the places this share of the way from there to its
        corners.
    even : float
        The covered faces of both bodies have the same area to within this share.
    most : float
        More of the whole area than this is no contact: then the surface has two sides.
    planes, at_once : int
        So many planes are looked at, and so many faces of one together.
    cell : float
        Faces of such a cell are looked at together, over the extent of what they may cover.
    """

    level: float = 1e-3
    rounding: float = 8.0
    corner: float = 0.9
    even: float = 0.02
    most: float = 0.5
    planes: int = 2000
    at_once: int = 64
    cell: float = 0.05


CONTACTS = ContactSettings()


def contact_faces(vertices: Floats, faces: Ints) -> Bools:
    """Which faces (m,) lie inside a solid, because faces of another body cover them the other way.

    The outline of the contact is shared: other faces of both bodies end there.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Each once.
    """
    inner = np.zeros(len(faces), dtype=bool)
    vectors = area_vectors(vertices, faces)
    areas, normals = row_lengths(vectors), unit(vectors)
    apart = CONTACTS.rounding * rounding_distance(vertices)
    for plane in _planes_at_crowded_edges(vertices, faces, normals, apart):
        upward = normals[plane] @ normals[plane[0]] > 0.0
        sides = plane[upward], plane[~upward]
        covered = [
            side[_covered(vertices, faces[side], faces[other], apart)]
            for side, other in (sides, sides[::-1])
        ]
        above, below = (float(areas[side].sum()) for side in covered)
        if abs(above - below) <= CONTACTS.even * max(above, below):
            inner[np.concatenate(covered)] = True
    if areas[inner].sum() > CONTACTS.most * areas.sum():
        return np.zeros(len(faces), dtype=bool)
    return inner


def _planes_at_crowded_edges(
    vertices: Floats, faces: Ints, normals: Floats, apart: float
) -> Iterator[Ints]:
    """The rows of faces in a plane, looking both ways, that reach an edge of over two faces."""
    order, starts, counts = edge_groups(faces)
    pair = order[np.stack([starts, starts + 1], axis=1)[counts == 2]] // 3
    differ = row_lengths(normals[pair[:, 0]] - normals[pair[:, 1]])
    label = lowest_connected(pair[differ < CONTACTS.level], len(faces))
    crowded = np.unique(label[order[np.repeat(counts > 2, counts)] // 3])
    rest = np.flatnonzero(np.isin(label, crowded))
    offset = row_dots(normals, vertices[faces[:, 0]])
    for _ in range(CONTACTS.planes):
        if not len(rest):
            return
        first = rest[0]
        along = normals[rest] @ normals[first]
        level = np.abs(along) > 1.0 - CONTACTS.level
        level &= np.abs(np.sign(along) * offset[rest] - offset[first]) < apart
        if (along[level] < 0.0).any():
            yield rest[level]
        rest = rest[~level | (rest == first)][1:]


def _covered(vertices: Floats, faces: Ints, others: Ints, apart: float) -> Bools:
    """Which faces (k, 3) lie within other faces (l, 3) of their plane."""
    if not len(faces) or not len(others):
        return np.zeros(len(faces), dtype=bool)
    along, side = vertices[faces[0, 1:]] - vertices[faces[0, 0]]
    across = np.cross(np.cross(along, side), along)
    flat = vertices @ np.stack([along, across] / row_lengths(np.stack([along, across]))[:, None]).T
    corners = flat[faces]
    middle = corners.mean(axis=1, keepdims=True)
    places = np.concatenate([middle, middle + CONTACTS.corner * (corners - middle)], axis=1)
    places, inside = places.reshape(-1, 2), np.zeros(4 * len(faces), dtype=bool)
    triangles = flat[others]
    cells = (triangles.mean(axis=1) / (CONTACTS.cell * np.ptp(places, axis=0).max())).round()
    triangles = triangles[np.lexsort(cells.T)]  # so that those of a block lie together
    for start in range(0, len(others), CONTACTS.at_once):
        block = triangles[start : start + CONTACTS.at_once]
        low, high = block.min(axis=(0, 1)) - apart, block.max(axis=(0, 1)) + apart
        near = np.flatnonzero(((places > low) & (places < high)).all(axis=1) & ~inside)
        inside[near] = _within(places[near], block, apart).any(axis=1)
    return np.asarray(inside.reshape(-1, 4).all(axis=1))


def _within(places: Floats, triangles: Floats, apart: float) -> Bools:
    """Which places (p, 2) lie in which triangles (t, 3, 2), (p, t)."""
    x, y = places.T[:, :, None]
    ends = np.roll(triangles, -1, axis=1) - triangles
    turn = np.sign(ends[:, 0, 0] * ends[:, 1, 1] - ends[:, 0, 1] * ends[:, 1, 0])
    within = np.ones((len(places), len(triangles)), dtype=bool)
    for corner in range(3):
        (from_x, from_y), (to_x, to_y) = triangles[:, corner].T, ends[:, corner].T
        inward = turn * (to_x * (y - from_y) - to_y * (x - from_x))
        within &= inward > -apart * np.hypot(to_x, to_y)
    return within
