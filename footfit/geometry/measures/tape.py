"""What a tape reads around a section: it bridges what is hollow, and what was cut out of a last."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from footfit.geometry.mesh.outlines import Outline, outline
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.hulls import convex_hull, depth_under_hull


class Crown(NamedTuple):
    """The section (y, z) across the shape at ``x_mm``; its highest place is where a tape lies."""

    section: Outline
    x_mm: float
    deep_mm: float

    @property
    def place(self) -> Floats:
        """The highest place, (3,); on a flat top it is the middle of what is highest."""
        y, z = self.section.points.T
        top_mm = z.max()
        weight = np.maximum(z - (top_mm - self.deep_mm), 0.0)
        return np.array([self.x_mm, float(y @ weight / weight.sum()), top_mm])


def hull_girth(points: Floats) -> float:
    """The perimeter of the convex hull of points (n, 2): a tape bridges what is hollow.

    Examples
    --------
    >>> hull_girth(np.array([[0.0, 0], [3, 0], [1, 1], [0, 4]]))
    12.0
    """
    hull = convex_hull(points)
    return float(np.linalg.norm(np.roll(hull, -1, axis=0) - hull, axis=1).sum())


def touched_mm(section: Outline, chosen: Bools, deep_mm: float) -> float:
    """How much of some of a section's segments (m,) a tape around it touches."""
    if not chosen.any():
        return 0.0
    middles = section.segments[chosen].mean(axis=1)
    depth_mm = depth_under_hull(middles, convex_hull(section.points))
    return float(section.length_mm[chosen][depth_mm < deep_mm].sum())


# ---------------------------------------------------------------- cuts across a cone


@dataclass(frozen=True, slots=True)
class CutSettings:
    """What tells a cut across a last's cone, as a V or a slit; over the length.

    Attributes
    ----------
    straight, least : float, float
        The way along the walls is longer than so many times the way straight across from rim to
        rim, by so much. No instep is so hollow.
    front, widest : float, float
        The rims lie behind this place, and no farther apart.
    heights : (float, float)
        A cone lies between them.
    top : float
        The side view is cut through the middle of what is so near to the cone's top.
    wall : float
        A wall goes on to its rim as long as it is straight to this.
    beside : float
        The lips are cut so far beside the rims.
    out : float
        A section is bridged if the missing part stands out of it by more.
    far : float
        What is missing is not known so far from the rims, by the geometric mean of the two ways.
    edge : float
        So near to a rim the cone's front edge may have been cut away.
    """

    straight: float = 1.5
    least: float = 0.03
    front: float = 0.62
    widest: float = 0.25
    heights: tuple[float, float] = (0.1, 1.2)
    top: float = 0.04
    wall: float = 0.006
    beside: float = 0.004
    out: float = 0.001
    far: float = 0.022
    edge: float = 0.02


CUTS = CutSettings()
_SIDE = np.eye(3)[[0, 2]]


@dataclass(frozen=True, slots=True)
class ConeCut:
    """A cut across a last's cone.

    ``rims`` (2, 3) are the rear and the front rim in the side view, ``lips`` the outlines (k, 3) of
    what is left beside them, as far down as the cut goes.
    """

    rims: Floats
    lips: tuple[Floats, Floats]

    def takes(self, place: Floats, length: float) -> bool:
        """Whether the cut lies at a place (3,) of the side view, or so near that it may."""
        near = CUTS.edge * length
        return bool(self.rims[0, 0] - near < place[0] < self.rims[1, 0] + near)

    def holds(self, vertices: Floats, faces: Ints) -> Bools:
        """Which faces (m,) lie in the cut: under the line from rim to rim, as its floor does."""
        (rear_x, _, rear_z), (front_x, _, front_z) = self.rims
        x, z = vertices[faces][:, :, [0, 2]].mean(axis=1).T
        under = z < np.interp(x, [rear_x, front_x], [rear_z, front_z])
        return np.asarray(under & (x > rear_x) & (x < front_x))

    def bridged(self, section: Outline, origin: Floats, axes: Floats, length: float) -> Outline:
        """A section with what straight lines from lip to lip add to it.

        ``origin`` (3,) and ``axes`` (2, 3) are those of its plane.
        """
        normal = cross(*axes)
        rear, front = ((lip - origin) @ normal for lip in self.lips)
        first, second = np.nonzero(rear[:, None] * front[None, :] < 0.0)
        if not len(first) or not section.loops:
            return section
        share = (rear[first] / (rear[first] - front[second]))[:, None]
        crossed = self.lips[0][first] + share * (self.lips[1][second] - self.lips[0][first])
        hull = convex_hull((crossed - origin) @ axes.T)
        out = depth_under_hull(hull, convex_hull(section.points)).min()
        if out > -CUTS.out * length:
            return section
        sides = (self.rims - origin) @ normal
        apart = sides[0] * sides[1] < 0.0
        mouth_mm = float(np.linalg.norm(self.rims[1] - self.rims[0]))
        between = np.sqrt(np.abs(sides[0] * sides[1])) / np.abs(sides[1] - sides[0])
        return replace(
            section,
            loops=(*section.loops, hull),
            bridged_mm=float(between) * mouth_mm if apart else 0.0,
        )


