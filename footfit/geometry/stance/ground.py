"""The ground under a standing last: where its tread lies level.

Heel height and toe spring trade one against the other, and a last has no mark of how it stands.
Two cues are read from its bottom: a model of all of it (:mod:`footfit.geometry.stance.tread_fit`),
and the mean slope near the place where that model has the tread.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.stance.cues import Cue
from footfit.geometry.stance.middle_line import MiddleLine, middle_line, seat_line
from footfit.geometry.stance.tread_fit import (
    TREAD_FIT,
    SlopedLine,
    TreadFit,
    TreadFitSettings,
    fitted_tread,
    model_arc,
    sloped,
)


@dataclass(frozen=True, slots=True)
class GroundSettings:
    """How the two cues are found and combined; angles in degrees or radians as named.

    Attributes
    ----------
    first_deg : float
        The ground that the fit begins from. Its result is taken if it is below ``low_deg``, its
        cost is below ``low_cost``, and the toe springs by less than ``low_spring`` of the length.
        A wrong fit has the toe rise far from the ground, because its ground is too low.
    starts_deg : tuple of float
        Else the grounds that more fits begin from. The least cost wins.
    seat_back_deg : float
        No seat falls backwards by more than this.
    range_deg : tuple of float
        A ground outside of this range is no ground.
    rounds, damping, settled_deg
        Of finding the place of the tread along the ground that the fit gives.
    step_deg : float
        While the ground is sought, lines are cut for multiples of this angle. The last fit is to a
        line cut for its own ground.
    near_bandwidth : float
        Standard deviation of the local parabolas of the near slope, over the length.
    bend_bandwidth : float
        The same of the slope whose change tells what bends. It is wider, because noise of 0.3 mm
        moved the weights, and so the heel, by up to 5 mm.
    near_reach : float
        Standard deviation of the weights about the place where the fit has the tread, over the
        length.
    near_bend, near_steep_deg, near_least : float
        Curvature times length at which the weight has fallen to .61: what bends is no tread. Behind
        the tread of a low last the bottom bends less, because it is less steep. So this counts
        whole if the steepest slope is ``near_steep_deg`` or more, else in proportion, and
        ``near_least`` of it at least.
    near_sd_deg : float
        The near slope's standard deviation where the tread is level: lasts differ by this in what
        their makers mean by it.
    near_level_deg : float
        If the slopes near the tread spread by more than this, it is not level, and the spread is
        all added to the standard deviation; if by less, that share of it.
    """

    first_deg: float = 9.0
    low_deg: float = 17.0
    low_cost: float = 25.0
    low_spring: float = 0.04
    starts_deg: tuple[float, ...] = (1.0, 17.0, 25.0, 33.0, 41.0, 49.0)
    seat_back_deg: float = 4.0
    range_deg: tuple[float, float] = (-1.5, 60.0)
    rounds: int = 10
    damping: float = 0.8
    settled_deg: float = 0.03
    step_deg: float = 4.0
    near_window: tuple[float, float] = (0.45, 0.92)
    near_samples: int = 95
    near_bandwidth: float = 0.025
    bend_bandwidth: float = 0.035
    near_reach: float = 0.03
    near_bend: float = 0.8
    near_steep_deg: float = 14.0
    near_least: float = 0.25
    near_sd_deg: float = 0.5
    near_level_deg: float = 2.5
    level_break_deg: float = 4.0
    level_behind: float = 0.12
    level_reach: float = 0.05
    level_deg: float = 1.0
    level_doubt: float = 10.0
    level_least_deg: float = 0.25


GROUND = GroundSettings()
LAST_FIT = replace(TREAD_FIT, turn=(TREAD_FIT.turn[0], 1.0))
"""Once the ground is about known, a bottom may break as sharply as it does. While it is sought,
such freedom finds wrong grounds."""


@dataclass(frozen=True, slots=True)
class BottomCues:
    """The ground by the tread and by the whole bottom, and the middle line cut close to both.

    ``level_sd`` (radians) is how sure the shape of this very tread makes its level.
    """

    tread: Cue
    bottom: Cue
    line: MiddleLine
    level_sd: float


def bottom_cues(
    vertices_mm: Floats, faces: Ints, settings: GroundSettings = GROUND
) -> BottomCues | None:
    """What the bottom of a right last in its resting frame says of the ground.

    Returns
    -------
    BottomCues or None
        None if the bottom is open or has no tread.
    """
    rough = _rough_fit(_Trials(vertices_mm, faces, settings), settings)
    line = None if rough is None else middle_line(vertices_mm, faces, rough.ground)
    bottom = _bottom(line)
    if rough is None or line is None or bottom is None:
        return None
    fit = _fit(lambda _: bottom, rough.ground, rough.parameters, settings, LAST_FIT)
    if fit is None:
        return None
    near = _near_slope(line, fit.ground, bottom.place_of(fit), settings)
    if near is None:
        return None
    tread, level_sd = near
    whole = Cue("bottom", fit.ground, fit.ground_sd)
    return BottomCues(tread, whole, line, level_sd)


@dataclass
class _Trials:
    """The bottom of one shape over trial grounds, each cut when it is first asked for, and kept."""

    vertices_mm: Floats
    faces: Ints
    settings: GroundSettings
    _cut: dict[int, SlopedLine | None] = field(default_factory=dict)

    def near(self, ground: float) -> SlopedLine | None:
        """The bottom that is cut for the trial ground nearest to an angle (radians)."""
        step = np.radians(self.settings.step_deg)
        number = round(ground / step)
        if number not in self._cut:
            self._cut[number] = _bottom(middle_line(self.vertices_mm, self.faces, number * step))
        return self._cut[number]

    def least_ground(self) -> float:
        """The lowest ground by all lines so far, and a little more: a fit that lies on it is where
        the search was stopped, and no fit.
        """
        seats = (_least_ground(cut.line, self.settings) for cut in self._cut.values() if cut)
        return max(seats, default=-np.inf) + float(np.radians(self.settings.settled_deg))


def _bottom(line: MiddleLine | None) -> SlopedLine | None:
    """A middle line as the model is fitted to it."""
    return None if line is None else sloped(line, model_arc(), TREAD_FIT.bandwidth)


def _rough_fit(trials: _Trials, settings: GroundSettings) -> TreadFit | None:
    """The best fit to lines that are cut for grounds nearby; None if there is none."""
    first = np.radians(settings.first_deg)
    fit = _fit(trials.near, first, first, settings)
    if fit is not None and _is_low(fit, trials, settings):
        return fit
    starts = np.radians(settings.starts_deg).tolist()
    fits = [fit, *(_fit(trials.near, start, start, settings) for start in starts)]
    least, most = np.radians(settings.range_deg)
    possible = [each for each in fits if each is not None and least < each.ground < most]
    lowest = trials.least_ground()
    standing = [each for each in possible if each.ground > lowest]
    return min(standing or possible, key=lambda each: each.cost, default=None)


def _is_low(fit: TreadFit, trials: _Trials, settings: GroundSettings) -> bool:
    """Whether a fit is that of a low heel, with a toe that springs as toes do."""
    lowest = max(np.radians(settings.range_deg[0]), trials.least_ground())
    low = lowest < fit.ground < np.radians(settings.low_deg) and fit.cost < settings.low_cost
    return low and _spring(fit, trials) < settings.low_spring


def _spring(fit: TreadFit, trials: _Trials) -> float:
    """How far the toe rises from a fit's tread, over the length."""
    bottom = trials.near(fit.ground)
    if bottom is None:
        return np.inf
    place = bottom.places(fit.ground)
    toe = (place > TREAD_FIT.tread[0]) & (place < TREAD_FIT.tip)
    step = float(bottom.arc[1] - bottom.arc[0])
    return float(np.sin(bottom.slope - fit.ground)[toe].sum()) * step


