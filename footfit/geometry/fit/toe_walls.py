"""Where the toes of a foot lie against the wall of a last: in plan, at toe height.

Foot and last are right shapes. Their outlines (`named_sections.toes_outline_mm`) lie along their
bottoms, so a heel does not matter. They are laid on each other as a placement lays the surfaces:
seat on seat and tread on tread sideways. Along the bottom the toe room is given: it is one number.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.named_sections import NAMED_SECTIONS
from footfit.geometry.fit.placement import PLACEMENT
from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct

TOES = ("big toe", "second toe", "third toe", "fourth toe", "little toe")
WALLS = ("front", "inner", "outer")


@dataclass(frozen=True, slots=True)
class ToeBoxSettings:
    """Which part of a foot's outline is toes, and whose.

    Attributes
    ----------
    inner_from, outer_from : float
        Over the foot's length: in front of this the inner edge is the big toe's, and the outer one
        the little toe's. Behind it is the ball.
    shares : (4,)
        Across all toes from the inner edge: where the second, third, fourth and little toe begin.
        The big toe takes a third of the width and each other one a sixth. A convention.
    stations : int
        Of a last's outline, evenly along it up to its front.
    step_mm : float
        Between two points of a foot's outline, at most.
    """

    inner_from: float = 0.80
    outer_from: float = 0.72
    shares: tuple[float, ...] = (1 / 3, 1 / 2, 2 / 3, 5 / 6)
    stations: int = 60
    step_mm: float = 2.0


TOE_BOX = ToeBoxSettings()


@dataclass(frozen=True, slots=True)
class ToesPlan:
    """The edges of a shape's toes in plan, up to its front.

    ``edges_mm`` (k, 3): along the bottom from its rearmost point, and the lateral and the medial
    edge there; the last row is the front. ``seat_mm`` (2,) is the middle of the seat, along and
    aside.
    """

    edges_mm: Floats
    seat_mm: Floats

    @property
    def front_mm(self) -> float:
        """Where the outline ends."""
        return float(self.edges_mm[-1, 0])


@dataclass(frozen=True, slots=True)
class Walls:
    """The outlines of n lasts: ``edges_mm`` (n, k, 3), ``seat_mm`` (n, 2), as in `ToesPlan`."""

    edges_mm: Floats
    seat_mm: Floats


@dataclass(frozen=True, slots=True)
class NearWalls:
    """Where points (n, m) are nearest to the walls of n lasts.

    ``off_mm`` is how far each is from the wall, + is inside, and ``wall`` indexes `WALLS`. The wall
    is nearest at ``along_mm``; ``heading`` is the cosine between the wall there and the bottom's
    length: + at the outer edge, - at the inner one, 0 at the front.
    """

    off_mm: Floats
    wall: Ints
    along_mm: Floats
    heading: Floats


@dataclass(frozen=True, slots=True)
class ToesInLasts:
    """A foot's toes in n lasts: the least clearance of each toe from the wall, + is space.

    ``value_mm`` (n, 5) is by `TOES`; ``wall`` (n, 5) indexes `WALLS`: where that is.
    ``outline_mm`` (n, m, 2) are points of the foot's outline in each last, ``near`` is how near
    they come to its walls, and ``toe`` (m,) is the toe of each.
    """

    value_mm: Floats
    wall: Ints
    outline_mm: Floats
    near: NearWalls
    toe: Ints


def foot_plan(outline_mm: Floats, middle_mm: Floats) -> ToesPlan:
    """The toes of a foot in its canonical frame.

    Parameters
    ----------
    outline_mm : (k, 3)
        Its toes' outline.
    middle_mm : (s, 2)
        The centre line of its bottom, along and aside, in the canonical frame.
    """
    edges_mm = _closed(outline_mm)
    return ToesPlan(edges_mm, _seat(middle_mm, edges_mm[-1, 0]))


def last_plan(outline_mm: Floats, middle_mm: Floats) -> ToesPlan:
    """The toes of a last in its canonical frame, at even stations: see `last_walls`."""
    plan = last_walls(outline_mm[None], [middle_mm])
    return ToesPlan(plan.edges_mm[0], plan.seat_mm[0])


def last_walls(outlines_mm: Floats, middles_mm: Sequence[Floats]) -> Walls:
    """The toes of n lasts, each in its canonical frame, at even stations.

    The outline of a last lies along the principal axis of its flat bottom. It is turned back so
    that at the tread its middle is the centre line's, whose frame is canonical. The numbers of a
    last do not depend on how many there are.

    Parameters
    ----------
    outlines_mm : (n, k, 3)
    middles_mm : n times (s, 2)
    """
    edges_mm = _closed(outlines_mm)
    fronts_mm = edges_mm[:, -1, 0]
    parts = [np.linspace(*part, PLACEMENT.sections) for part in (PLACEMENT.tread, PLACEMENT.seat)]
    both = np.concatenate(parts) * fronts_mm[:, None]
    tread, seat = both[:, : PLACEMENT.sections], both[:, PLACEMENT.sections :]
    halves_mm = edges_mm[:, :, 1:].mean(axis=2)
    along = np.linspace(edges_mm[:, 0, 0], fronts_mm, TOE_BOX.stations, axis=1)
    middles, here = np.empty_like(both), np.empty_like(tread)
    plans = np.empty((*along.shape, 3))
    plans[:, :, 0] = along
    for last, middle_mm in enumerate(middles_mm):
        x = edges_mm[last, :, 0]
        middles[last] = np.interp(both[last], *middle_mm.T)
        here[last] = np.interp(tread[last], x, halves_mm[last])
        for side in (1, 2):
            plans[last, :, side] = np.interp(along[last], x, edges_mm[last, :, side])
    there, resting = middles[:, : PLACEMENT.sections], middles[:, PLACEMENT.sections :]
    turn = ((there - here) / tread).mean(axis=1)
    plans[:, :, 1:] += (turn[:, None] * along)[:, :, None]
    return Walls(plans, np.stack([seat.mean(axis=1), resting.mean(axis=1)], axis=1))


def walls(lasts: Sequence[ToesPlan]) -> Walls:
    """The outlines of lasts side by side."""
    return Walls(np.array([e.edges_mm for e in lasts]), np.array([e.seat_mm for e in lasts]))


def toes_in_lasts(foot: ToesPlan, lasts: Walls, toe_room_mm: Floats, scale: Floats) -> ToesInLasts:
    """How far each toe of a foot is from the walls of n lasts.

    Parameters
    ----------
    foot : ToesPlan
    lasts : Walls
    toe_room_mm : (n,)
        Along the bottom.
    scale : (n, 2)
        How much longer and wider the foot is in the heel of each last: 1 is as it was scanned.
    """
    points_mm, toe = _toe_points(foot)
    inside_mm = _placed(points_mm, foot, lasts, toe_room_mm, scale)
    near = _near_walls(inside_mm, lasts.edges_mm)
    of_toe = toe == np.arange(len(TOES))[:, None, None]
    each_mm = np.where(of_toe, near.off_mm, np.inf)  # (5, n, m)
    rows = np.arange(len(toe_room_mm))
    nearest = each_mm.argmin(axis=2)
    return ToesInLasts(each_mm.min(axis=2).T, near.wall[rows, nearest].T, inside_mm, near, toe)


def _closed(outline_mm: Floats) -> Floats:
    """Edges (..., k, 3) with one more row at the front, which lies half a mm ahead."""
    ahead_mm = outline_mm[..., -1:, :] / [NAMED_SECTIONS.toes_to, 1.0, 1.0]
    return np.concatenate([outline_mm, ahead_mm], axis=-2)


def _middles(edges_mm: Floats, x: Floats) -> Floats:
    """The middle between two edges at places along the bottom."""
    return np.asarray(np.interp(x, edges_mm[:, 0], edges_mm[:, 1:].mean(axis=1)))


def _seat(middle_mm: Floats, length_mm: float) -> Floats:
    """The middle of a seat, (2,): along and aside."""
    x = np.linspace(*PLACEMENT.seat, PLACEMENT.sections) * length_mm
    return np.array([x.mean(), np.interp(x, *middle_mm.T).mean()])


def _toe_points(foot: ToesPlan) -> tuple[Floats, Ints]:
    """Points (m, 2) of a foot's outline, from the outer edge over the tips to the inner edge, and
    the toe (m,) of each.
    """
    x, outer, inner = foot.edges_mm.T
    begins = foot.front_mm * np.array([TOE_BOX.outer_from, TOE_BOX.inner_from])
    sides = [
        np.column_stack([x, edge])[x > begin]
        for edge, begin in zip((outer, inner), begins, strict=True)
    ]
    corners = np.concatenate([sides[0], sides[1][::-1]])
    steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    even = np.arange(0.0, arc[-1], TOE_BOX.step_mm)
    at = distinct(np.concatenate([arc, even]))
    points = np.column_stack([np.interp(at, arc, corners[:, axis]) for axis in (0, 1)])
    aside = points[:, 1]
    share = (aside.max() - aside) / np.ptp(aside)
    return points, np.searchsorted(TOE_BOX.shares, share)


def _placed(
    points_mm: Floats, foot: ToesPlan, lasts: Walls, toe_room_mm: Floats, scale: Floats
) -> Floats:
    """Points (m, 2) of a foot where they lie in n lasts, (n, m, 2)."""
    longer, wider = scale.T
    seat_mm, theirs_mm = foot.seat_mm * scale, lasts.seat_mm
    tips_mm = lasts.edges_mm[:, -1, 0] - toe_room_mm
    shift_mm = tips_mm - longer * foot.front_mm
    starts_mm = np.maximum(lasts.edges_mm[:, 0, 0], longer * foot.edges_mm[0, 0] + shift_mm)
    ends_mm = np.maximum(PLACEMENT.tread[1] * longer * foot.front_mm + shift_mm, starts_mm)
    x = np.linspace(starts_mm, ends_mm, PLACEMENT.sections, axis=1)  # both show the tread there
    there = _at(lasts.edges_mm, lasts.edges_mm[:, :, 1:].mean(axis=2), x).mean(axis=1)
    here = wider * _middles(foot.edges_mm, ((x.T - shift_mm) / longer).T).mean(axis=1)
    reach_mm = x.mean(axis=1)
    turn = np.arctan2(there - theirs_mm[:, 1], reach_mm - theirs_mm[:, 0])
    turn -= np.arctan2(here - seat_mm[:, 1], reach_mm - shift_mm - seat_mm[:, 0])
    c, s = np.cos(turn)[:, None], np.sin(turn)[:, None]
    x, y = np.moveaxis(points_mm * scale[:, None] - seat_mm[:, None], 2, 0)
    along, aside = c * x - s * y, s * x + c * y
    along += (tips_mm - along.max(axis=1))[:, None]
    return np.stack([along, aside + theirs_mm[:, 1:]], axis=-1)


def _at(edges_mm: Floats, values: Floats, x: Floats) -> Floats:
    """Values (n, k) at even stations of n outlines, at other places (n, m) along them."""
    start, end = edges_mm[:, :1, 0], edges_mm[:, -1:, 0]
    place = (x - start) / (end - start) * (values.shape[1] - 1)
    low = np.clip(np.floor(place), 0, values.shape[1] - 2).astype(np.int64)
    first, second = (np.take_along_axis(values, low + step, axis=1) for step in (0, 1))
    return np.asarray(first + np.clip(place - low, 0.0, 1.0) * (second - first))


def _near_walls(points_mm: Floats, edges_mm: Floats) -> NearWalls:
    """Where points (n, m, 2) are nearest to the walls of n lasts."""
    outer, inner = edges_mm[:, :, [0, 1]], edges_mm[:, ::-1, [0, 2]]
    ring = np.concatenate([outer, inner], axis=1)
    start, way = ring[:, :-1], np.diff(ring, axis=1)
    # Coordinate by coordinate: NumPy is slow along an axis of two.
    way_x, way_y = (np.ascontiguousarray(way[:, None, :, axis]) for axis in (0, 1))
    from_x, from_y = (points_mm[:, :, None, i] - start[:, None, :, i] for i in (0, 1))
    squares = np.maximum(np.square(way_x) + np.square(way_y), 1e-12)
    share = np.clip((from_x * way_x + from_y * way_y) / squares, 0.0, 1.0)  # (n, m, segments)
    distance = np.hypot(from_x - share * way_x, from_y - share * way_y)
    nearest = distance.argmin(axis=2)
    rows = np.arange(len(ring))[:, None]
    along, aside = np.moveaxis(way[rows, nearest], 2, 0)
    sides = np.where(along < 0.0, WALLS.index("inner"), WALLS.index("outer"))
    wall = np.where(np.abs(aside) > np.abs(along), WALLS.index("front"), sides)
    off_mm = np.where(_inside(points_mm, edges_mm), 1.0, -1.0) * distance.min(axis=2)
    at = np.take_along_axis(share, nearest[:, :, None], axis=2)[:, :, 0]
    heading = along / np.maximum(np.hypot(along, aside), 1e-6)
    return NearWalls(off_mm, wall, start[rows, nearest, 0] + at * along, heading)


def _inside(points_mm: Floats, edges_mm: Floats) -> Bools:
    x, y = points_mm[..., 0], points_mm[..., 1]
    outer, inner = (_at(edges_mm, edges_mm[:, :, side], x) for side in (1, 2))
    return np.asarray((y > outer) & (y < inner) & (x < edges_mm[:, -1:, 0]))
