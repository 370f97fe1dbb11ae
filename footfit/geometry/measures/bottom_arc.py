"""Places along the arc of a last's bottom: a higher heel does not move them.

Along the ground, the rear of a last becomes shorter as its heel is raised. Along the bottom's own
arc it does not. So what is at half the arc of a low last is at half the arc of a high one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.unrolling import SideLine, side_line
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.stance.stance import Stance


@dataclass(frozen=True, slots=True)
class BottomArc:
    """The arc of a standing last's bottom in the side view.

    ``line`` is in the standing frame, ``stands`` (4, 4) leads there from the resting frame, and
    ``length_mm`` is the arc's length from the rearmost to the foremost place along the ground.
    """

    line: SideLine
    stands: Floats
    length_mm: float

    def shares(self, points: Floats) -> tuple[Floats, Floats]:
        """Where points (n, 3) of the resting frame lie over the arc: both (n,), over its length.

        The first is the share of the arc straight below a point, the second its height over that.
        """
        standing = points @ self.stands[:3, :3].T + self.stands[:3, 3]
        along, _, over = self.line.unrolled(standing).T / self.length_mm
        return along, over

    def x_mm(self, share: float) -> float:
        """Where a share of the arc lies along X of the resting frame."""
        x, z = self.line.at(np.array([share * self.length_mm]))
        standing = np.array([x[0], 0.0, z[0]])
        return float((standing - self.stands[:3, 3]) @ self.stands[:3, 0])


def bottom_arc(stance: Stance, definition: FlareDefinition | None = None) -> BottomArc:
    """The arc of the bottom of a last that stands so, smoothed as the definition says."""
    line = side_line(stance.middle_mm, stance.length_mm, definition or FlareDefinition())
    end_mm = line.unrolled(np.array([[stance.length_mm, 0.0, 0.0]]))[0, 0]
    return BottomArc(line, stance.standing_transform, float(end_mm))
