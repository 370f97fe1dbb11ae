"""The pieces of a scan: the numbers that say what belongs to a shape, and how pieces lie."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import face_areas
from footfit.geometry.mesh.topology import face_components
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class PieceSettings:
    """What of a scan belongs to the foot or last: every number of the preparation.

    A share is one of the largest piece's area, a distance one of its size, where nothing else is
    said.

    Attributes
    ----------
    large : float
        In a surface of any kind a piece with this share stays, wherever it lies.
    patch, patch_gap : float
        A smaller piece stays from this share on if its box comes within ``patch_gap`` (of the
        diagonal) of the largest piece's box: it is a patch of a cracked scan.
    specks : float
        Where all specks together hold more than this share of the whole area, the scan is in
        pieces: then only what stands off by ``patch_gap`` from all that stays is removed.
    most_pieces, most_specks : int
        More pieces than this that stay are not a surface. More pieces than ``most_specks`` are
        not one either, where the specks hold more than ``specks``.
    speck : float
        A foot or last is looked for among the pieces from this share on.
    comparable, most_comparable : float, int
        From this share on a piece may be a foot of its own; so many are looked at one by one.
    apart : float
        Two pieces stand beside each other if the middles of their boxes are farther apart.
    gap : float
        A piece farther off than this is something else than the foot.
    gap_few, gap_many : int
        How many points of the other piece and of the foot the gap is measured with.
    inside_out : float
        Faces that look outward by less than this, or inward, may be inside out.
    own_centre : float
        Outside is judged from a piece's own middle from this share on; a smaller open patch is
        judged from the whole's.
    wide_open : float
        An opening wider than this is named when a shape is refused.
    sheet : float
        The length of the sum of the area vectors over the area: a sheet has more. A foot that is
        cut at the leg has 0.1.
    shell, flat_shell : float
        Between these two, by the same ratio, a foot may lack its sole.
    upward : float
        The least cosine with Z of where the faces of such a foot look on the whole.
    """

    large: float = 0.10
    patch: float = 0.005
    patch_gap: float = 0.02
    specks: float = 0.10
    most_pieces: int = 100
    most_specks: int = 1000
    speck: float = 0.01
    comparable: float = 0.25
    most_comparable: int = 8
    apart: float = 0.25
    gap: float = 0.06
    gap_few: int = 150
    gap_many: int = 1500
    inside_out: float = 0.20
    own_centre: float = 0.10
    wide_open: float = 0.30
    sheet: float = 0.40
    shell: float = 0.20
    flat_shell: float = 0.60
    upward: float = 0.80


PIECES = PieceSettings()


@dataclass(frozen=True, slots=True)
class Piece:
    """A connected part of a mesh, as a mesh of its own; ``rows`` (m,) are its faces in the whole.

    ``area`` is in the vertices' unit squared.
    """

    rows: Ints
    vertices: Floats
    faces: Ints
    area: float


def pieces(vertices: Floats, faces: Ints) -> list[Piece]:
    """The connected pieces that are no specks, largest area first."""
    label = face_components(faces, len(vertices))
    area = np.bincount(label, weights=face_areas(vertices, faces))
    order = np.argsort(-area, kind="stable")
    large = [number for number in order if area[number] >= PIECES.speck * area[order[0]]]
    rows = [np.flatnonzero(label == number) for number in large]
    return [
        Piece(row, *part_of(vertices, faces, row), float(area[number]))
        for row, number in zip(rows, large, strict=True)
    ]


def comparable(parts: list[Piece]) -> list[Piece]:
    """Of the pieces (largest first), those of an area comparable with the largest."""
    return [part for part in parts if part.area >= PIECES.comparable * parts[0].area]


def stand_apart(first: Floats, second: Floats) -> bool:
    """Whether pieces of points (n, 3), (k, 3) are beside each other, not one inside the other."""
    boxes = [(points.min(axis=0), points.max(axis=0)) for points in (first, second)]
    middles = [(low + high) / 2 for low, high in boxes]
    size = max(float((high - low).max()) for low, high in boxes)
    return float(np.linalg.norm(middles[0] - middles[1])) > PIECES.apart * size


def near_pieces(parts: list[Piece], points: Floats) -> list[Piece]:
    """The pieces that come close to points (n, 3) of a shape, itself among them."""
    size = float(np.ptp(points, axis=0).max())
    return [part for part in parts if gap(points, part.vertices) < PIECES.gap * size]


def gap(first: Floats, second: Floats) -> float:
    """The distance between two pieces' points (n, 3) and (k, 3), about: by a sample of each."""
    few, many = (
        points[:: max(1, len(points) // count)]
        for points, count in ((second, PIECES.gap_few), (first, PIECES.gap_many))
    )
    squares = ((few[:, None, :] - many[None, :, :]) ** 2).sum(axis=2)
    return float(np.sqrt(squares.min()))


def part_of(vertices: Floats, faces: Ints, kept: Ints | Bools) -> tuple[Floats, Ints]:
    """The mesh of some of the faces, without the vertices that no face uses."""
    vertices, faces, _ = without_unused_vertices(vertices, faces[kept])
    return vertices, faces
