"""The shortest way of a tape around a shape: the plane turns until the girth is least.

A tape is laid through places that a fitter or a last maker names, and pulled tight. It then slips
into the plane in which it is shortest. The girth in a plane is the perimeter of the section's
convex hull.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.mesh.outlines import TAPE_OUTLINES, Outline
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class TapeSettings:
    """The search for the least girth; angles in degrees.

    Attributes
    ----------
    most_deg : float
        The plane tilts no farther than this from upright, and turns no farther in plan.
    step_deg : float
        From plane to plane, until the girth grows on both sides; then a parabola gives the least.
    jump, least_step_deg : float
        A girth that is so many times its neighbour is that of another part of the shape. There the
        steps become smaller, down to this one.
    heel_starts_deg : tuple of float
        The search for the heel's tape begins at the best of these tilts.
    directions : int
        In how many directions a section's width is taken for its rough girth.
    beyond : float
        How far beyond its second place a tape reaches at most, over the length.
    """

    most_deg: float = 45.0
    step_deg: float = 10.0
    jump: float = 1.05
    least_step_deg: float = 1.0
    heel_starts_deg: tuple[float, ...] = (0.0, -20.0, 20.0)
    directions: int = 90
    beyond: float = 0.1


TAPE = TapeSettings()


@dataclass(frozen=True, slots=True)
class Tape:
    """A tape that lies in a plane.

    Attributes
    ----------
    origin, axes : (3,), (2, 3)
        A point of the plane, and unit vectors in it: across and up.
    tilt_deg : float
        How far the plane is turned from upright, + where its upper part leans towards the toe; of a
        heel's tape, from level across, + where its medial part is higher.
    turn_deg : float
        How far its medial part is turned towards the toe, in plan.
    reach_mm : float
        What lies farther across is not within the tape: a toe that rises in front of the instep.
    """

    origin: Floats
    axes: Floats
    tilt_deg: float
    turn_deg: float = 0.0
    reach_mm: float = np.inf

    def section(self, shape: Shape) -> Outline:
        """The section in which the tape lies, with its corners."""
        whole = shape.cut(self.origin, self.axes, TAPE_OUTLINES)
        near = tuple(loop for loop in whole.loops if loop[:, 0].mean() < self.reach_mm)
        return replace(whole, loops=near)

    def goes_on(self, section: Outline, length_mm: float) -> bool:
        """Whether the tape's section goes on far beyond its second place: no tape lies like that.

        So it is if a toe is so high that the plane runs through the whole forepart.
        """
        farthest_mm = float(section.points[:, 0].max(initial=-np.inf))
        return farthest_mm > self.reach_mm + TAPE.beyond * length_mm


def tape_about(
    shape: Shape,
    start: Floats,
    end: Floats,
    upright: Floats,
    starts_deg: Sequence[float] = (0.0,),
    settings: TapeSettings = TAPE,
) -> Tape:
    """The shortest tape through two places; its plane turns about the line between them.

    Parameters
    ----------
    start, end : (3,)
        The places.
    upright : (3,)
        The plane without a tilt contains this direction.
    starts_deg : sequence of float
        Tilts that the search begins with: a girth can have more than one least.
    """
    half_mm = 0.5 * float(np.linalg.norm(end - start))
    across = 0.5 * (end - start) / half_mm
    reach_mm = half_mm + settings.beyond * shape.length_mm
    girths = RoughGirths(shape, 0.5 * (start + end), settings.directions, reach_mm)
    tilt_deg = least_near(
        cache(lambda deg: girths.at(tilted(across, upright, deg))),
        starts_deg,
        (-settings.most_deg, settings.most_deg),
        settings.step_deg,
    )
    axes = tilted(across, upright, tilt_deg)
    return Tape(girths.origin, axes, tilt_deg, reach_mm=half_mm)


def heel_tape(shape: Shape, settings: TapeSettings = TAPE) -> Tape:
    """The shortest tape through the heel's base and the instep's crown."""
    places = shape.heel_base, shape.instep_crown.place
    return tape_about(shape, *places, AXES[1], settings.heel_starts_deg, settings)


def tape_over(shape: Shape, place: Floats, settings: TapeSettings = TAPE) -> Tape:
    """The shortest tape over a place (3,) of the ridge; its plane tilts, and turns in plan.

    Its upper part leans forward, because the ridge falls towards the toe.
    """
    girths = RoughGirths(shape, place, settings.directions)

    def axes(tilt_deg: float, turn_deg: float) -> Floats:
        turn = np.radians(turn_deg)
        return tilted(np.array([np.sin(turn), np.cos(turn), 0.0]), AXES[2], tilt_deg)

    @cache
    def girth(tilt_deg: float, turn_deg: float) -> float:
        return girths.at(axes(tilt_deg, turn_deg))

    step, tilts, turns = settings.step_deg, (0.0, settings.most_deg), settings.most_deg
    tilt = least_near(lambda deg: girth(deg, 0.0), (2.0 * step,), tilts, step)
    turn = least_near(lambda deg: girth(tilt, deg), (0.0,), (-turns, turns), step)
    tilt = least_near(lambda deg: girth(deg, turn), (tilt,), tilts, 0.5 * step)
    return Tape(place, axes(tilt, turn), tilt, turn)


def tilted(across: Floats, upright: Floats, tilt_deg: float) -> Floats:
    """The axes (2, 3) of the plane that contains ``across``, tilted from ``upright``.

    Examples
    --------
    >>> tilted(np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]), 90.0).round(9).tolist()
    [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]
    """
    ahead = cross(across, upright)
    ahead /= np.linalg.norm(ahead)
    tilt = np.radians(tilt_deg)
    return np.stack([across, np.cos(tilt) * cross(ahead, across) + np.sin(tilt) * ahead])


def least_near(
    girth_at: Callable[[float], float],
    starts: Sequence[float],
    bounds: tuple[float, float],
    step: float,
) -> float:
    """The angle of the least girth: from the best of some starts downhill, then by a parabola.

    It goes step by step until the girth grows on both sides, or a bound is passed. If it jumps on a
    side, the tape runs into another part there, a cone that leans over the ball: then it goes on
    with quarter steps. ``girth_at`` should keep its values, because it is asked for some of them
    again.

    Examples
    --------
    >>> least_near(lambda deg: (deg - 7.0) ** 2, (0.0,), (-45.0, 45.0), 10.0)
    7.0
    >>> least_near(lambda deg: -deg, (0.0,), (-45.0, 45.0), 10.0)
    45.0
    """
    here = min(starts, key=girth_at)
    best = min((here, here - step, here + step), key=girth_at)
    while best != here and bounds[0] < here < bounds[1]:
        here = best
        best = min((here, here - step, here + step), key=girth_at)
    before, after = girth_at(here - step), girth_at(here + step)
    if max(before, after) > TAPE.jump * girth_at(here) and step > TAPE.least_step_deg:
        return least_near(girth_at, (here,), bounds, 0.25 * step)
    bend = before - 2.0 * girth_at(here) + after
    if 0.0 < bend < np.inf:
        least = here + 0.5 * step * (before - after) / bend
        here = min((here, least), key=girth_at)
    return float(np.clip(here, *bounds))


class RoughGirths:
    """The girths of a shape in planes through one point: quick, and a little too large with noise.

    The perimeter of a convex outline is its mean width times pi (Cauchy). So the girth needs
    no outline: only the points where the plane cuts the edges.
    """

    def __init__(
        self, shape: Shape, origin: Floats, directions: int, reach_mm: float = np.inf
    ) -> None:
        self.origin = origin
        self._reach_mm = reach_mm
        self._vertices, self._faces = shape.vertices_mm, shape.faces
        angle = np.arange(directions) * (2.0 * np.pi / directions)
        self._directions = np.stack([np.cos(angle), np.sin(angle)])

    def at(self, axes: Floats) -> float:
        """The girth in the plane along ``axes`` (2, 3); infinite if the plane cuts nothing."""
        normal = cross(*axes)
        height = self._vertices @ normal - self.origin @ normal
        above = height > 0.0
        a, b, c = above[self._faces.T]
        cut = self._faces[(a != b) | (a != c)]
        start, end = cut.ravel(), cut[:, [1, 2, 0]].ravel()
        crossed = above[start] != above[end]
        start, end = start[crossed], end[crossed]
        share = height[start] / (height[start] - height[end])
        below, over = self._vertices[start], self._vertices[end]
        points = (below + share[:, None] * (over - below) - self.origin) @ axes.T
        points = points[points[:, 0] < self._reach_mm]
        if not len(points):
            return np.inf
        return float((points @ self._directions).max(axis=0).mean() * 2.0 * np.pi)
