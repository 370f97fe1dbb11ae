"""New vertices inside big flat facets, for measures that are taken at vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import face_normals
from footfit.geometry.mesh.topology import (
    edge_groups,
    half_edges,
    lowest_connected,
)
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, row_dots


@dataclass(frozen=True, slots=True)
class RefinementSettings:
    """When a side is inside a flat facet, and how far splitting goes.

    Attributes
    ----------
    turn_most_deg : float
        Two faces that turn by less than this over their common side belong to the same facet.
    faces_least : int
        A facet of fewer faces is not split. On a curved surface two faces can lie in a plane by
        chance, and the middle of a chord is not on the surface.
    rounds : int
        In each round, sides that are too long are halved.
    growth_most, vertices_enough : int
        No round begins with more vertices than this many times the given ones, and this many.
    """

    turn_most_deg: float = 0.02
    faces_least: int = 6
    rounds: int = 8
    growth_most: int = 2
    vertices_enough: int = 20_000


SETTINGS = RefinementSettings()


def with_flat_facets_split(vertices: Floats, faces: Ints, longest: float) -> tuple[Floats, Ints]:
    """The mesh with the sides longer than ``longest`` split where they lie inside flat facets.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Welded and consistently wound.
    longest : float
        In the coordinates' unit.

    Returns
    -------
    vertices : (k, 3) float64
        The given ones first, then the middles of sides. No point of the surface moves.
    faces : (l, 3) int64
        Neighbours share every new vertex, so a closed mesh stays closed.

    Examples
    --------
    >>> turn = np.linspace(0.0, 2 * np.pi, 7)[:6]
    >>> rim = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    >>> hexagon = np.concatenate([rim, np.zeros((1, 3))])
    >>> fan = np.array([[k, (k + 1) % 6, 6] for k in range(6)])
    >>> [len(part) for part in with_flat_facets_split(hexagon, fan, 0.9)]
    [13, 18]
    """
    enough = max(SETTINGS.vertices_enough, SETTINGS.growth_most * len(vertices))
    for _ in range(SETTINGS.rounds):
        if len(vertices) > enough:
            break
        side, pairs, flat = _sides(vertices, faces)
        length = np.linalg.norm(vertices[pairs[:, 1]] - vertices[pairs[:, 0]], axis=1)
        chosen = flat & (length > longest)
        if not chosen.any():
            break
        middle = np.where(chosen, len(vertices) - 1 + np.cumsum(chosen), -1)[side]
        vertices = np.concatenate([vertices, vertices[pairs[chosen]].mean(axis=1)])
        faces = _split(vertices, faces, middle)
    return vertices, faces


def _sides(vertices: Floats, faces: Ints) -> tuple[Ints, Ints, Bools]:
    """The side's number of each half-edge (m, 3), each side's ends (k, 2), and whether it is flat.

    A side is flat where it lies inside a facet of enough faces.
    """
    order, first, count = edge_groups(faces)
    side = np.empty(len(order), dtype=np.int64)
    side[order] = np.repeat(np.arange(len(first)), count)
    pairs = np.stack([order[first], order[np.minimum(first + 1, len(order) - 1)]], axis=1) // 3
    normals = face_normals(vertices, faces)[pairs]
    along = row_dots(normals[:, 0], normals[:, 1])
    flat = (count == 2) & (along > np.cos(np.radians(SETTINGS.turn_most_deg)))
    facet = lowest_connected(pairs[flat], len(faces))
    members = np.bincount(facet, minlength=len(faces))[facet]
    flat &= members[pairs[:, 0]] >= SETTINGS.faces_least
    return side.reshape(-1, 3), half_edges(faces)[order[first]], flat


def _split(vertices: Floats, faces: Ints, middle: Ints) -> Ints:
    """The faces, cut at the new vertices (m, 3) in the middle of sides; -1 is a whole side."""
    count = (middle >= 0).sum(axis=1)
    # Turn each face: a lone split side comes first, a lone whole side comes last.
    lone = np.where(count[:, None] == 1, middle >= 0, middle < 0)
    turn = np.argmax(lone, axis=1) + (count == 2)
    places = (turn[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(faces, places, axis=1).T
    p, q, r = np.take_along_axis(middle, places, axis=1).T  # on ab, bc, ca
    cuts = vertices[a] - vertices[q], vertices[p] - vertices[c]
    shorter = np.less_equal(*(np.linalg.norm(cut, axis=1) for cut in cuts))
    parts = (
        (count == 0, ((a, b, c),)),
        (count == 1, ((a, p, c), (p, b, c))),
        ((count == 2) & shorter, ((p, b, q), (a, p, q), (a, q, c))),
        ((count == 2) & ~shorter, ((p, b, q), (a, p, c), (p, q, c))),
        (count == 3, ((a, p, r), (p, b, q), (r, q, c), (p, q, r))),
    )
    pieces = [
        np.stack(corners, axis=1)[chosen] for chosen, triangles in parts for corners in triangles
    ]
    return np.concatenate(pieces)
