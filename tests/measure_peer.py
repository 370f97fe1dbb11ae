"""Every measure by brute force on a fine mesh in its drafted pose, after docs/measures.md.

It shares no code with footfit: a section is where the mesh's edges cross a plane, and nothing is
smoothed. The mesh is a right shape: x from heel to toe, z up from the plane it rests on.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.spatial import ConvexHull

from tests import tape_peer

GROWN_MM = 0.5  # a girth that is this much over the least is past it, and not only rough
UP, ACROSS = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])


class Stands(NamedTuple):
    """A last as it was drafted to stand: x from the rearmost place along the ground.

    ``points_mm`` (n, 3) less ``shift_mm``; those that are ``low`` (n,) over the bottom reach
    ``length_mm`` along the ground. ``middle_mm`` (k, 2) is the bottom's middle, as x and z.
    """

    points_mm: np.ndarray
    shift_mm: np.ndarray
    low: np.ndarray
    length_mm: float
    middle_mm: np.ndarray


@dataclass(frozen=True)
class Drafted:
    """A fine mesh at rest, and how it was drafted.

    ``pitch`` (radians) leads from the resting plane to the ground of a last, + where the heel is
    raised; ``planted`` are measures that the draft knows by name.
    """

    vertices_mm: np.ndarray
    faces: np.ndarray
    kind: str
    pitch: float
    planted: dict[str, float]

    @cached_property
    def edges(self) -> np.ndarray:
        return tape_peer.edges_of(self.faces)

    @cached_property
    def rough_mm(self) -> float:
        x, _, z = self.vertices_mm.T
        return float(np.ptp(x[z < 0.30 * np.ptp(x)]))

    @cached_property
    def ends_mm(self) -> tuple[float, float]:
        """The rearmost and the foremost x; a foot's heel is looked for under its narrowing."""
        x, _, z = self.vertices_mm.T
        rear = z < (0.30 if self.kind == "last" else 0.18) * self.rough_mm
        low = z < 0.30 * self.rough_mm
        if self.kind == "last":  # as it rests, the toe of a high heel lies higher
            low |= x > x[low].max() - 0.3 * self.rough_mm
        return float(x[rear].min()), float(x[low].max())

    @property
    def length_mm(self) -> float:
        return self.ends_mm[1] - self.ends_mm[0]

    def x_mm(self, share: float) -> float:
        return self.ends_mm[0] + share * self.length_mm

    def cut(self, place, normal) -> np.ndarray:
        """Where the edges cross a plane, (n, 3)."""
        height = (self.vertices_mm - place) @ normal
        start, end = self.edges[height[self.edges[:, 0]] * height[self.edges[:, 1]] < 0.0].T
        share = (height[start] / (height[start] - height[end]))[:, None]
        return self.vertices_mm[start] * (1.0 - share) + self.vertices_mm[end] * share

    def across(self, x_mm: float) -> np.ndarray:
        """The section normal to x, (n, 2) as y and z."""
        return self.cut(np.array([x_mm, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))[:, 1:]

    def over_ground(self, points_mm: np.ndarray) -> np.ndarray:
        """Heights over the drafted ground (n,), which touches the lowest of a last's middle."""
        return self.standing(points_mm)[:, 2] - self.ground_mm

    @cached_property
    def ground_mm(self) -> float:
        if self.kind == "foot":
            return float(self.vertices_mm[:, 2].min())
        return float(self.stands.middle_mm[:, 1].min() + self.stands.shift_mm[2])

    @cached_property
    def stands(self) -> Stands:
        points = self.standing(self.vertices_mm)
        shift = np.array([points[:, 0].min(), 0.0, points[:, 2].min()])
        low = _over_bottom(points - shift) < 0.13 * np.ptp(points[:, 0])
        shift[0] = points[low, 0].min()
        points = points - shift
        length = float(np.ptp(points[low, 0]))
        middle = _middle(Drafted(points, self.faces, "last", 0.0, {}), length)
        return Stands(points, shift, low, length, middle)

    def standing(self, points_mm: np.ndarray) -> np.ndarray:
        cosine, sine = np.cos(self.pitch), np.sin(self.pitch)
        turn = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
        return np.asarray(points_mm @ turn.T)

    @cached_property
    def underside(self) -> np.ndarray:
        """Faces (k, 3, 3) that look down."""
        corners = self.vertices_mm[self.faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        high_mm = 0.6 * np.ptp(self.vertices_mm[:, 0])
        return corners[(normal[:, 2] < 0.0) & (corners[:, :, 2].max(axis=1) < high_mm)]

    def bottom_z(self, x_mm: float, y_mm: list[float]) -> list[float]:
        """The lowest surface that looks down at places of the plan; NaN where there is none."""
        x = self.underside[:, :, 0]
        a, b, c = np.moveaxis(self.underside[(x.min(1) <= x_mm) & (x.max(1) >= x_mm)], 1, 0)
        one, other = b - a, c - a
        area = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
        heights = []
        for y in y_mm:
            off = np.array([x_mm, y]) - a[:, :2]
            u = (off[:, 0] * other[:, 1] - off[:, 1] * other[:, 0]) / area
            v = (one[:, 0] * off[:, 1] - one[:, 1] * off[:, 0]) / area
            inside = (u > -1e-9) & (v > -1e-9) & (u + v < 1.0 + 1e-9)
            z = (a[:, 2] + u * one[:, 2] + v * other[:, 2])[inside]
            heights.append(float(z.min()) if len(z) else np.nan)
        return heights

    def bottom_curve(self, window: tuple[float, float], places: tuple[float, ...]) -> np.ndarray:
        """The bottom's height at shares of its width, (k, 2) as x and z."""
        curve = []
        for share in np.linspace(*window, 61):
            section = self.across(self.x_mm(share))
            y = section[section[:, 1] < section[:, 1].min() + 0.10 * self.length_mm, 0]
            heights = self.bottom_z(self.x_mm(share), [y.min() + p * np.ptp(y) for p in places])
            curve.append((self.x_mm(share), np.nanmean(heights)))
        return np.array(curve)


def perimeter(points: np.ndarray) -> float:
    return float(ConvexHull(points).area)  # scipy calls the perimeter of a flat hull area


def middle_of_cap(
    shape: Drafted, direction, near: np.ndarray, *, by_depth: bool = False
) -> np.ndarray:
    """Where the surface at some vertices (n,) reaches farthest in a direction, (3,).

    It is the middle of what is less than .012 of the length under the farthest, on that level; or,
    ``by_depth``, the middle itself, for which what lies farther out counts for more.
    """
    reach = shape.vertices_mm @ direction
    top = reach[near].max()
    deep = top - 0.012 * shape.length_mm
    faces = shape.faces[near[shape.faces].any(axis=1)]
    corners = shape.vertices_mm[faces[reach[faces].max(axis=1) > deep]]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    parts = np.einsum("pk,mkd->pmd", _parts(8), corners).reshape(-1, 3)
    weight = np.tile(area, len(parts) // len(area))
    inside = parts @ direction > deep
    if by_depth:
        return np.average(
            parts[inside], axis=0, weights=(weight * (parts @ direction - deep))[inside]
        )
    place = np.average(parts[inside], axis=0, weights=weight[inside])
    return np.asarray(place + (top - place @ direction) * direction)


def _parts(count: int) -> np.ndarray:
    """The middles of the small triangles that a triangle is cut into, as shares of its corners."""
    i, j = np.meshgrid(np.arange(count), np.arange(count), indexing="ij")
    up, down = i + j < count, i + j < count - 1
    u = np.concatenate([(i[up] + 1 / 3), (i[down] + 2 / 3)]) / count
    v = np.concatenate([(j[up] + 1 / 3), (j[down] + 2 / 3)]) / count
    return np.stack([1.0 - u - v, u, v], axis=1)


def outermost(shape: Drafted, side: float, window: tuple[float, float], along=None, over=None):
    """The outermost place (3,) of one side between two shares; None at the end of its window.

    It is a vertex of a last's fine mesh. The triangles of a foot are too large for that.
    """
    points = shape.vertices_mm
    along = (points[:, 0] - shape.ends_mm[0]) / shape.length_mm if along is None else along
    over = points[:, 2] / shape.length_mm if over is None else over
    near = (along > window[0]) & (along < window[1]) & (over < 0.20)
    best = np.argmax(np.where(near, side * points[:, 1], -np.inf))
    inside = window[0] + 0.008 < along[best] < window[1] - 0.008
    if not inside:
        return None
    return points[best] if shape.kind == "last" else middle_of_cap(shape, side * ACROSS, near)


def true_measures(shape: Drafted) -> dict[str, float]:
    """Every measure that can be read, by name, in mm."""
    values = _ends(shape) | _joints(shape) | _sections(shape) | true_heel_girths(shape)
    values |= _least_tapes(shape)
    if shape.kind == "last":
        values |= _last_only(shape) | standing_measures(shape)
    known = {name: value for name, value in values.items() if value is not None}
    return known | shape.planted


def _ends(shape: Drafted) -> dict[str, float]:
    points = shape.vertices_mm
    rear = points[np.argmin(np.where(points[:, 2] < 0.2 * shape.rough_mm, points[:, 0], np.inf))]
    fore = points[points[:, 0] > shape.x_mm(0.7)]
    if shape.kind == "foot":
        fore = fore[fore[:, 2] < 0.3 * shape.length_mm]
    start = np.array([shape.ends_mm[0], rear[1]])
    farthest = np.linalg.norm(fore[:, :2] - start, axis=1).max()
    return {"length": shape.length_mm, "functional_length": float(farthest)}


def _joints(shape: Drafted) -> dict[str, float]:
    inner = outermost(shape, 1.0, (0.60, 0.82))
    outer = outermost(shape, -1.0, (0.52, 0.76))
    points = shape.vertices_mm
    share = (points[:, 0] - shape.ends_mm[0]) / shape.length_mm
    fore = (share > 0.5) & (share < 0.9) & (points[:, 2] < 0.2 * shape.length_mm)
    values = {"ball_width_orthogonal": float(np.ptp(points[fore, 1]))}
    if inner is None or outer is None:
        return values
    line = (inner - outer) * (1.0, 1.0, 0.0)
    width = float(np.linalg.norm(line))
    ball = shape.cut(outer, np.cross(UP, line / width))
    ball = np.column_stack([ball @ line / width, ball[:, 2]])
    waist_x = 0.5 * (0.5 * (inner[0] + outer[0]) + shape.x_mm(0.5))
    return values | {
        "ball_length": float(inner[0] - shape.ends_mm[0]),
        "ball_width": width,
        "ball_girth": perimeter(ball),
        "waist_girth": perimeter(shape.across(waist_x)),
    }


def _sections(shape: Drafted) -> dict[str, float]:
    instep, toe = shape.across(shape.x_mm(0.5)), shape.across(shape.x_mm(0.92))
    spring_x = shape.x_mm(0.94)
    spring = shape.across(spring_x)[:, 1].min()
    widths = []
    for by in (-0.015, 0.0, 0.015):
        y, z = shape.across(shape.x_mm(1.0 / 6.0 + by)).T
        widths.append(np.ptp(y[z < z.min() + 0.15 * shape.length_mm]))
    arch = shape.bottom_curve((0.28, 0.62), (0.75,))
    return {
        "instep_girth": perimeter(instep),
        "instep_height": float(instep[:, 1].max()),
        "toe_height": float(np.ptp(toe[:, 1])),
        "toe_spring": float(shape.over_ground(np.array([[spring_x, 0.0, spring]]))[0]),
        "heel_width": float(np.mean(widths)),
        "arch_height": float(np.nanmax(arch[:, 1])),
    }


def _heel_base(shape: Drafted) -> np.ndarray:
    """The middle of the cap farthest back and down; what lies farther out counts for more."""
    low = shape.vertices_mm[:, 2] < 0.3 * shape.length_mm
    direction = np.array([-1.0, 0.0, -1.0]) / np.sqrt(2.0)
    return middle_of_cap(shape, direction, low, by_depth=True)


def _cone_edge(shape: Drafted) -> np.ndarray:
    """The middle of the cap farthest over a line down from the cone's top: that to the instep, or,
    if it is flatter, one 14 degrees steeper than the top; no steeper than that to .70.
    """
    shares = (0.15, 0.25, 0.50, 0.70)
    start, *ends = ((shape.x_mm(s), shape.across(shape.x_mm(s))[:, 1].max()) for s in shares)
    top, instep, ball = (np.arctan2(start[1] - z, x - start[0]) for x, z in ends)
    lean = min(max(instep, top + np.radians(14.0)), ball)
    x = shape.vertices_mm[:, 0]
    between = (x > start[0]) & (x < shape.x_mm(0.55))
    direction = np.array([np.sin(lean), 0.0, np.cos(lean)])
    return middle_of_cap(shape, direction, between, by_depth=True)


def true_heel_girths(shape: Drafted) -> dict[str, float]:
    base = _heel_base(shape)
    top = np.array([shape.x_mm(0.5), shape.across(shape.x_mm(0.5))[:, 1].max()])
    start = np.degrees(np.arctan2(top[1] - base[2], top[0] - base[0]))

    def around(angle_deg: float) -> np.ndarray:
        cosine, sine = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
        points = shape.cut(base, np.array([-sine, 0.0, cosine]))
        return np.column_stack([points[:, 1], points @ [cosine, 0.0, sine], points[:, 2]])

    steepest = 80.0
    if shape.kind == "last":
        edge = _cone_edge(shape)
        steepest = float(np.degrees(np.arctan2(edge[2] - base[2], edge[0] - base[0])))
    highest = shape.vertices_mm[:, 2].max() - 1.0
    girths: list[float] = []
    for angle in np.append(np.arange(start, steepest, 0.5), steepest):
        section = around(float(angle))
        if shape.kind == "foot" and section[:, 2].max() > highest:
            return {"long_heel_girth": girths[0]} if girths else {}
        girths.append(perimeter(section[:, :2]))
        if girths[-1] > min(girths) + GROWN_MM:
            break
    return {"long_heel_girth": girths[0], "short_heel_girth": min(girths)}


def _least_tapes(shape: Drafted) -> dict[str, float]:
    """The four girths over their places; of a last these are shares of its bottom's arc."""
    points = shape.vertices_mm
    along = (points[:, 0] - shape.ends_mm[0]) / shape.length_mm
    over = points[:, 2] / shape.length_mm
    if shape.kind == "last":
        stands = shape.stands
        x, z = stands.middle_mm.T
        heel, toe = (np.polyfit(x[end], z[end], 1) for end in (slice(4), slice(-4, None)))
        x = np.concatenate([[0.0], x, [stands.length_mm]])
        z = np.concatenate([[np.polyval(heel, x[0])], z, [np.polyval(toe, x[-1])]])
        arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(z)))])
        along = np.interp(stands.points_mm[:, 0], x, arc / arc[-1])
        over = (stands.points_mm[:, 2] - np.interp(stands.points_mm[:, 0], x, z)) / arc[-1]
    inner = outermost(shape, 1.0, (0.60, 0.82), along, over)
    outer = outermost(shape, -1.0, (0.52, 0.76), along, over)
    if inner is None or outer is None:
        return {}

    def crown(share: float) -> np.ndarray:
        where = shape.x_mm(share)
        if shape.kind == "last":  # down from the standing arc to the resting frame
            at = [np.interp(share, arc / arc[-1], line) for line in (x, z)]
            at = at + stands.shift_mm[[0, 2]]
            where = at[0] * np.cos(shape.pitch) - at[1] * np.sin(shape.pitch)
        section = shape.across(where)
        return np.array([where, *_crown(section, 0.004 * shape.length_mm)])

    share = float(np.interp(0.5 * (inner + outer)[0], np.sort(points[:, 0]), np.sort(along)))
    if shape.kind == "last":
        middle = shape.standing(0.5 * (inner + outer)[None])[0] - stands.shift_mm
        share = float(np.interp(middle[0], x, arc / arc[-1]))
    instep, waist, base = crown(0.5), crown(0.5 * (share + 0.5)), _heel_base(shape)
    ahead = (instep - base) / np.linalg.norm(instep - base)
    farthest = (ahead, instep @ ahead + 0.1 * shape.length_mm)
    return {
        "ball_girth_least": _least_about(shape, outer, inner, UP),
        "waist_girth_least": _least_over(shape, waist),
        "instep_girth_least": _least_over(shape, instep),
        "heel_girth_instep": _least_about(shape, base, instep, ACROSS, farthest),
    }


