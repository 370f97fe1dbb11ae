"""How a foot is laid into a last: heel to heel, tread on tread, toes on the toe spring.

Both shapes are canonical right ones in mm. A foot was scanned flat, a last is pitched: the
seat-to-ball chord of the last's bottom is followed by turning the whole foot about Y, and what the
bottom rises ahead of the tread by bending the foot at its tread, as it bends in a shoe.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.errors import NoSole
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.sections import depth_at, extremes_below, lowest, sections_across
from footfit.geometry.mesh.surface import face_areas
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.quantiles import area_quantile


@dataclass(frozen=True, slots=True)
class DockingSettings:
    """Where foot and last are brought together, over the foot's length.

    ``band`` over a section's lowest point is its sole; ``places`` over the sole's width are where
    its height is read; ``hinge`` is how far ahead of the tread the bend is complete.
    """

    seat: tuple[float, float] = (0.06, 0.16)
    tread: tuple[float, float] = (0.60, 0.70)
    toes: tuple[float, float] = (0.86, 0.92)
    sections: int = 7
    band: float = 0.10
    places: tuple[float, ...] = (0.35, 0.50, 0.65)
    heel_share: float = 0.003
    heel_height: float = 0.20
    hinge: float = 0.12
    most_bend_deg: float = 25.0
    rounds: int = 4


DOCKING = DockingSettings()


@dataclass(frozen=True, slots=True)
class Docking:
    """The way a foot moves into a last: it is bent ahead of a hinge, then turned and shifted.

    ``bend_deg`` (+ is toes up) turns what lies ahead of ``hinge_mm`` (2,), the x and z of the
    tread's front in the foot's own frame, growing over ``hinge_length_mm``. ``pitch_deg`` (about
    Y, + is toes up) and then ``yaw_deg`` (about Z, + to medial) turn the foot about the origin;
    ``shift_mm`` (3,) follows. ``swing_mm`` is how far the foot's tread had to go to medial to lie
    on the last's, heel on heel: how far the two axes part at the ball.
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
    """Where a stretch of a sole lies: its mean x, the middle of its width, its mean height."""

    x: float
    y: float
    z: float


def docking(foot: Shape, last: Shape, settings: DockingSettings = DOCKING) -> Docking:
    """How ``foot`` is to be moved so that it lies in ``last``.

    Raises
    ------
    NoSole
        One of the two has no bottom where it would rest.
    """
    length = foot.length_mm
    hinge_x = foot.x_mm(settings.tread[1])
    hinge = _rest(foot, (hinge_x - 0.01 * length, hinge_x), length, settings)
    if hinge is None:
        raise NoSole("the foot's sole is open at the tread: it cannot be laid into a last")
    found = Docking(np.array([hinge_x, hinge.z]), settings.hinge * length)
    for _ in range(settings.rounds):
        found = _closer(foot, last, found, settings)
    return found


def docked(vertices_mm: Floats, way: Docking) -> Floats:
    """The vertices (n, 3) of a foot where a docking puts them."""
    x, y, z = vertices_mm.T
    ahead = np.clip((x - way.hinge_mm[0]) / way.hinge_length_mm, 0.0, 1.0)
    angle = np.radians(way.bend_deg) * ahead * ahead * (3.0 - 2.0 * ahead)
    dx, dz = x - way.hinge_mm[0], z - way.hinge_mm[1]
    c, s = np.cos(angle) - 1.0, np.sin(angle)  # minus 1: no bend moves nothing, to the last bit
    x, z = x + c * dx - s * dz, z + s * dx + c * dz
    c, s = np.cos(np.radians(way.pitch_deg)), np.sin(np.radians(way.pitch_deg))
    x, z = c * x - s * z, s * x + c * z
    c, s = np.cos(np.radians(way.yaw_deg)), np.sin(np.radians(way.yaw_deg))
    x, y = c * x - s * y, s * x + c * y
    moved: Floats = np.column_stack([x, y, z]) + np.array(way.shift_mm)
    return moved


