"""The middle line of a bottom in the side view, cut at right angles to a trial ground.

A last rests on its seat and its ball, but it stands on its heel with the tread level. How it
stands is not known beforehand, so the line is cut for a trial ground, whose angle is measured from
the resting plane: + raises the heel. The cuts are at right angles to the ground, since cuts
at right angles to the resting plane spoil the seat of a high heel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.sections import sections_across, soles
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.numeric.arrays import Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class MiddleLineSettings:
    """Where and how the line is cut; lengths over the standing length.

    Attributes
    ----------
    places : tuple of float
        Shares of the width, 0 lateral and 1 medial, whose mean height is the line's.
    band : float
        The width is that of the section below this height over its lowest point.
    low : float
        The standing length is the extent of what lies lower than this over the bottom.
    cells : int
        How many strips across the length the bottom is looked for in.
    reach : tuple of float
        From where to where the line is cut.
    sections : int
    """

    places: tuple[float, ...] = (0.30, 0.35, 0.40, 0.45, 0.50, 0.55, 0.60, 0.65, 0.70)
    band: float = 0.10
    low: float = 0.13
    cells: int = 64
    reach: tuple[float, float] = (0.02, 0.98)
    sections: int = 129


MIDDLE_LINE = MiddleLineSettings()
SEAT = 0.06, 0.14
"""Where the seat lies along the ground, over the standing length."""
TOUCH = 0.50, 0.90
"""Where the ground touches the forepart, over the standing length."""
TOE = 0.82, 0.94
"""Where the parabola of the toe runs, over the standing length."""
FEWEST = 6
"""The points that a parabola of the toe needs."""


@dataclass(frozen=True, slots=True)
class MiddleLine:
    """The middle line in the frame of a trial ground.

    Attributes
    ----------
    ground : float
        The trial ground's angle from the resting plane, radians.
    points_mm : (k, 2)
        Along the ground and over it, from heel to toe.
    ends_mm : (2,)
        Where the last begins and ends along the ground.
    """

    ground: float
    points_mm: Floats
    ends_mm: tuple[float, float]

    @property
    def length_mm(self) -> float:
        """The standing length: the extent along the ground."""
        return self.ends_mm[1] - self.ends_mm[0]

    @property
    def arc(self) -> Floats:
        """The arc length at the points over the standing length, 0 at the rearmost point, (k,)."""
        steps = np.linalg.norm(np.diff(self.points_mm, axis=0), axis=1)
        start = self.points_mm[0, 0] - self.ends_mm[0]
        arc: Floats = (start + np.concatenate([[0.0], np.cumsum(steps)])) / self.length_mm
        return arc

    def from_rear(self) -> Floats:
        """The points (k, 2) with the rearmost place along the ground at 0."""
        return self.points_mm - [self.ends_mm[0], 0.0]

    def on(self, ground: float, vertices_mm: Floats) -> MiddleLine:
        """The same line over a ground that is within some degrees of the one it was cut for.

        ``vertices_mm`` (n, 3) is the shape, in its resting frame.
        """
        points = turned(vertices_mm, ground)
        cosine, sine = np.cos(ground - self.ground), np.sin(ground - self.ground)
        turn = np.array([[cosine, -sine], [sine, cosine]])
        return MiddleLine(ground, self.points_mm @ turn, _ends(points[low_points(points)]))


def stretch(points_mm: Floats, length_mm: float, window: tuple[float, float]) -> Floats:
    """The points (k, 2) of a line from the rearmost place between two shares of the length."""
    place = points_mm[:, 0] / length_mm
    return np.asarray(points_mm[(place >= window[0]) & (place <= window[1])])


def seat_line(
    points_mm: Floats, length_mm: float, window: tuple[float, float] = SEAT
) -> tuple[float, float] | None:
    """The slope of the seat's line, and its height (mm) at the rearmost place.

    None if the bottom is open along the seat.
    """
    x, z = stretch(points_mm, length_mm, window).T
    if len(x) < 3:
        return None
    slope, height_mm = np.polyfit(x, z, 1)
    return float(slope), float(height_mm)


def turned(vertices_mm: Floats, ground: float) -> Floats:
    """Points (n, 3) in the frame of a ground at an angle (radians) from the resting plane.

    Examples
    --------
    >>> turned(np.array([[0.0, 5.0, 1.0]]), np.pi / 2).round(9).tolist()
    [[1.0, 5.0, 0.0]]
    """
    cosine, sine = np.cos(ground), np.sin(ground)
    turn = np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])
    return np.asarray(vertices_mm @ turn)


def middle_line(
    vertices_mm: Floats,
    faces: Ints,
    ground: float,
    settings: MiddleLineSettings = MIDDLE_LINE,
) -> MiddleLine | None:
    """The middle line of a right shape's bottom, cut for one trial ground.

    Parameters
    ----------
    vertices_mm : (n, 3)
        Canonical: x from heel to toe, z up from the resting plane.
    faces : (m, 3)
        Wound outward.
    ground : float
        The angle of the trial ground from the resting plane, radians.

    Returns
    -------
    MiddleLine or None
        None if the bottom is open over most of the length.
    """
    points = turned(vertices_mm, ground)
    low = low_points(points, settings)
    ends = _ends(points[low])
    length = ends[1] - ends[0]
    x = ends[0] + np.linspace(*settings.reach, settings.sections) * length
    a, b, c = low[faces.T]
    near = faces[a | b | c]
    segments = sections_across(points, near, x)
    down = area_vectors(points, near[segments.face])[:, 2] < 0.0
    bottom = soles(segments, settings.band * length, settings.places, down)
    whole = np.all(bottom.depth <= bottom.limit, axis=0)
    if whole.mean() < 0.5:
        return None
    line = np.column_stack([x[whole], bottom.depth[:, whole].mean(axis=0)])
    return MiddleLine(ground, line, ends)


def _ends(low_mm: Floats) -> tuple[float, float]:
    """The rearmost and the foremost of the low points (k, 3), along X."""
    return float(low_mm[:, 0].min()), float(low_mm[:, 0].max())


def low_points(points: Floats, settings: MiddleLineSettings = MIDDLE_LINE) -> Bools:
    """Which points (n, 3) lie close over the bottom below them, (n,)."""
    start, length = points[:, 0].min(), np.ptp(points[:, 0])
    cell = ((points[:, 0] - start) / length * settings.cells).astype(np.int64)
    cell = np.minimum(cell, settings.cells - 1)
    lowest = np.full(settings.cells + 2, np.inf)
    np.minimum.at(lowest, cell + 1, points[:, 2])
    around = np.minimum(np.minimum(lowest[:-2], lowest[1:-1]), lowest[2:])
    return np.asarray(points[:, 2] < around[cell] + settings.low * length)
