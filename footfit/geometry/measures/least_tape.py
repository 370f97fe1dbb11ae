"""The shortest way of a tape around a shape: the plane turns until the girth is least.

A tape is laid through places that a fitter or a last maker names, and pulled tight. It then slips
into the plane in which it is shortest. The girth in a plane is the perimeter of the section's
convex hull.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.outlines import TAPE_OUTLINES, Outline, outline
from footfit.geometry.mesh.sections import Planes, plane_sections
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class TapeSettings:
    """The search for the least girth; angles in degrees.

    Attributes
    ----------
    most_deg : float
        The plane tilts no farther than this from upright.
    step_deg : float
        From plane to plane, until the girth grows on both sides; then a parabola gives the least.
    directions : int
        In how many directions a section's width is taken for its rough girth.
    """

    most_deg: float = 45.0
    step_deg: float = 10.0
    directions: int = 90


TAPE = TapeSettings()


@dataclass(frozen=True, slots=True)
class Tape:
    """A tape that lies in a plane.

    Attributes
    ----------
    origin, axes : (3,), (2, 3)
        A point of the plane, and unit vectors in it: across and up.
    tilt_deg : float
        How far the plane's upper part leans towards the toe.
    turn_deg : float
        How far its medial part is turned towards the toe, in plan.
    """

    origin: Floats
    axes: Floats
    tilt_deg: float
    turn_deg: float = 0.0

    def section(self, shape: Shape) -> Outline:
        """The section in which the tape lies, with its corners."""
        mesh = shape.vertices_mm, shape.faces
        return outline(*mesh, self.origin, self.axes, shape.length_mm, TAPE_OUTLINES)


def tape_about(
    shape: Shape, start: Floats, end: Floats, up: Floats, settings: TapeSettings = TAPE
) -> Tape:
    """The shortest tape through two places; its plane turns about the line between them.

    Parameters
    ----------
    start, end : (3,)
        The places; the line runs to the medial side.
    up : (3,)
        Without a tilt the plane contains this direction.
    """
    across = (end - start) / np.linalg.norm(end - start)
    girths = RoughGirths(shape, 0.5 * (start + end), settings.directions)
    tilt_deg = least_near(lambda deg: girths.at(tilted(across, up, deg)), 0.0, settings)
    return Tape(girths.origin, tilted(across, up, tilt_deg), tilt_deg)


def tilted(across: Floats, up: Floats, tilt_deg: float) -> Floats:
    """The axes (2, 3) of the plane that contains ``across``, tilted forward from ``up``.

    Examples
    --------
    >>> tilted(np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]), 90.0).round(9).tolist()
    [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]
    """
    ahead = np.cross(across, up)
    ahead /= np.linalg.norm(ahead)
    tilt = np.radians(tilt_deg)
    return np.stack([across, np.cos(tilt) * np.cross(ahead, across) + np.sin(tilt) * ahead])


def least_near(girth_at: Callable[[float], float], deg: float, settings: TapeSettings) -> float:
    """The angle of the least girth near an angle, by a parabola.

    It goes downhill step by step until the girth grows on both sides, or the plane leans too far.

    Examples
    --------
    >>> least_near(lambda deg: (deg - 7.0) ** 2, 0.0, TAPE)
    7.0
    >>> least_near(lambda deg: -deg, 0.0, TAPE)
    45.0
    """
    step = settings.step_deg
    before, here, after = (girth_at(deg + side * step) for side in (-1.0, 0.0, 1.0))
    while min(before, after) < here and abs(deg) < settings.most_deg:
        if before < after:
            deg -= step
            before, here, after = girth_at(deg - step), before, here
        else:
            deg += step
            before, here, after = here, after, girth_at(deg + step)
    bend = before - 2.0 * here + after
    if bend > 0.0:
        deg += 0.5 * step * (before - after) / bend
    return float(np.clip(deg, -settings.most_deg, settings.most_deg))


class RoughGirths:
    """The girths of a shape in planes through one point: quick, and a little too large with noise.

    The perimeter of a convex outline is its mean width times pi (Cauchy). So the girth needs
    no outline: only the points where the plane cuts the edges.
    """

    def __init__(self, shape: Shape, origin: Floats, directions: int) -> None:
        self.origin = origin
        self._shape = shape
        angle = np.arange(directions) * (2.0 * np.pi / directions)
        self._directions = np.stack([np.cos(angle), np.sin(angle)])

    def at(self, axes: Floats) -> float:
        """The girth in the plane along ``axes`` (2, 3); 0 if the plane cuts nothing."""
        normal = np.cross(axes[0], axes[1])
        level = np.array([self.origin @ normal])
        values = self._shape.vertices_mm @ normal
        a, b, c = (values > level)[self._shape.faces.T]
        cut = self._shape.faces[(a != b) | (a != c)]
        planes = Planes(level, self.origin[None, :], normal[None, :])
        points = plane_sections(self._shape.vertices_mm, cut, values, planes).points
        if not len(points):
            return 0.0
        reach = (points.reshape(-1, 3) @ axes.T @ self._directions).max(axis=0)
        return float(reach.mean() * 2.0 * np.pi)
