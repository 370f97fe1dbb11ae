"""The bottom of a last laid flat along its own arc, as an insole pattern lies.

In the side view the bottom's middle line is a curve: seat, shank, tread, toe spring. Laid flat, a
point keeps its place across, its way along the line becomes the arc length, and its height becomes
the height over the line. What is read from the flat bottom does not depend on the heel. Heights
count straight up here; ``turning.py`` counts them along sections that turn with the bottom.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.mesh.moments import surface_second_moment
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.smoothing import local_quadratic


@dataclass(frozen=True, slots=True)
class SideLine:
    """The bottom's middle line in the side view, tabulated: ``x_mm``, ``z_mm``, ``arc_mm`` (g,).

    x runs along the ground from the rearmost point, z over it. The arc length begins there too.
    """

    x_mm: Floats
    z_mm: Floats
    arc_mm: Floats

    def unrolled(self, points_mm: Floats) -> Floats:
        """Points (n, 3) above the line: x becomes the arc length, z the height over the line.

        Examples
        --------
        >>> line = SideLine(np.array([0.0, 4.0]), np.array([3.0, 0.0]), np.array([0.0, 5.0]))
        >>> line.unrolled(np.array([[4.0, 7.0, 2.0]])).tolist()
        [[5.0, 7.0, 2.0]]
        """
        x, y, z = points_mm.T
        return np.column_stack([self.arc(x), y, z - self.height(x)])

    def arc(self, x_mm: Floats) -> Floats:
        """The arc length of the line at ``x_mm`` (n,)."""
        return self._beyond(x_mm, self.x_mm, self.arc_mm)

    def height(self, x_mm: Floats) -> Floats:
        """The height of the line at ``x_mm`` (n,)."""
        return self._beyond(x_mm, self.x_mm, self.z_mm)

    def slope(self, arc_mm: Floats) -> Floats:
        """The slope of the line at an arc length (n,), radians: + rises towards the toe."""
        slope = np.arctan(np.gradient(self.z_mm, self.x_mm))
        return np.interp(arc_mm, self.arc_mm, slope)

    def at(self, arc_mm: Floats) -> tuple[Floats, Floats]:
        """Where the line is at an arc length (n,): x and z."""
        x = self._beyond(arc_mm, self.arc_mm, self.x_mm)
        return x, self.height(x)

    @staticmethod
    def _beyond(at: Floats, known: Floats, values: Floats) -> Floats:
        """Linear interpolation that goes straight on beyond the ends."""
        value = np.interp(at, known, values)
        for end, inner in ((0, 1), (-1, -2)):
            outside = at < known[0] if end == 0 else at > known[-1]
            slope = (values[end] - values[inner]) / (known[end] - known[inner])
            value = np.where(outside, values[end] + slope * (at - known[end]), value)
        return np.asarray(value)

    @classmethod
    def level(cls) -> SideLine:
        """The side line of a shape that lies flat already: unrolling changes nothing."""
        return cls(np.array([0.0, 1.0]), np.zeros(2), np.array([0.0, 1.0]))


def side_line(middle_mm: Floats, length_mm: float, definition: FlareDefinition) -> SideLine:
    """The smooth side line through the middle of a bottom, drawn on straight at both ends.

    Parameters
    ----------
    middle_mm : (k, 2)
        The middle line, along the ground from the rearmost point and over the ground.
    length_mm : float
        The standing length.
    definition : FlareDefinition
    """
    place = middle_mm[:, 0] / length_mm
    low, high = definition.line_window
    low, high = max(low, float(place[0])), min(high, float(place[-1]))
    at = np.linspace(low, high, definition.line_points)
    value, change = local_quadratic(at, place, definition.line_bandwidth)
    height, slope = value @ middle_mm[:, 1], change @ middle_mm[:, 1]
    beyond = definition.line_beyond
    at = np.concatenate([[low - beyond], at, [high + beyond]])
    away = beyond * slope[[0, -1]]
    height = np.concatenate([[height[0] - away[0]], height, [height[-1] + away[1]]])
    x = at * length_mm
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(height)))])
    return SideLine(x, height, arc - np.interp(0.0, x, arc))


@dataclass(frozen=True, slots=True)
class FlatBottom:
    """The faces of a bottom that is laid flat, turned to its principal axis.

    ``vertices_mm`` (n, 3): x along the axis from heel to toe, y to the medial side, z over the
    line. ``turn`` (2, 2) took the plan there: rows times it.
    """

    vertices_mm: Floats
    faces: Ints
    turn: Floats


def flat_bottom(flat_mm: Floats, faces: Ints, low_mm: float) -> FlatBottom:
    """The low faces of a shape whose bottom is laid flat, turned to their principal axis.

    Parameters
    ----------
    flat_mm : (n, 3)
        The way along the bottom, across, and the height over it.
    faces : (m, 3)
    low_mm : float
        Faces with all corners higher over the line are left out.
    """
    kept = faces[(flat_mm[:, 2] < low_mm)[faces].any(axis=1)]
    plan = flat_mm * np.array([1.0, 1.0, 0.0])
    moment = surface_second_moment(plan, kept)[:2, :2]
    axis = np.linalg.eigh(moment)[1][:, 1]
    axis = axis if axis[0] > 0.0 else -axis
    turn = np.array([[axis[0], -axis[1]], [axis[1], axis[0]]])
    return FlatBottom(np.column_stack([flat_mm[:, :2] @ turn, flat_mm[:, 2]]), kept, turn)