def _crown(section: np.ndarray, deep_mm: float) -> tuple[float, float]:
    """Of a section (n, 2): the y of the centroid of what lies so deep under its top; its top."""
    top = section[:, 1].max()
    cap = section[section[:, 1] > top - 3.0 * deep_mm]
    y, z = cap[np.argsort(cap[:, 0])].T
    fine = np.linspace(y[0], y[-1], 2001)
    thick = np.maximum(np.interp(fine, y, z) - (top - deep_mm), 0.0)
    return float(fine @ thick / thick.sum()), float(top)


def _least_about(shape: Drafted, start, end, upright, farthest=None) -> float:
    """The least girth of planes through two places: a grid of 5 degrees, then one of 1 degree."""
    line = end - start
    normal = np.cross(line, upright) / np.linalg.norm(np.cross(line, upright))

    def girth(deg: float) -> float:
        plane = tape_peer.turned(line, normal, deg)
        return tape_peer.hull_perimeter(shape.vertices_mm, shape.edges, start, plane, farthest)

    coarse = min(np.arange(-45.0, 45.1, 5.0), key=girth)
    return min(girth(deg) for deg in np.clip(coarse + np.arange(-4.0, 4.1), -45.0, 45.0))


def _least_over(shape: Drafted, place) -> float:
    """The least girth of planes over a place that lean forward, turned in plan: two grids."""

    def girth(plane: tuple[float, float]) -> float:
        turn, lean = plane
        across = tape_peer.turned(-UP, ACROSS, turn)
        normal = tape_peer.turned(across, np.cross(across, UP), lean)
        return tape_peer.hull_perimeter(shape.vertices_mm, shape.edges, place, normal)

    turns, leans = np.arange(-12.0, 12.1, 4.0), np.arange(0.0, 45.1, 5.0)
    turn, lean = min(((a, b) for a in turns for b in leans), key=girth)
    turns, leans = turn + np.arange(-2.0, 2.1, 2.0), lean + np.arange(-3.0, 3.1, 1.5)
    return min(girth((a, b)) for a in turns for b in np.clip(leans, 0.0, 45.0))