def cone_cut(vertices: Floats, faces: Ints, length: float, start_x: float) -> ConeCut | None:
    """The deepest cut across the cone of a last; None if there is none.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
    length, start_x : float
        The shape's length, and where it begins along X.
    """
    behind = vertices[vertices[:, 0] < start_x + 0.5 * length]
    if not len(behind):
        return None
    top = behind[behind[:, 2] > behind[:, 2].max() - CUTS.top * length]
    y = 0.5 * float(top[:, 1].min() + top[:, 1].max())
    side = outline(vertices, faces, np.array([0.0, y, 0.0]), _SIDE, length)
    notches = [_notch(loop, length, start_x) for loop in side.loops]
    deepest = max((each for each in notches if each), key=lambda each: each[0], default=None)
    if deepest is None:
        return None
    _, front, bottom, rear = deepest
    ahead = CUTS.beside * length * (front - rear) / np.linalg.norm(front - rear)
    lips = (
        _lip(vertices, faces, rear - ahead, bottom, length),
        _lip(vertices, faces, front + ahead, bottom, length),
    )
    rims = np.array([[rear[0], y, rear[1]], [front[0], y, front[1]]])
    return ConeCut(rims, lips) if all(map(len, lips)) else None


def crosses_cone(origin: Floats, axes: Floats, length: float, start_x: float) -> bool:
    """Whether the plane through ``origin`` (3,) along ``axes`` (2, 3) may cross a cut."""
    x, z = start_x + np.array([0.0, CUTS.front]) * length, np.array(CUTS.heights) * length
    corners = np.stack(np.meshgrid(x, origin[1], z), axis=-1).reshape(-1, 3)
    sides = (corners - origin) @ cross(*axes)
    return bool(sides.min() < 0.0 < sides.max())


def _notch(
    loop: Floats, length: float, start_x: float
) -> tuple[float, Floats, Floats, Floats] | None:
    """How deep the deepest notch of a side view (k, 2) is, its front rim, its bottom, its rear rim.

    The loop runs from the toe over the top to the heel.
    """
    points = loop[: int(np.argmin(loop[:, 0])) + 1]
    points = points[points[:, 0] < start_x + CUTS.front * length]
    if len(points) < 3:
        return None
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    chord = np.linalg.norm(points[:, None] - points[None], axis=2)
    x, z = points.T
    swept = np.concatenate([[0.0], np.cumsum(x[:-1] * z[1:] - x[1:] * z[:-1])])
    swept = swept[None, :] - swept[:, None] + x[None, :] * z[:, None] - x[:, None] * z[None, :]
    hollow = (swept < 0.0) & (chord < CUTS.widest * length)
    deep = np.where(hollow, arc[None, :] - arc[:, None] - CUTS.straight * chord, -np.inf)
    front, rear = np.unravel_index(np.argmax(deep), deep.shape)
    if deep[front, rear] < CUTS.least * length:
        return None
    across = points[rear] - points[front]
    off = np.abs(cross_2d(points[front : rear + 1] - points[front], across))
    bottom = points[front + int(np.argmax(off))]
    wall = CUTS.wall * length
    return (
        float(deep[front, rear]),
        _rim(points[: front + 1][::-1], bottom, wall),
        bottom,
        _rim(points[rear:], bottom, wall),
    )


def cross_2d(first: Floats, second: Floats) -> Floats:
    """The third component of the cross product of vectors (k, 2) with a vector (2,)."""
    return np.asarray(first[:, 0] * second[1] - first[:, 1] * second[0])


def _rim(points: Floats, bottom: Floats, straight: float) -> Floats:
    """Where a wall that begins at the bottom ends: the last of the points (k, 2) on its line."""
    along = (points[0] - bottom) / np.linalg.norm(points[0] - bottom)
    away = points - bottom
    on = (np.abs(cross_2d(away, along)) < straight) & (np.diff(away @ along, prepend=0.0) > 0.0)
    return np.asarray(points[max(0, int(np.argmin(np.append(on, False))) - 1)])


def _lip(vertices: Floats, faces: Ints, rim: Floats, bottom: Floats, length: float) -> Floats:
    """The hull (k, 3) of what is left of a last beside a wall, over the bottom of the cut."""
    up = (rim - bottom) / np.linalg.norm(rim - bottom)
    axes = np.array([[0.0, 1.0, 0.0], [up[0], 0.0, up[1]]])
    origin = np.array([rim[0], 0.0, rim[1]])
    points = outline(vertices, faces, origin, axes, length).points
    points = points[points[:, 1] > -float(np.linalg.norm(rim - bottom))]
    return origin + convex_hull(points) @ axes if len(points) > 2 else np.empty((0, 3))
