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

    Areas are over that of the largest piece, distances over its size, if nothing else is said.
    """

    large: float = 0.10  # in any surface, a piece of this area stays wherever it lies
    patch: float = 0.005  # so does one of this area if its box is near: of a cracked scan
    patch_gap: float = 0.02  # so near, over the diagonal
    specks: float = 0.10  # of the whole area: if all specks hold more, the scan is in pieces
    most_pieces: int = 100  # more pieces that stay are not a surface
    most_specks: int = 1000  # nor are more pieces than this in all, if the scan is in pieces
    speck: float = 0.01  # a foot or last is looked for among the pieces from this area on
    comparable: float = 0.25  # from this area on a piece may be a foot of its own
    most_comparable: int = 8  # so many are looked at one by one
    apart: float = 0.25  # between the boxes' middles: more, and two pieces stand side by side
    gap: float = 0.06  # a piece farther off is something else than the foot
    gap_few: int = 150  # points of the other piece that the gap is measured with
    gap_many: int = 1500  # and points of the foot
    inside_out: float = 0.20  # faces that look outward by less than this may be inside out
    own_centre: float = 0.10  # a smaller open patch is judged from the middle of the whole
    wide_open: float = 0.30  # an opening wider than this is named when a shape is refused
    sheet: float = 0.40  # |sum of area vectors| over the area; a foot cut at the leg has 0.1
    hinged: float = 0.06  # so much more may pieces cost together than the largest of them alone
    hinged_beside: float = 0.12  # and if one goes on where another ends, as at the hinge of a boot
    closed: float = 1e-9  # by the same ratio, a surface with a wide opening has more
    shell: float = 0.20  # from here on, by the same ratio, a foot may lack its sole
    flat_shell: float = 0.60  # the most that a foot without sole has; a sheet has more
    soleless_last: float = 0.34  # the most that a last without sole costs; feet cost .36-.46
    lidded_last: float = 0.46  # and with a lid for its sole: lasts cost .32-.45, feet .39-.49
    upward: float = 0.80  # cosine with Z of where the faces of such a foot look on the whole


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


def comparable_pieces(parts: list[Piece]) -> list[Piece]:
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
    if len(parts) == 1:
        return parts
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
