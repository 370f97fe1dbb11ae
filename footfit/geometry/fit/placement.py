"""How a foot is placed in a last: heel to heel, tread on tread, toes on the toe spring.

Both shapes are canonical right ones in mm. A foot is scanned flat, and a last is pitched. So the
whole foot is turned about Y until it follows the chord of the last's bottom from seat to ball. In
front of the tread the bottom rises, and the foot is bent there, as it bends in a shoe.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.errors import NoSole
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.sections import sections_across, soles
from footfit.geometry.mesh.surface import face_areas
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.quantiles import area_quantile
from footfit.geometry.pose.frame import FRAME


@dataclass(frozen=True, slots=True)
class PlacementSettings:
    """Where foot and last are brought together, over the foot's length.

    What lies up to ``band`` over a section's lowest point is its sole. ``places`` over the sole's
    width are where its height is read; under the toes its lowest point counts, because between two
    toes there is no sole. ``hinge`` is how far in front of the tread the bend is complete.
    """

    seat: tuple[float, float] = (0.06, 0.16)
    tread: tuple[float, float] = (0.60, 0.70)
    toes: tuple[float, float] = (0.86, 0.92)
    sections: int = 7
    band: float = 0.10
    places: tuple[float, ...] = (0.35, 0.50, 0.65)
    hinge: float = 0.12
    most_bend_deg: float = 25.0
    rounds: int = 4


PLACEMENT = PlacementSettings()


@dataclass(frozen=True, slots=True)
class Placement:
    """How a foot moves into a last: it is bent in front of a hinge, then turned and shifted.

    ``bend_deg`` (+ is toes up) turns what lies in front of ``hinge_mm`` (2,), the x and z of the
    tread's front in the foot's own frame; it grows over ``hinge_length_mm``. ``pitch_deg`` (about
    Y, + is toes up) and then ``yaw_deg`` (about Z, + to medial) turn the foot about the origin.
    ``shift_mm`` (3,) comes last. ``swing_mm`` is how far the foot's tread moves to medial to lie on
    the last's with heel on heel: how far the two axes are apart at the ball.
    """

    hinge_mm: Floats
    hinge_length_mm: float
    bend_deg: float = 0.0
    pitch_deg: float = 0.0
    yaw_deg: float = 0.0
    swing_mm: float = 0.0
    shift_mm: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class _Rest:
    """Where a part of a sole lies: its mean x, the middle of its width, its mean height, mm."""

    x: float
    y: float
    z: float


def placement(foot: Shape, last: Shape) -> Placement:
    """The movement that puts ``foot`` into ``last``.

    Raises
    ------
    NoSole
        One of the two has no bottom where it would rest.
    """
    length_mm, front = foot.length_mm, PLACEMENT.tread[1]
    hinge = _rest(foot, (front - 0.01, front), foot.x_mm(0.0), length_mm)
    if hinge is None:
        raise NoSole("the foot's sole is open at the tread, so it cannot be placed in a last")
    start = np.array([foot.x_mm(front), hinge.z])
    place = Placement(start, PLACEMENT.hinge * length_mm)
    around = Shape(last.vertices_mm, last.low, last.kind)
    for _ in range(PLACEMENT.rounds):
        place = _shifted(foot, around, _turned(foot, around, place))
    return place


def placed(vertices_mm: Floats, place: Placement) -> Floats:
    """The vertices (n, 3) of a foot where a placement puts them."""
    x, y, z = vertices_mm.T
    ahead = np.clip((x - place.hinge_mm[0]) / place.hinge_length_mm, 0.0, 1.0)
    angle = np.radians(place.bend_deg) * ahead * ahead * (3.0 - 2.0 * ahead)
    dx, dz = x - place.hinge_mm[0], z - place.hinge_mm[1]
    c, s = np.cos(angle) - 1.0, np.sin(angle)  # minus 1: no bend moves nothing, to the last bit
    x, z = x + c * dx - s * dz, z + s * dx + c * dz
    c, s = np.cos(np.radians(place.pitch_deg)), np.sin(np.radians(place.pitch_deg))
    x, z = c * x - s * z, s * x + c * z
    c, s = np.cos(np.radians(place.yaw_deg)), np.sin(np.radians(place.yaw_deg))
    x, y = c * x - s * y, s * x + c * y
    moved: Floats = np.column_stack([x, y, z]) + np.array(place.shift_mm)
    return moved


def _moved(foot: Shape, place: Placement) -> tuple[Shape, float]:
    """A foot without its leg where a placement puts it, and where its heel's back then is."""
    moved = Shape(placed(foot.vertices_mm, place), foot.low, foot.kind)
    return moved, _heel_back(moved, foot.length_mm)


