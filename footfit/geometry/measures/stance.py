"""How a last stands: the ground under it when its tread lies level.

The frame rests a last on its seat and its ball, but a shoe is not worn like that. On its heel, a
last stands with its bottom level at the tread. The tread is a place along the *standing* last: the
higher the heel, the shorter its rear seems from above. So ground and place are found together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.underside import BOTTOM, Underside, underside
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class StanceSettings:
    """Where the bottom lies level, and how its slope there is read; over the standing length.

    ``tread`` is about the middle of the joint line. The slope is that of a polynomial of
    ``degree`` through the bottom within ``reach``, with less weight towards its ends. A straight
    line would mix in the rise of the toe spring or the fall of the shank.
    """

    tread: float = 0.69
    reach: float = 0.20
    degree: int = 4
    seat: tuple[float, float] = (0.06, 0.14)
    bottom: tuple[float, float] = (0.45, 0.94)
    rounds: int = 8


STANCE = StanceSettings()


@dataclass(frozen=True, slots=True)
class Ground:
    """The line of the ground in the side view: z = ``height_mm`` + ``slope`` x."""

    slope: float = 0.0
    height_mm: float = 0.0

    def under_mm(self, x_mm: float, z_mm: float) -> float:
        """How far a place lies over the ground, at right angles to it.

        Examples
        --------
        >>> Ground(0.0, -2.0).under_mm(7.0, 5.0)
        7.0
        """
        return float((z_mm - self.slope * x_mm - self.height_mm) / np.hypot(1.0, self.slope))


@dataclass(frozen=True, slots=True)
class Stance:
    """A standing last: its ground, and the height (mm) of its seat's line over the ground at the
    pternion.
    """

    ground: Ground
    heel_mm: float


FLAT_STANCE = Stance(Ground(), 0.0)
"""How a foot stands: on the contact plane of its frame."""


def stance(shape: Shape, settings: StanceSettings = STANCE) -> Stance | None:
    """The pose in which a last's bottom lies level at its tread.

    Returns
    -------
    Stance or None
        None if the bottom is open at the heel or the ball.
    """
    fore = underside(shape, settings.bottom, BOTTOM.middle_places)
    rear = underside(shape, settings.seat, BOTTOM.middle_places)
    if fore is None or rear is None:
        return None
    slope, height_mm = rear.line()
    start = np.array([shape.x_mm(0.0), slope * shape.x_mm(0.0) + height_mm])
    end = np.array([shape.x_mm(1.0), fore.z_mm[-1]])
    ground = _level_tread(fore, start, end, settings)
    return Stance(ground, ground.under_mm(*start.tolist()))


def _level_tread(bottom: Underside, start: Floats, end: Floats, settings: StanceSettings) -> Ground:
    """The tangent of a bottom at its tread; the tread's place is counted along the same tangent.

    ``start`` and ``end`` (2,) are the ends of the last in the side view, as (x, z).
    """
    side_view = np.column_stack([bottom.x_mm, bottom.z_mm])
    angle, touching = 0.0, start
    for _ in range(settings.rounds):
        along = np.array([np.cos(angle), np.sin(angle)])
        up = np.array([-along[1], along[0]])
        length = float((end - start) @ along)
        place = float(start @ along) + settings.tread * length
        at = (side_view @ along - place) / length
        near = 1.0 - np.square(at / settings.reach)
        inside = near > 0.0
        curve = np.polynomial.polynomial.polyfit(
            at[inside],
            (side_view @ up)[inside] / length,
            settings.degree,
            w=np.sqrt(near[inside]),  # polyfit squares the weights
        )
        touching = place * along + curve[0] * length * up
        angle += float(np.arctan(curve[1]))
    slope = float(np.tan(angle))
    return Ground(slope, float(touching[1] - slope * touching[0]))
