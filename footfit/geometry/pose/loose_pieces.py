"""Which pieces of a surface of any kind belong to it: specks and floor plates do not."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct
from footfit.geometry.pose.floor_plate import plate_pieces
from footfit.geometry.pose.pieces import PIECES

_FARTHEST = 2**19  # cells from the largest piece; everything farther counts as this far
_PACKING = np.array([1, 2**21, 2**42])


@dataclass(frozen=True, slots=True)
class KeptPieces:
    """Which faces (m,) stay, and how much goes.

    ``plates`` and ``specks`` count the pieces that go, ``specks_share`` is the specks' share of
    the area. ``loose`` counts the pieces that stay because the specks are too much to be debris,
    0 for a sound surface.
    """

    faces: Bools
    plates: int = 0
    specks: int = 0
    specks_share: float = 0.0
    loose: int = 0


def kept_pieces(vertices: Floats, faces: Ints, labels: Ints, face_areas: Floats) -> KeptPieces:
    """The pieces of the surface without specks, and without a floor plate of its own.

    Two pieces of comparable size both stay. Whether they are two feet is asked later.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Welded.
    labels : (m,) int64
        The piece of each face, from ``face_components``.
    face_areas : (m,) float64

    Raises
    ------
    DamagedMesh
        The surface falls into more than ``most_pieces`` pieces that are no specks.
    """
    areas = np.bincount(labels, weights=face_areas).astype(np.float64)
    if len(areas) == 1:
        return KeptPieces(np.ones(len(faces), dtype=bool))
    plates = plate_pieces(vertices, faces, labels, areas)
    rest = np.where(plates, 0.0, areas)
    matter = _mattering(vertices, faces, labels, rest)
    specks = ~matter & ~plates
    loose = 0
    if rest[specks].sum() > PIECES.specks * rest.sum():
        if len(areas) > PIECES.most_specks:
            raise DamagedMesh(_in_pieces(len(areas)))
        specks &= ~_reached(vertices, faces, labels, matter)
        loose = int((~specks & ~plates).sum())
    if (~specks).sum() > PIECES.most_pieces:
        raise DamagedMesh(_in_pieces(int((~specks).sum())))
    share = float(rest[specks].sum() / rest.sum())
    kept = ~(specks | plates)[labels]
    return KeptPieces(kept, int(plates.sum()), int(specks.sum()), share, loose)


def _in_pieces(count: int) -> str:
    return (
        f"the surface is in {count:,} pieces that touch nowhere: merge its vertices, or export the"
        " scan again as one surface"
    )


def _mattering(vertices: Floats, faces: Ints, labels: Ints, areas: Floats) -> Bools:
    """Which pieces are big enough, or big enough and near enough to the largest, (k,)."""
    largest = int(np.argmax(areas))
    low, high = _boxes(vertices, faces, labels)
    gap = PIECES.patch_gap * float(np.linalg.norm(high[largest] - low[largest]))
    near = ((low <= high[largest] + gap) & (high >= low[largest] - gap)).all(axis=1)
    share = areas / areas[largest] if areas[largest] > 0.0 else np.ones(len(areas))
    big, patch = share >= PIECES.large, share >= PIECES.patch
    return np.asarray(big | (near & patch))


def _reached(vertices: Floats, faces: Ints, labels: Ints, matter: Bools) -> Bools:
    """Which pieces lie near one that matters, or near one that is reached already, (k,).

    Near means in the same cell of space, or in the cell beside it. A crack is narrower than a cell,
    and a speck is farther away than two.
    """
    low, high = _boxes(vertices, faces, labels)
    largest = int(np.argmax(np.bincount(labels, minlength=len(matter)) * matter))
    cell = PIECES.patch_gap * float(np.linalg.norm(high[largest] - low[largest]))
    corners = vertices[faces]
    places = np.concatenate([corners, 0.5 * (corners + corners[:, [1, 2, 0]])], axis=1)
    cells = np.floor((places - low[largest]) / cell)
    packed = np.clip(cells, -_FARTHEST, _FARTHEST).astype(np.int64) @ _PACKING
    steps = np.array(list(product((-1, 0, 1), repeat=3))) @ _PACKING
    reached = matter.copy()
    fresh = matter
    while fresh.any():
        around = distinct(distinct(packed[fresh[labels]])[:, None] + steps)
        touched = np.zeros_like(matter)
        touched[labels[np.isin(packed, around).any(axis=1)]] = True
        fresh = touched & ~reached
        reached |= fresh
    return reached


def _boxes(vertices: Floats, faces: Ints, labels: Ints) -> tuple[Floats, Floats]:
    """The lowest and highest corner of each piece's box, (k, 3) each."""
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order], prepend=-1))
    corners = vertices[faces[order]]
    low = np.minimum.reduceat(corners.min(axis=1), starts, axis=0)
    high = np.maximum.reduceat(corners.max(axis=1), starts, axis=0)
    return low, high