def _closer(foot: Shape, last: Shape, way: Docking, settings: DockingSettings) -> Docking:
    """One round: where the moved foot rests now, against where the last would have it."""
    moved = Shape(docked(foot.vertices_mm, way), foot.low, foot.kind)
    length, back = foot.length_mm, _heel_back(moved, foot.length_mm, settings)
    theirs = Shape(last.vertices_mm, last.low, last.kind)
    here, there = (_rests(one, back, length, settings) for one in (moved, theirs))
    if here[0] is None or here[1] is None or there[0] is None or there[1] is None:
        raise NoSole("foot and last share no bottom to rest on: the last is far too short, or open")
    seat, tread, to_seat, to_tread = here[0], here[1], there[0], there[1]
    reach = tread.x - seat.x
    pitch = np.arctan2((to_tread.z - to_seat.z) - (tread.z - seat.z), reach)
    turn = np.arctan2((to_tread.y - to_seat.y) - (tread.y - seat.y), reach)
    bend_deg = way.bend_deg
    if here[2] is not None and there[2] is not None:
        ahead = here[2].x - tread.x
        rise = (there[2].z - to_tread.z) - (here[2].z - tread.z) - np.tan(pitch) * ahead
        hinge = back + settings.tread[1] * length
        bend_deg += float(np.degrees(np.arctan2(rise, here[2].x - hinge)))
    yaw_deg = way.yaw_deg + float(np.degrees(turn))
    turned = replace(
        way,
        bend_deg=float(np.clip(bend_deg, -settings.most_bend_deg, settings.most_bend_deg)),
        pitch_deg=way.pitch_deg + float(np.degrees(pitch)),
        yaw_deg=yaw_deg,
        swing_mm=float(np.tan(np.radians(yaw_deg))) * (tread.x - back),
    )
    return _shifted(foot, theirs, turned, settings)


def _shifted(foot: Shape, last: Shape, way: Docking, settings: DockingSettings) -> Docking:
    """The same turns with the shift that lays heel on heel and seat on seat."""
    length = foot.length_mm
    moved = Shape(docked(foot.vertices_mm, way), foot.low, foot.kind)
    back = _heel_back(moved, length, settings)
    forward = _heel_back(last, length, settings) - back
    start, end = settings.seat
    here = _rest(moved, (back + start * length, back + end * length), length, settings)
    back += forward
    there = _rest(last, (back + start * length, back + end * length), length, settings)
    if here is None or there is None:
        raise NoSole("foot and last share no seat to rest on: the heel of one of them is open")
    step = (forward, there.y - here.y, there.z - here.z)
    x, y, z = (float(old + more) for old, more in zip(way.shift_mm, step, strict=True))
    return replace(way, shift_mm=(x, y, z))


def _heel_back(shape: Shape, length_mm: float, settings: DockingSettings) -> float:
    """Where a heel's back is along X: the quantile that docks a shape in its frame."""
    middles = shape.vertices_mm[shape.faces].mean(axis=1)
    ground = float(middles[:, 2].min())
    low = middles[:, 2] - ground < settings.heel_height * length_mm
    areas = face_areas(shape.vertices_mm, shape.faces[low])
    return area_quantile(middles[low, 0], areas, settings.heel_share)


def _rests(
    shape: Shape, back_mm: float, length_mm: float, settings: DockingSettings
) -> list[_Rest | None]:
    """Seat, tread and toes of a shape, at places counted from ``back_mm``."""
    return [
        _rest(shape, (back_mm + start * length_mm, back_mm + end * length_mm), length_mm, settings)
        for start, end in (settings.seat, settings.tread, settings.toes)
    ]


def _rest(
    shape: Shape, window_mm: tuple[float, float], length_mm: float, settings: DockingSettings
) -> _Rest | None:
    """Where a sole lies between two places along X; None where there is none."""
    x = np.linspace(*window_mm, settings.sections)
    segments = sections_across(shape.vertices_mm, shape.faces, x)
    y, z = segments.points[:, :, 1], segments.points[:, :, 2]
    floor = lowest(z, segments)
    lateral, medial = extremes_below(y, z, floor + settings.band * length_mm, segments)
    depths = [
        depth_at(lateral + place * (medial - lateral), y, z, segments)[0]
        for place in settings.places
    ]
    middle, height = 0.5 * (lateral + medial), np.mean(depths, axis=0)
    height = np.where(height <= floor + settings.band * length_mm, height, floor)  # an open sole
    if not np.isfinite(middle).all():
        return None
    return _Rest(float(x.mean()), float(middle.mean()), float(height.mean()))
