"""The ground under a standing last: where its tread lies level.

Heel height and toe spring trade one against the other, and a last has no mark of how it stands.
Two cues are combined by their own uncertainties: a model of the whole bottom
(:mod:`footfit.geometry.stance.tread_fit`), and the mean slope near the tread's usual place.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.middle_line import MiddleLine, MiddleLines
from footfit.geometry.stance.tread_fit import (
    TREAD_FIT,
    TreadFit,
    fitted_tread,
    model_arc,
    sloped,
)


@dataclass(frozen=True, slots=True)
class GroundSettings:
    """How the two cues are found and combined; angles in degrees or radians as named.

    Attributes
    ----------
    starts_deg : tuple of float
        Grounds that the fit begins from; the least cost wins.
    range_deg : tuple of float
        A ground outside of this range is no ground.
    rounds, damping, settled_deg
        Of finding the place of the tread along the ground that the fit gives.
    near_bandwidth : float
        Standard deviation of the local parabolas of the near slope, over the length.
    near_reach : float
        Standard deviation of the weights about the tread's place, over the length.
    near_bend : float
        Curvature times length at which the weight has fallen to .61: what bends is no tread.
    near_sd : float
        The least standard deviation of the near slope, radians.
    fit_doubt : float
        The fit's standard deviation counts this many times: on two families of lasts its error
        was two to five times that of the near slope.
    """

    starts_deg: tuple[float, ...] = (1.0, 9.0, 17.0, 25.0, 33.0)
    range_deg: tuple[float, float] = (-1.5, 45.0)
    rounds: int = 10
    damping: float = 0.8
    settled_deg: float = 0.03
    near_window: tuple[float, float] = (0.45, 0.92)
    near_samples: int = 95
    near_bandwidth: float = 0.022
    near_reach: float = 0.03
    near_bend: float = 0.8
    near_sd: float = 0.004
    fit_doubt: float = 2.0


GROUND = GroundSettings()


@dataclass(frozen=True, slots=True)
class StandingGround:
    """The ground of a standing last.

    Attributes
    ----------
    angle : float
        From the resting plane, radians; + raises the heel.
    sd : float
        Its standard deviation, radians: of where a tread may lie, not of a second scan.
    line : MiddleLine
        The middle line, cut for a ground within a degree of this one.
    """

    angle: float
    sd: float
    line: MiddleLine


def standing_ground(
    vertices_mm: Floats, faces: Ints, settings: GroundSettings = GROUND
) -> StandingGround | None:
    """The ground under a right last in its resting frame.

    Returns
    -------
    StandingGround or None
        None if the bottom is open or has no tread.
    """
    lines = MiddleLines(vertices_mm, faces)
    fits = [_fit(lines, float(np.radians(start)), settings) for start in settings.starts_deg]
    least, most = np.radians(settings.range_deg)
    possible = [fit for fit in fits if fit is not None and least < fit.ground < most]
    if not possible:
        return None
    fit = min(possible, key=lambda each: each.cost)
    line = lines.near(fit.ground)
    near = None if line is None else _near_slope(line, fit.ground, settings)
    if line is None or near is None:
        return None
    near_angle, near_sd = near
    fit_sd = settings.fit_doubt * fit.ground_sd
    share = near_sd**-2 / (near_sd**-2 + fit_sd**-2)
    angle = share * near_angle + (1.0 - share) * fit.ground
    variance = 0.5 * (fit.ground_sd**2 + near_sd**2) + 0.25 * (near_angle - fit.ground) ** 2
    return StandingGround(angle, float(np.sqrt(variance)), line)


def _fit(lines: MiddleLines, ground: float, settings: GroundSettings) -> TreadFit | None:
    """The model's ground, the tread's place being counted along that very ground."""
    start: Floats | float = ground
    fit = None
    for _ in range(settings.rounds):
        line = lines.near(ground)
        if line is None:
            return None
        bottom = sloped(line, ground, model_arc(), TREAD_FIT.bandwidth)
        if bottom is None:
            return None
        fit = fitted_tread(bottom, start)
        start = fit.parameters
        off = fit.ground - ground
        ground += settings.damping * off
        if abs(off) < np.radians(settings.settled_deg):
            break
    return fit


def _near_slope(
    line: MiddleLine, ground: float, settings: GroundSettings
) -> tuple[float, float] | None:
    """The mean slope near the tread's usual place, and its standard deviation, radians."""
    arc = np.linspace(*settings.near_window, settings.near_samples)
    bottom = sloped(line, ground, arc, settings.near_bandwidth)
    if bottom is None:
        return None
    bend = np.gradient(bottom.slope, arc)
    off = (bottom.place - TREAD_FIT.tread[0]) / settings.near_reach
    weight = np.exp(-0.5 * (off**2 + (bend / settings.near_bend) ** 2))
    mean = float(weight @ bottom.slope / weight.sum())
    variance = float(weight @ (bottom.slope - mean) ** 2 / weight.sum())
    return mean, float(np.sqrt(variance + settings.near_sd**2))