def _fit(
    bottom_at: Callable[[float], SlopedLine | None],
    ground: float,
    start: Floats | float,
    settings: GroundSettings,
    model: TreadFitSettings = TREAD_FIT,
) -> TreadFit | None:
    """The model's ground, the tread's place being counted along that very ground."""
    fit = None
    for _ in range(settings.rounds):
        bottom = bottom_at(ground)
        if bottom is None:
            return None
        fit = fitted_tread(bottom, ground, start, _least_ground(bottom.line, settings), model)
        start = fit.parameters
        off = fit.ground - ground
        ground += settings.damping * off
        if abs(off) < np.radians(settings.settled_deg):
            break
    return fit


def _least_ground(line: MiddleLine, settings: GroundSettings) -> float:
    """The lowest ground on which the seat does not fall backwards, radians.

    A line that is cut for a ground far too low has a steeper seat, and so a lower bound.
    """
    seat = seat_line(line.from_rear(), line.length_mm)
    if seat is None:
        return -np.inf
    return float(np.arctan(seat[0]) + line.ground - np.radians(settings.seat_back_deg))


def _near_slope(
    line: MiddleLine, ground: float, place: float, settings: GroundSettings
) -> tuple[Cue, float] | None:
    """The mean slope near a tread's place, and how sure the tread's level is."""
    arc = np.linspace(*settings.near_window, settings.near_samples)
    bottom = sloped(line, arc, settings.near_bandwidth)
    if bottom is None:
        return None
    smooth = sloped(line, arc, settings.bend_bandwidth)
    if smooth is None:
        return None
    bend = np.gradient(smooth.slope, arc)
    steep = float((ground - smooth.slope).max()) / np.radians(settings.near_steep_deg)
    most = settings.near_bend * float(np.clip(steep, settings.near_least, 1.0))
    off = bottom.places(ground) - place
    weight = np.exp(-0.5 * ((off / settings.near_reach) ** 2 + (bend / most) ** 2))
    weight /= weight.sum()
    mean = float(weight @ bottom.slope)
    spread = float(np.sqrt(weight @ (bottom.slope - mean) ** 2))
    uneven = spread * min(1.0, spread / np.radians(settings.near_level_deg))
    cue = Cue("tread", mean, float(np.hypot(np.radians(settings.near_sd_deg), uneven)))
    return cue, _level_sd(off, bottom.slope - mean, settings)


def _level_sd(off: Floats, slope: Floats, settings: GroundSettings) -> float:
    """How sure the level of a tread is, radians.

    Parameters
    ----------
    off : (k,)
        Places along the bottom, from the tread's, over the length.
    slope : (k,)
        From the ground, radians.
    """
    steep = off[(off < 0.0) & (slope < -np.radians(settings.level_break_deg))]
    behind = float(min(-steep.max(initial=-np.inf), settings.level_behind))
    by_slope = slope / np.radians(settings.level_deg)
    weight = np.exp(-0.5 * ((off / settings.level_reach) ** 2 + by_slope**2))
    uneven = float(np.sqrt(weight @ slope**2 / weight.sum()))
    return float(
        np.hypot(np.radians(settings.level_least_deg), settings.level_doubt * behind * uneven)
    )
