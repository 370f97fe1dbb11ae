"""Left or right, from what differs between a shape and its mirror image.

Never from the fit of a mirrored reference: that was right for 94 of 250 real lasts. Points are in
the canonical frame of a shape taken as a right one; mm or any unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats


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
    low: float = 1.5
    sure: float = 2.5


SIDE = SideSettings()


@dataclass(frozen=True, slots=True)
class SideScore:
    """The mirror-odd features and their sum ``score``, + for a right shape."""

    bend: float
    instep: float
    arch: float
    score: float


def side_score(points: Floats, length: float, settings: SideSettings = SIDE) -> SideScore:
    """The score of points (n, 3) of a surface, evenly spread, in the canonical frame.

    ``bend`` is the quadratic coefficient of the low part's centre line (inflare: towards +y),
    ``instep`` by how much the +y half is higher on top, ``arch`` the same underneath.
    """
    low = points[points[:, 2] < settings.height * length] / length
    start = low[:, 0].min()
    station = ((low[:, 0] - start) * settings.stations).astype(int)
    rows = [
        _station_row(low[station == place], settings)
        for place in range(settings.stations)
        if np.count_nonzero(station == place) >= settings.fewest_points
    ]
    if len(rows) < settings.stations // 2:
        return SideScore(0.0, 0.0, 0.0, 0.0)
    s, middle, top, bottom = np.array(rows).T
    s = s - start
    bend = float(np.polynomial.polynomial.polyfit(s, middle, 2)[2])
    instep = _median(top[_within(s, settings.instep)])
    arch = _median(bottom[_within(s, settings.arch)])
    score = (
        _clipped(bend / settings.bend_unit, settings.bend_limit)
        + _clipped(instep / settings.instep_unit, settings.height_limit)
        + _clipped(arch / settings.arch_unit, settings.height_limit)
    )
    return SideScore(bend, instep, arch, score)


def confidence(score: float, settings: SideSettings = SIDE) -> Literal["sure", "low", "undecided"]:
    """How surely a score tells the side: "sure", "low" or "undecided"."""
    if abs(score) >= settings.sure:
        return "sure"
    return "low" if abs(score) >= settings.undecided else "undecided"


def _station_row(points: Floats, settings: SideSettings) -> tuple[float, float, float, float]:
    """Where the station is, its middle, and how much higher +y is on top and underneath."""
    y, z = points[:, 1], points[:, 2]
    middle = 0.5 * (y.min() + y.max())
    across = (y - middle) / max(0.5 * float(np.ptp(y)), 1e-9)
    near, far = settings.band
    medial = z[(across > near) & (across < far)]
    lateral = z[(across < -near) & (across > -far)]
    if len(medial) == 0 or len(lateral) == 0:
        return float(points[:, 0].mean()), middle, np.nan, np.nan
    top, bottom = (
        float(np.quantile(medial, share) - np.quantile(lateral, share))
        for share in (settings.top_share, settings.bottom_share)
    )
    return float(points[:, 0].mean()), middle, top, bottom


def _within(s: Floats, window: tuple[float, float]) -> Bools:
    return np.asarray((s >= window[0]) & (s <= window[1]))


def _median(values: Floats) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else 0.0


def _clipped(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
