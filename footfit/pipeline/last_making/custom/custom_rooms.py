"""Room for single places of a custom last: swellings on top of what the foot asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.errors import BadOption, OutOfReach
from footfit.geometry.deform.chart import Chart
from footfit.geometry.deform.field import Bump, least_determinant
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.numeric.arrays import Bools, Floats
from footfit.number_words import signed
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.custom.custom_aims import CustomAim
from footfit.pipeline.last_making.custom.custom_field import CustomShape, limit_words
from footfit.pipeline.last_making.custom.custom_reading import tape_plane
from footfit.results import Notice, RoomPlace


@dataclass(frozen=True, slots=True)
class RoomSettings:
    """How much room a place gets, and how far that reaches; lengths over the arc's.

    Attributes
    ----------
    most_mm : float
        The most room for one place.
    radius, radius_waist : float
        How far a swelling reaches; one at the waist must not reach the joints. It ends before the
        top plane, which stays.
    near, near_tape : float
        A place is looked for so far along from its share of the arc, and from its tape's plane.
    low : float
        A place of a side lies lower over the bottom than this.
    same_joint : float
        A joint that is read farther than this from where it was is another place.
    said_mm : float
        A measure that the room brings farther than this from its target is said.
    """

    most_mm: float = 12.0
    radius: float = 0.10
    radius_waist: float = 0.065
    near: float = 0.04
    near_tape: float = 0.01
    low: float = 0.16
    same_joint: float = 0.02
    said_mm: float = 0.25


ROOM = RoomSettings()
MEDIAL, LATERAL, UP = AXES[1], -AXES[1], AXES[2]
WAIST, INSTEP = "waist_girth_least", "instep_girth_least"
ROOM_PLACES: dict[str, tuple[float | str, Floats]] = {
    "ball-medial": (0.70, MEDIAL),
    "ball-lateral": (0.63, LATERAL),
    "ball-top": (0.68, UP),
    "toe-top": (0.86, UP),
    "toe-medial": (0.86, MEDIAL),
    "toe-lateral": (0.80, LATERAL),
    "instep-top": (INSTEP, UP),
    "waist-medial": (WAIST, MEDIAL),
    "waist-lateral": (WAIST, LATERAL),
    "heel-medial": (0.12, MEDIAL),
    "heel-lateral": (0.12, LATERAL),
}
"""Where room can be given: in the plane of which tape, or about where along the arc; and towards
which side."""


def refuse_unknown(rooms_mm: Mapping[str, float]) -> None:
    """Raise BadOption if there is no such place, or if its room is too large."""
    for name, size_mm in rooms_mm.items():
        if name not in ROOM_PLACES:
            places = ", ".join(ROOM_PLACES)
            raise BadOption(f"no place is named {name!r}: room can be given at {places}")
        if not 0.0 < size_mm <= ROOM.most_mm:
            words = f"more than 0 and up to {ROOM.most_mm:g} mm, not {size_mm:g}"
            raise BadOption(f"the room at {name} must be {words}")


def room_bumps(
    base: Shape, chart: Chart, rooms_mm: Mapping[str, float], made: Shape, lying_mm: Floats
) -> tuple[Bump, ...]:
    """The swellings of the places that are given room.

    ``made`` is the changed base, and ``lying_mm`` (n, 3) are the base's vertices as they lie there:
    a place is where they are outermost.

    Raises
    ------
    OutOfReach
        The top plane reaches over the place.
    """
    standing = chart.standing(base.vertices_mm)
    along, over = chart.arc.shares(base.vertices_mm)
    kept = chart.places(standing).free == 0.0
    bumps = []
    for name, size_mm in rooms_mm.items():
        where, outward = ROOM_PLACES[name]
        if isinstance(where, str):
            near = _near_tape(made, where, lying_mm)
        else:
            near = np.abs(along - where) < ROOM.near
        near &= ((over < ROOM.low) | (outward[2] > 0.0)) & ~kept
        if not near.any():
            raise OutOfReach(f"there is no place for room at {name}: give none there")
        rows = np.flatnonzero(near)
        centre = standing[rows[np.argmax(lying_mm[rows] @ outward)]]
        away_mm = np.linalg.norm(standing[kept] - centre, axis=1).min(initial=np.inf)
        share = ROOM.radius_waist if where == WAIST else ROOM.radius
        radius_mm = min(share * chart.arc.length_mm, float(away_mm))
        bumps.append(Bump(centre, outward, radius_mm, size_mm))
    return tuple(bumps)


def _near_tape(made: Shape, girth: str, lying_mm: Floats) -> Bools:
    """Which points (n, 3) lie near the plane of a girth's tape, (n,); none if it has no girth."""
    plane = tape_plane(made, girth) if made.joints is not None else None
    if plane is None:
        return np.zeros(len(lying_mm), dtype=bool)
    off_mm = (lying_mm - plane.origin) @ plane.normal
    return np.asarray(np.abs(off_mm) < ROOM.near_tape * made.length_mm)


def with_room(base: BaseLast, shape: CustomShape, bumps: Sequence[Bump]) -> CustomShape:
    """A changed base, with room for single places on top.

    Raises
    ------
    OutOfReach
        The last would fold.
    """
    field = replace(shape.solved.field, bumps=tuple(bumps))
    moved = field.moved_points(base.shape.vertices_mm)
    least = least_determinant(field, base.shape.vertices_mm)
    roomy = replace(shape, vertices_mm=moved, least_determinant=least)
    words = limit_words(roomy)
    if words is not None:
        raise OutOfReach(f"there is no place for so much room: {words}; give less room")
    return roomy


def reached_rooms(
    base: Shape,
    chart: Chart,
    rooms_mm: Mapping[str, float],
    bumps: Sequence[Bump],
    ends_mm: tuple[Floats, Floats],
) -> tuple[RoomPlace, ...]:
    """How far the surface swells at each place.

    ``ends_mm`` are the right vertices (n, 3) of the last without the room and with it.
    """
    standing = chart.standing(base.vertices_mm)
    swelling_mm = np.linalg.norm(ends_mm[1] - ends_mm[0], axis=1)
    return tuple(
        RoomPlace(name, size_mm, float(swelling_mm[bump.shift(standing).any(axis=1)].max()))
        for (name, size_mm), bump in zip(rooms_mm.items(), bumps, strict=True)
    )


def joint_notices(before: Shape, after: Shape) -> tuple[Notice, ...]:
    """A warning if a swelling is now the outermost place of the ball, so that it is measured there.

    Raises
    ------
    OutOfReach
        With the room the ball is not found any more.
    """
    if before.joints is None:
        return ()
    if after.joints is None:
        raise OutOfReach("with so much room the ball of the last is not found: give less room")
    ends = zip(before.joints, after.joints, strict=True)
    if all(abs(after.share_of(new) - before.share_of(old)) < ROOM.same_joint for old, new in ends):
        return ()
    words = "the room swells so far that the ball is now measured at it: give less room"
    return (Notice("room_at_ball", words),)


def change_notices(aims: Sequence[CustomAim], room_mm: Floats) -> tuple[Notice, ...]:
    """A warning of the measures that the room brings away from their targets; ``room_mm`` (aims,)
    is by how much.
    """
    changes = [
        f"{aim.words} {signed(more_mm)} mm"
        for aim, more_mm in zip(aims, room_mm.tolist(), strict=True)
        if aim.firm and abs(more_mm) > ROOM.said_mm
    ]
    if not changes:
        return ()
    words = f"the room changes measures from their targets: {', '.join(changes)}"
    return (Notice("room_changes", words),)
