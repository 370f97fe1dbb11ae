"""A standing foot or last: its ground, its length along it, and its bottom's middle over it.

A foot stands on the contact plane of its frame. A last rests on its seat and its ball, but it
stands on its heel with its tread level.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.smoothing import local_quadratic
from footfit.geometry.stance.ground import standing_ground
from footfit.geometry.stance.middle_line import low_points, middle_line


@dataclass(frozen=True, slots=True)
class StanceSettings:
    """Where the ground touches and where the seat's line runs; over the standing length.

    Attributes
    ----------
    touch : tuple of float
        The ground touches the lowest place of the middle line between these.
    bandwidth : float
        Standard deviation of the local parabolas that the lowest place is found on.
    seat : tuple of float
        The seat's line runs along the middle line between these.
    """

    touch: tuple[float, float] = (0.50, 0.90)
    bandwidth: float = 0.012
    seat: tuple[float, float] = (0.06, 0.14)


STANCE = StanceSettings()


@dataclass(frozen=True, slots=True)
class Stance:
    """How a right shape stands. A foot's standing frame is its resting frame.

    Attributes
    ----------
    ground : float
        The angle of the ground from the resting plane, radians; + raises the heel.
    ground_sd : float
        Its standard deviation, radians: of where a tread may lie, not of a second scan.
    touching_mm : (2,)
        Where the ground touches the middle line, as (x, z) in the resting frame.
    rear_mm : float
        The rearmost place along the ground, counted from where the ground passes under the
        resting frame's origin.
    length_mm : float
        The extent along the ground of what lies low: without leg, shaft or cone.
    middle_mm : (k, 2)
        The middle line of the bottom in the standing frame, from heel to toe: x from the rearmost
        point along the ground, z over the ground. Empty if a foot's sole is open.
    """

    ground: float
    ground_sd: float
    touching_mm: tuple[float, float]
    rear_mm: float
    length_mm: float
    middle_mm: Floats

    @property
    def standing_transform(self) -> Floats:
        """From the resting frame to the standing frame, (4, 4); never a mirror.

        There the ground is z = 0, and the rearmost point along it is at x = 0.
        """
        cosine, sine = np.cos(self.ground), np.sin(self.ground)
        result = np.eye(4)
        result[0, [0, 2]] = cosine, sine
        result[2, [0, 2]] = -sine, cosine
        x_mm, z_mm = self.touching_mm
        result[0, 3], result[2, 3] = -self.rear_mm, sine * x_mm - cosine * z_mm
        return result

    def over_ground_mm(self, x_mm: float, z_mm: float) -> float:
        """How high a place of the resting frame's side view lies over the ground.

        Examples
        --------
        >>> Stance(0.0, 0.0, (9.0, -2.0), 0.0, 250.0, np.empty((0, 2))).over_ground_mm(7.0, 5.0)
        7.0
        """
        across = (z_mm - self.touching_mm[1]) * np.cos(self.ground)
        return float(across - (x_mm - self.touching_mm[0]) * np.sin(self.ground))

    def heel_mm(self, settings: StanceSettings = STANCE) -> float | None:
        """How high the seat's line stands over the ground at the rearmost point.

        None if the bottom is open along the seat.
        """
        place = self.middle_mm[:, 0] / self.length_mm
        seat = self.middle_mm[(place >= settings.seat[0]) & (place <= settings.seat[1])]
        if len(seat) < 3:
            return None
        return float(np.polyfit(seat[:, 0], seat[:, 1], 1)[1])


def stance_of(
    vertices_mm: Floats, faces: Ints, kind: str, settings: StanceSettings = STANCE
) -> Stance | None:
    """How a right shape stands.

    Parameters
    ----------
    vertices_mm : (n, 3)
        Canonical: x from heel to toe, z up from the resting plane.
    faces : (m, 3)
        Wound outward.
    kind : {"foot", "last"}

    Returns
    -------
    Stance or None
        None if a last's bottom is open or has no tread. A foot always stands.
    """
    if kind == "foot":
        return _foot_stance(vertices_mm, faces)
    ground = standing_ground(vertices_mm, faces)
    if ground is None:
        return None
    line = ground.line
    x, z = line.points_mm.T
    place = (x - line.ends_mm[0]) / line.length_mm
    near = np.linspace(*settings.touch, 1 + round(np.ptp(settings.touch) / 0.005))
    heights = local_quadratic(near, place, settings.bandwidth)[0] @ z
    lowest = int(np.argmin(heights))
    low_x, low_z = line.ends_mm[0] + near[lowest] * line.length_mm, heights[lowest]
    cosine, sine = np.cos(line.ground), np.sin(line.ground)
    return Stance(
        ground=ground.angle,
        ground_sd=ground.sd,
        touching_mm=(float(low_x * cosine - low_z * sine), float(low_x * sine + low_z * cosine)),
        rear_mm=line.ends_mm[0],
        length_mm=line.length_mm,
        middle_mm=line.points_mm - [line.ends_mm[0], low_z],
    )


def _foot_stance(vertices_mm: Floats, faces: Ints) -> Stance:
    """A foot on the contact plane of its frame."""
    line = middle_line(vertices_mm, faces, 0.0)
    points_mm = np.empty((0, 2)) if line is None else line.points_mm
    low_mm = vertices_mm[low_points(vertices_mm)]
    return Stance(0.0, 0.0, (0.0, 0.0), 0.0, float(np.ptp(low_mm[:, 0])), points_mm)
