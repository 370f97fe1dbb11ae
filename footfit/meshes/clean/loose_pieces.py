"""The pieces of a scan: what is the foot, what is dust, what is the floor."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from footfit.errors import DamagedMesh
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.meshes.clean.extents import principal_extents
from footfit.results import Notice


@dataclass(frozen=True, slots=True)
class PieceSettings:
    """What stays and what goes.

    Attributes
    ----------
    kept_share : float
        A piece with this share of the largest piece's area stays, wherever it lies.
    near_share, near_gap : float
        A smaller piece stays from this share on if its box comes within ``near_gap`` (of the
        largest piece's diagonal) of the largest piece's box: a patch of a cracked scan.
    dust_share : float
        Where all that would go holds more than this share of the whole area, it is no dust: the
        scan is in pieces, and only what stands off by ``near_gap`` from all that stays goes.
    plate_thickness : float
        A plate is thinner than this, relative to its longest extent; a foot is thicker than
        ``foot_thickness``.
    plate_cover : float
        A plate reaches this far along both its directions, relative to the foot on it (the lid of
        a leg does not).
    plate_side, plate_sinking : float
        The share of the foot's vertices that lie on one side of the plate, those not counted that
        have sunk in by less than ``plate_sinking`` of the plate's extent: a sole is noisy.
    most_pieces : int
        More pieces than this that are no dust are not a surface.
    most_strays : int
        Nor are more than this, where they hold more than ``dust_share``.
    """

    kept_share: float = 0.10
    near_share: float = 0.005
    near_gap: float = 0.02
    dust_share: float = 0.10
    plate_thickness: float = 0.025
    foot_thickness: float = 0.12
    plate_cover: float = 0.80
    plate_side: float = 0.95
    plate_sinking: float = 0.01
    most_pieces: int = 100
    most_strays: int = 1000


PIECE_SETTINGS = PieceSettings()
_FARTHEST = 2**19  # cells from the largest piece: what lies farther is far
_PACKING = np.array([1, 2**21, 2**42])
_MOST_BIG = 16  # a scan with more pieces of comparable size is no foot on a plate


def kept_faces(
    vertices: Floats,
    faces: Ints,
    labels: Ints,
    face_areas: Floats,
    settings: PieceSettings = PIECE_SETTINGS,
) -> tuple[Bools, tuple[Notice, ...]]:
    """Which faces are the shape's, and what was taken off.

    Parameters
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Welded.
    labels : (m,) int64
        The piece of each face, from ``face_components``.
    face_areas : (m,) float64
    settings : PieceSettings

    Returns
    -------
    kept : (m,) bool
        False on dust and on a floor plate that is a piece of its own. Two pieces of comparable
        size both stay: whether they are two feet is the alignment's question.
    notices : tuple of Notice
        ``plate_removed``, ``specks_removed``, ``many_pieces``.

    Raises
    ------
    DamagedMesh
        The surface falls into more than ``most_pieces`` pieces, none of which is dust.
    """
    areas = np.bincount(labels, weights=face_areas).astype(np.float64)
    if len(areas) == 1:
        return np.ones(len(faces), dtype=bool), ()
    plates = _plates(vertices, faces, labels, areas, settings)
    rest = np.where(plates, 0.0, areas)
    matter = _mattering(vertices, faces, labels, rest, settings)
    dust = ~matter & ~plates
    notices: list[Notice] = []
    if plates.any():
        notices.append(Notice("plate_removed", "a floor plate was taken off"))
    if rest[dust].sum() > settings.dust_share * rest.sum():
        if len(areas) > settings.most_strays:
            raise DamagedMesh(_in_pieces(len(areas)))
        dust &= ~_reached(vertices, faces, labels, matter, settings)
        kept = int((~dust & ~plates).sum())
        if kept > 1:
            message = f"the surface is in {kept} pieces that touch nowhere: all are kept"
            notices.append(Notice("many_pieces", message))
    if (~dust).sum() > settings.most_pieces:
        raise DamagedMesh(_in_pieces(int((~dust).sum())))
    if dust.any():
        share = 100.0 * rest[dust].sum() / rest.sum()
        message = f"{int(dust.sum())} small loose pieces ({share:.2g} % of the area) were removed"
        notices.append(Notice("specks_removed", message))
    return ~(dust | plates)[labels], tuple(notices)


def _in_pieces(count: int) -> str:
    return (
        f"the surface is in {count:,} pieces that touch nowhere: merge its vertices, or export the"
        " scan again as one surface"
    )


def _mattering(
    vertices: Floats, faces: Ints, labels: Ints, areas: Floats, settings: PieceSettings
) -> Bools:
    """Which pieces are big enough, or big enough and near enough to the largest, (k,)."""
    largest = int(np.argmax(areas))
    low, high = _boxes(vertices, faces, labels)
    gap = settings.near_gap * float(np.linalg.norm(high[largest] - low[largest]))
    near = ((low <= high[largest] + gap) & (high >= low[largest] - gap)).all(axis=1)
    share = areas / areas[largest] if areas[largest] > 0.0 else np.ones(len(areas))
    big, patch = share >= settings.kept_share, share >= settings.near_share
    return np.asarray(big | (near & patch))


def _reached(
    vertices: Floats, faces: Ints, labels: Ints, matter: Bools, settings: PieceSettings
) -> Bools:
    """Which pieces lie near one that matters, or near one that is reached already, (k,).

    Near is by cells of space: a piece is reached where it has a point in the cell, or beside the
    cell, of a point that is. A crack is narrower than a cell, a stray stands off by more than two.
    """
    low, high = _boxes(vertices, faces, labels)
    largest = int(np.argmax(np.bincount(labels, minlength=len(matter)) * matter))
    cell = settings.near_gap * float(np.linalg.norm(high[largest] - low[largest]))
    corners = vertices[faces]
    places = np.concatenate([corners, 0.5 * (corners + corners[:, [1, 2, 0]])], axis=1)
    cells = np.floor((places - low[largest]) / cell)
    packed = np.clip(cells, -_FARTHEST, _FARTHEST).astype(np.int64) @ _PACKING
    steps = np.array(list(product((-1, 0, 1), repeat=3))) @ _PACKING
    reached = matter.copy()
    fresh = matter
    while fresh.any():
        around = np.unique(np.unique(packed[fresh[labels]])[:, None] + steps)
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


def _plates(
    vertices: Floats, faces: Ints, labels: Ints, areas: Floats, settings: PieceSettings
) -> Bools:
    """Which pieces are a flat plate that the largest thick piece stands on, (k,)."""
    plates = np.zeros(len(areas), dtype=bool)
    big = np.flatnonzero(areas >= settings.kept_share * areas.max())
    points = {piece: vertices[np.unique(faces[labels == piece])] for piece in big[:_MOST_BIG]}
    shapes = {piece: principal_extents(found) for piece, found in points.items()}
    thickness = {piece: extents[2] / extents[0] for piece, (extents, _) in shapes.items()}
    thick = [piece for piece in thickness if thickness[piece] > settings.foot_thickness]
    if not thick:
        return plates
    foot = points[max(thick, key=lambda piece: float(areas[piece]))]
    for piece, (_, axes) in shapes.items():
        if thickness[piece] < settings.plate_thickness:
            plates[piece] = _carries(points[piece], axes, foot, settings)
    return plates


def _carries(plate: Floats, axes: Floats, foot: Floats, settings: PieceSettings) -> bool:
    """Whether the foot stands on one side of the plate and within its reach."""
    centre = plate.mean(axis=0)
    on_plate, above = (plate - centre) @ axes.T, (foot - centre) @ axes.T
    covered = np.ptp(on_plate[:, :2], axis=0) >= settings.plate_cover * np.ptp(above[:, :2], axis=0)
    sunk = settings.plate_sinking * np.ptp(on_plate[:, 0])
    side = max(np.mean(above[:, 2] > -sunk), np.mean(above[:, 2] < sunk))
    return bool(covered.all() and side >= settings.plate_side)
