"""Left or right, from what differs between a shape and its mirror image.

Not from the fit of a mirrored template: that was right for only 94 of 250 real lasts. Points are in
the canonical frame of a shape that is taken as a right one, in mm or any unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.quantiles import median, quantile


@dataclass(frozen=True, slots=True)
class SideSettings:
    """Everything numeric of the side's score; lengths over L."""

    stations: int = 24
    height: float = 0.26
    bend_unit: float = 0.03
    bend_limit: float = 4.0
    instep: tuple[float, float] = (0.46, 0.70)
    instep_unit: float = 0.02
    arch: tuple[float, float] = (0.36, 0.56)
    arch_unit: float = 0.01
    height_limit: float = 2.0
    band: tuple[float, float] = (0.35, 0.75)  # of the half width
    top_share: float = 0.97
    bottom_share: float = 0.03
    fewest_points: int = 8
    undecided: float = 0.5
    sure: float = 2.5


SIDE = SideSettings()


def side_score(points: Floats, length: float) -> float:
    """The score of points (n, 3) of a surface, evenly spread, in the canonical frame: + is right.

    It is the sum of three features that change sign in a mirror: ``bend`` is the quadratic
    coefficient of the low part's centre line (inflare: towards +y), ``instep`` by how much the +y
    half is higher on top, ``arch`` the same underneath.
    """
    low = points[points[:, 2] < SIDE.height * length] / length
    start = low[:, 0].min()
    station = ((low[:, 0] - start) * SIDE.stations).astype(int)
    rows = [
        _station_row(low[station == place])
        for place in range(SIDE.stations)
        if np.count_nonzero(station == place) >= SIDE.fewest_points
    ]
    if len(rows) < SIDE.stations // 2:
        return 0.0
    s, middle, top, bottom = (np.array(rows) - [start, 0.0, 0.0, 0.0]).T
    bend = float(np.polyfit(s, middle, 2)[0])
    instep, arch = _median(top, s, SIDE.instep), _median(bottom, s, SIDE.arch)
    parts = (
        (bend / SIDE.bend_unit, SIDE.bend_limit),
        (instep / SIDE.instep_unit, SIDE.height_limit),
        (arch / SIDE.arch_unit, SIDE.height_limit),
    )
    return sum(min(max(value, -most), most) for value, most in parts)


def confidence(score: float) -> Literal["sure", "low", "undecided"]:
    """How sure a score makes the side: "sure", "low" or "undecided"."""
    if abs(score) >= SIDE.sure:
        return "sure"
    return "low" if abs(score) >= SIDE.undecided else "undecided"


def _station_row(points: Floats) -> tuple[float, float, float, float]:
    """Where the station is, its middle, and how much higher +y is on top and underneath."""
    y, z = points[:, 1], points[:, 2]
    middle = 0.5 * (y.min() + y.max())
    across = (y - middle) / max(0.5 * float(np.ptp(y)), 1e-9)
    near, far = SIDE.band
    medial = z[(across > near) & (across < far)]
    lateral = z[(across < -near) & (across > -far)]
    top, bottom = (
        quantile(medial, share) - quantile(lateral, share)
        if len(medial) and len(lateral)
        else np.nan
        for share in (SIDE.top_share, SIDE.bottom_share)
    )
    return float(points[:, 0].mean()), middle, top, bottom


def _median(values: Floats, s: Floats, window: tuple[float, float]) -> float:
    """The median of the known values at stations s within a window; 0 if there are none."""
    known = values[np.isfinite(values) & (s >= window[0]) & (s <= window[1])]
    return median(known) if len(known) else 0.0