def _turned(foot: Shape, last: Shape, place: Placement) -> Placement:
    """The placement with bend, pitch and yaw that bring seat, tread and toes to the last's."""
    length_mm = foot.length_mm
    moved, back = _moved(foot, place)
    windows = (PLACEMENT.seat, PLACEMENT.tread)
    seat, tread = (_rest(moved, w, back, length_mm) for w in windows)
    to_seat, to_tread = (_rest(last, w, back, length_mm) for w in windows)
    toes, to_toes = (
        _rest(shape, PLACEMENT.toes, back, length_mm, lowest=True) for shape in (moved, last)
    )
    if seat is None or tread is None or to_seat is None or to_tread is None:
        raise NoSole("foot and last share no bottom to rest on: the last is far too short, or open")
    reach = tread.x - seat.x
    pitch = np.arctan2((to_tread.z - to_seat.z) - (tread.z - seat.z), reach)
    turn = np.arctan2((to_tread.y - to_seat.y) - (tread.y - seat.y), reach)
    bend_deg = place.bend_deg
    if toes is not None and to_toes is not None:
        rise = (to_toes.z - to_tread.z) - (toes.z - tread.z) - np.tan(pitch) * (toes.x - tread.x)
        hinge = back + PLACEMENT.tread[1] * length_mm
        bend_deg += float(np.degrees(np.arctan2(rise, toes.x - hinge)))
    yaw_deg = place.yaw_deg + float(np.degrees(turn))
    return replace(
        place,
        bend_deg=float(np.clip(bend_deg, -PLACEMENT.most_bend_deg, PLACEMENT.most_bend_deg)),
        pitch_deg=place.pitch_deg + float(np.degrees(pitch)),
        yaw_deg=yaw_deg,
        swing_mm=float(np.tan(np.radians(yaw_deg))) * (tread.x - back),
    )


def _shifted(foot: Shape, last: Shape, place: Placement) -> Placement:
    """The same turns with the shift that puts heel on heel and seat on seat."""
    moved, back = _moved(foot, place)
    to_back = _heel_back(last, foot.length_mm)
    seat = _rest(moved, PLACEMENT.seat, back, foot.length_mm)
    to_seat = _rest(last, PLACEMENT.seat, to_back, foot.length_mm)
    if seat is None or to_seat is None:
        raise NoSole("foot and last share no seat to rest on: the heel of one of them is open")
    step = (to_back - back, to_seat.y - seat.y, to_seat.z - seat.z)
    x, y, z = (float(old + more) for old, more in zip(place.shift_mm, step, strict=True))
    return replace(place, shift_mm=(x, y, z))


def _heel_back(shape: Shape, length_mm: float) -> float:
    """Where a heel's back is along X: the quantile that puts the origin of a shape's frame."""
    middles = shape.vertices_mm[shape.faces].mean(axis=1)
    ground = float(middles[:, 2].min())
    low = middles[:, 2] - ground < FRAME.origin_height * length_mm
    areas = face_areas(shape.vertices_mm, shape.faces[low])
    return area_quantile(middles[low, 0], areas, FRAME.origin_share)


def _rest(
    shape: Shape,
    window: tuple[float, float],
    start_mm: float,
    length_mm: float,
    lowest: bool = False,
) -> _Rest | None:
    """Where a sole lies in a window, in shares of a length from ``start_mm`` along X; None if there
    is no sole. With ``lowest`` its height is that of its lowest points.
    """
    x = start_mm + np.linspace(*window, PLACEMENT.sections) * length_mm
    segments = sections_across(shape.vertices_mm, shape.faces, x)
    sole = soles(segments, PLACEMENT.band * length_mm, PLACEMENT.places)
    middle, height = 0.5 * (sole.lateral + sole.medial), sole.depth.mean(axis=0)
    read = (height <= sole.limit) & (not lowest)  # else it is an open sole
    height = np.where(read, height, sole.floor)
    if not np.isfinite(middle).all():
        return None
    return _Rest(float(x.mean()), float(middle.mean()), float(height.mean()))
