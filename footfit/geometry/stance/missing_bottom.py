"""What a label of a last needs of its bottom, and where the bottom is open instead."""

from __future__ import annotations

import numpy as np

from footfit.geometry.stance.cues import StanceLabels
from footfit.geometry.stance.middle_line import (
    FEWEST,
    SEAT,
    TOE,
    TOUCH,
    MiddleLine,
    seat_line,
    stretch,
)

OPEN_FOREPART, OPEN_SHANK = 0.05, 0.26
"""The forepart, where the ground may touch, is open if a gap in it is wider, over the length. So is
the shank: over a wider gap no line is drawn.
"""


def missing_for_labels(line: MiddleLine | None, labels: StanceLabels) -> str:
    """Where a bottom is open so that its labels are of no use; empty if it is not.

    Each label needs the forepart and the seat, a toe spring also the toes.
    """
    if line is None:
        return "over most of its length"
    points, length = line.from_rear(), line.length_mm
    place = points[:, 0] / length
    among = place[(place > TOUCH[0]) & (place < TOUCH[1])]
    if np.diff(np.concatenate([TOUCH[:1], among, TOUCH[1:]])).max() > OPEN_FOREPART:
        return "at the forepart"
    if seat_line(points, length, SEAT) is None:
        return "at the seat"
    if np.diff(place).max() > OPEN_SHANK:
        return "at the shank"
    spring = len(stretch(points, length, TOE)) >= FEWEST
    return "" if spring or labels.drop_mm is not None else "at the toes"