def _last_only(shape: Drafted) -> dict[str, float]:
    values = {}
    for name, share in (("bottom_width_ball", 0.66), ("bottom_width_heel", 1.0 / 6.0)):
        widths = []
        for by in (-0.03, -0.015, 0.0, 0.015, 0.03):
            section = shape.across(shape.x_mm(share + by))
            for deg in np.radians(np.arange(30.0, 60.5, 3.0)):
                inner, outer = (
                    section @ [np.cos(deg), -np.sin(deg)],
                    section @ [-np.cos(deg), -np.sin(deg)],
                )
                widths.append(section[np.argmax(inner), 0] - section[np.argmax(outer), 0])
        values[name] = float(np.mean(widths))
    curve = shape.bottom_curve((0.04, 0.96), (0.35, 0.50, 0.65))
    run, rise = np.diff(curve, axis=0).T
    longer = float((np.hypot(run, rise) - run).sum())
    return values | {"tape_length": shape.length_mm + longer}


def standing_measures(shape: Drafted) -> dict[str, float]:
    """What is read of a last as it was drafted to stand: along its ground, and over it."""
    stands, length = shape.stands, shape.stands.length_mm
    x, z = stands.middle_mm.T
    z = z - z.min()
    seat = (x >= 0.06 * length) & (x <= 0.14 * length)
    slope = np.polyfit(x[seat], z[seat], 1)[0]
    fine = np.linspace(x[0], x[-1], 4001)
    heights = np.interp(fine, x, z)
    lowest = np.argmin(heights)
    high = heights > 0.002 * length
    return {
        "stick_length": float(length),
        "bottom_length": _bottom_length(stands.middle_mm, stands.points_mm[stands.low]),
        "seat_angle_deg": -float(np.degrees(np.arctan(slope))),
        "tread_from": max(float(fine[np.flatnonzero(high[:lowest])[-1] + 1]), 0.40 * length),
        "tread_to": float(fine[lowest + np.flatnonzero(high[lowest:])[0]]),
    }


