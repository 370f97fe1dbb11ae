"""What a scan holds besides one whole foot: several pieces, inside-out faces, a mere sheet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.surface import area_vectors, face_areas, unit
from footfit.geometry.mesh.topology import face_components
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class PiecesSettings:
    """Everything numeric of the pieces."""

    comparable: float = 0.25  # of the largest piece's area
    speck: float = 0.01
    most: int = 8  # comparable pieces that are looked at one by one
    apart: float = 0.25  # of the larger piece's size, between the middles of their boxes
    gap: float = 0.06  # of the largest piece's size: what is farther off is something else
    gap_few: int = 150
    gap_many: int = 1500
    inside_out: float = 0.20
    wide_open: float = 0.30  # of the size: a loop that is worth a word
    sheet: float = 0.40  # |sum of area vectors| over the area; a foot cut at the leg has .1
    shell: float = 0.20  # from here on a foot may lack its sole
    flat_shell: float = 0.60  # the most that a foot without sole has; a sheet has more
    upward: float = 0.80  # cosine with Z of where the faces of such a foot look on the whole


PIECES = PiecesSettings()


def pieces(vertices: Floats, faces: Ints, settings: PiecesSettings = PIECES) -> list[Ints]:
    """The faces of each connected piece that is no speck, largest area first."""
    label = face_components(faces, len(vertices))
    area = np.bincount(label, weights=face_areas(vertices, faces))
    order = np.argsort(-area, kind="stable")
    large = [piece for piece in order if area[piece] >= settings.speck * area[order[0]]]
    return [np.flatnonzero(label == piece) for piece in large]


def comparable(
    vertices: Floats, faces: Ints, found: list[Ints], settings: PiecesSettings = PIECES
) -> list[Ints]:
    """Of the pieces (largest first), those of an area comparable with the largest."""
    if len(found) == 1:
        return found
    areas = [float(face_areas(vertices, faces[piece]).sum()) for piece in found]
    return [
        piece
        for piece, area in zip(found, areas, strict=True)
        if area >= settings.comparable * areas[0]
    ]


def stand_apart(first: Floats, second: Floats, settings: PiecesSettings = PIECES) -> bool:
    """Whether pieces of points (n, 3), (k, 3) are beside each other, not one inside the other."""
    boxes = [(points.min(axis=0), points.max(axis=0)) for points in (first, second)]
    middles = [(low + high) / 2 for low, high in boxes]
    size = max(float((high - low).max()) for low, high in boxes)
    return float(np.linalg.norm(middles[0] - middles[1])) > settings.apart * size


def gap(first: Floats, second: Floats, settings: PiecesSettings = PIECES) -> float:
    """The distance between two pieces' points (n, 3) and (k, 3), about: by a sample of each."""
    few, many = (
        points[:: max(1, len(points) // count)]
        for points, count in ((second, settings.gap_few), (first, settings.gap_many))
    )
    squares = ((few[:, None, :] - many[None, :, :]) ** 2).sum(axis=2)
    return float(np.sqrt(squares.min()))


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
    areas = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    away = vertices[faces].mean(axis=1)
    away -= areas @ away / areas.sum()
    distance = float(areas @ np.sqrt(np.einsum("ij,ij->i", away, away)))
    outward = float(np.einsum("ij,ij->", away, vectors))
    total = vectors.sum(axis=0)
    return Facing(
        outward=outward / distance if distance > 0.0 else 0.0,  # one face has no middle to leave
        one_way=float(np.linalg.norm(total) / areas.sum()),
        toward=unit(total[None])[0],
    )


def lacks_its_sole(
    toward: Floats, one_way: float, up: Floats, settings: PiecesSettings = PIECES
) -> bool:
    """Whether faces that look ``toward`` on the whole are a foot's without the sole.

    Area vectors of a closed surface add up to nothing: what is missing is what they add up to,
    turned over. A missing sole leaves them looking up (3,); a sole alone looks down.
    """
    within = settings.shell < one_way < settings.flat_shell
    return within and float(toward @ up) > settings.upward


def part_of(vertices: Floats, faces: Ints, kept: Ints | Bools) -> tuple[Floats, Ints]:
    """The mesh of some of the faces, without the vertices that no face uses."""
    vertices, faces, _ = without_unused_vertices(vertices, faces[kept])
    return vertices, faces
