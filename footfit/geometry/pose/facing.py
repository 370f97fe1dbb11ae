"""Where a mesh's faces look: outward, inward, or all one way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, unit
from footfit.geometry.mesh.topology import consistent_faces, rows_differ
from footfit.geometry.numeric.arrays import Floats, Ints, row_dots, row_lengths
from footfit.geometry.pose.pieces import PIECES


@dataclass(frozen=True, slots=True)
class Facing:
    """Where a mesh's faces look.

    ``outward`` is about 1 for a convex body and -1 for one turned inside out; ``one_way`` is
    |sum of area vectors| over the area: 0 for a closed surface, 1 for a flat sheet; ``toward``
    (3,) is the direction of that sum.
    """

    outward: float
    one_way: float
    toward: Floats


def facing(vertices: Floats, faces: Ints) -> Facing:
    """Where the faces of a mesh look, on the whole."""
    vectors = area_vectors(vertices, faces)
    areas = row_lengths(vectors)
    away = (vertices[faces[:, 0]] + vertices[faces[:, 1]] + vertices[faces[:, 2]]) / 3.0
    away -= areas @ away / areas.sum()
    distance = float(areas @ row_lengths(away))
    outward = float(np.einsum("ij,ij->", away, vectors))
    total = vectors.sum(axis=0)
    return Facing(
        outward=outward / distance if distance > 0.0 else 0.0,  # of a single face it is 0 / 0
        one_way=float(np.linalg.norm(total) / areas.sum()),
        toward=unit(total[None])[0],
    )


def lacks_its_sole(looks: Facing, up: Floats) -> bool:
    """Whether the faces are those of a foot without its sole; ``up`` is (3,).

    The area vectors of a closed surface add up to zero. If the sole is missing, they add up to a
    vector that looks up; those of a sole alone look down.
    """
    within = PIECES.shell < looks.one_way < PIECES.flat_shell
    return within and float(looks.toward @ up) > PIECES.upward


def outward_faces(vertices: Floats, faces: Ints, vectors: Floats, labels: Ints) -> tuple[Ints, int]:
    """Faces that agree with their neighbours and look outward, and how many were turned over.

    The sum of A (c - g).N over a closed piece is three times its volume, whatever g is. For an open
    piece, with g its centroid, the sign still shows which way is outside.

    Parameters
    ----------
    vertices, faces : (n, 3) float64, (m, 3) int64
    vectors : (m, 3) float64
        The faces' area vectors.
    labels : (m,) int64
        The piece of each face, from ``face_components``.
    """
    turned = rows_differ(consistent_faces(faces), faces)
    signs = np.where(turned, -1.0, 1.0)
    area = row_lengths(vectors)
    centres = (vertices[faces[:, 0]] + vertices[faces[:, 1]] + vertices[faces[:, 2]]) / 3.0
    middles = _middles(centres, area, labels)
    outwardness = signs * row_dots(centres - middles[labels], vectors)
    inward = np.bincount(labels, weights=outwardness) < 0.0
    turned ^= inward[labels]
    outward = np.where(turned[:, None], faces[:, [0, 2, 1]], faces)
    return outward, int(turned.sum())


def _middles(centres: Floats, area: Floats, labels: Ints) -> Floats:
    """The centroid of each piece, for small pieces that of the whole, (k, 3)."""
    areas = np.bincount(labels, weights=area)
    moments = np.stack(
        [np.bincount(labels, weights=area * centres[:, axis]) for axis in range(3)], axis=1
    )
    middles: Floats = moments / np.where(areas > 0.0, areas, 1.0)[:, None]
    middles[areas < PIECES.own_centre * areas.max()] = moments.sum(axis=0) / areas.sum()
    return middles