def _bottom_length(middle: np.ndarray, points: np.ndarray) -> float:
    """Along the middle (k, 2) between the feather edges of the low points (n, 3).

    An edge is where a line touches that is half-way between the bottom and the wall, moved along
    the wall down to the bottom's line.
    """
    points = points[:, [0, 2]]
    total = float(np.linalg.norm(np.diff(middle, axis=0), axis=1).sum())
    length = np.ptp(points[:, 0])
    for end, ahead in ((middle[:6][::-1], -1.0), (middle[-6:], 1.0)):
        near = points[np.abs(points[:, 0] - end[-1, 0]) < 0.15 * length]
        run = np.polyfit(end[:, 0], end[:, 1], 1)[0]
        own = ahead * np.array([1.0, run]) / np.hypot(1.0, run)
        lean = 0.0
        if ahead < 0.0:  # the wall of the heel's back, by its rearmost points at two heights
            heights = end[-1, 1] + np.array([0.02, 0.07]) * length
            rear = [near[np.abs(near[:, 1] - z) < 0.007 * length, 0].min() for z in heights]
            lean = np.arctan2(rear[1] - rear[0], heights[1] - heights[0])
        wall = ahead * np.array([np.cos(lean), -np.sin(lean)])
        half = np.arctan2(*(wall + ahead * np.array([own[1], -own[0]]))[::-1])
        angles = half + np.radians(np.linspace(-5.0, 5.0, 11))
        touched = near[(near @ [np.cos(angles), np.sin(angles)]).argmax(axis=0)]
        total += float((touched.mean(axis=0) - end[-1]) @ wall / (own @ wall))
    return total


def _over_bottom(points: np.ndarray) -> np.ndarray:
    """How high points (n, 3) lie over the lowest of their slice across x and its neighbours."""
    slices = np.minimum((points[:, 0] / np.ptp(points[:, 0]) * 80).astype(int), 79)
    lowest = np.full(82, np.inf)
    np.minimum.at(lowest, slices + 1, points[:, 2])
    near = np.minimum(np.minimum(lowest[:-2], lowest[1:-1]), lowest[2:])
    return np.asarray(points[:, 2] - near[slices])


def _middle(stands: Drafted, length: float) -> np.ndarray:
    """The bottom's middle along the ground, (k, 2) as x and z."""
    curve = []
    for x in np.linspace(0.03, 0.97, 95) * length:
        section = stands.across(x)
        y = section[section[:, 1] < section[:, 1].min() + 0.10 * length, 0]
        heights = stands.bottom_z(x, [y.min() + p * np.ptp(y) for p in (0.35, 0.50, 0.65)])
        curve.append((x, np.mean(heights)))
    known = np.array(curve)
    return np.asarray(known[np.isfinite(known[:, 1])])
