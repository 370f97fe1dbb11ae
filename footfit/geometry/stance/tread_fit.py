"""A model of the bottom from the shank over the tread to the toe, fitted to its slope.

Along the arc length s, over the standing length, the slope of the bottom's middle is

    theta(s) = ground - fall (1 - S((s - tread + turn) / turn)) + spring max(0, s - tread)^power
               - crease  where s < tread

with S(u) = 3 u^2 - 2 u^3 on [0, 1]: the shank falls, turns into the tread over ``turn``, lies on
the ground at ``tread``, and springs up to the toe. A shank may turn softly and still end in a
``crease``. The model is smoothed as the measured slope is.
A crisp break and a soft one are both of this form; a polynomial through the tread would mix the
shank and the toe spring into it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.smoothing import local_quadratic
from footfit.geometry.stance.middle_line import MiddleLine


@dataclass(frozen=True, slots=True)
class TreadFitSettings:
    """How the model is fitted; lengths over the standing length, angles in radians.

    Attributes
    ----------
    window : tuple of float
        The stretch of arc that is fitted.
    step : float
        From sample to sample of the model.
    bandwidth : float
        Standard deviation of the local parabolas that smooth the slope.
    height_sd, slope_sd : float
        What the model leaves of heights and of slopes.
    tread : tuple of float
        The tread's place along the ground, and its standard deviation among lasts.
    turn, power, fall : tuple of float
        The usual value and its spread: a factor's logarithm for ``turn`` and ``fall``.
    tip : float
        Where the toe spring is judged.
    toe : tuple of float
        How high toes spring there at most, over the length, and the spread of those that spring
        higher. A ground that is too low has the toe far over it.
    crease : float
        The angle that is seldom left at the tread: most shanks have turned before.
    least, most : tuple of float
        Bounds of (ground, fall, turn, tread, spring, power, crease).
    scale : tuple of float
        A usual step of each.
    """

    window: tuple[float, float] = (0.42, 0.95)
    step: float = 0.0025
    bandwidth: float = 0.012
    height_sd: float = 0.0012
    slope_sd: float = 0.06
    tread: tuple[float, float] = (0.675, 0.02)
    turn: tuple[float, float] = (0.17, 0.5)
    power: tuple[float, float] = (1.2, 0.2)
    fall: tuple[float, float] = (0.4, 1.5)
    tip: float = 0.94
    toe: tuple[float, float] = (0.02, 0.02)
    crease: float = 0.03
    least: tuple[float, ...] = (-0.026, 0.01, 0.03, 0.5, 0.0, 0.5, 0.0)
    most: tuple[float, ...] = (1.2, 2.0, 0.5, 0.9, 30.0, 3.0, 0.7)
    scale: tuple[float, ...] = (0.05, 0.2, 0.1, 0.03, 1.0, 0.3, 0.1)
    rounds: int = 25
    settled: float = 1e-6


TREAD_FIT = TreadFitSettings()
_START = 0.17, 0.70, 1.0, 1.2, 0.02  # turn, tread, spring, power, crease
_LEAST_FALL = 0.1
_CORRELATED = 12.0  # samples this close count as one: the smoothing ties them together


@dataclass(frozen=True, slots=True)
class SlopedLine:
    """A middle line, smoothed at some arc lengths.

    ``slope`` (k,) in radians from the resting plane at ``arc`` (k,), ``points_mm`` (k, 2) along and
    over the trial ground that ``line`` was cut for.
    """

    arc: Floats
    slope: Floats
    points_mm: Floats
    line: MiddleLine

    def places(self, ground: float) -> Floats:
        """Where the points lie along the standing length on a ground (radians), (k,).

        The line was cut for a ground close by.
        """
        line, off = self.line, ground - self.line.ground
        cosine, sine = np.cos(off), np.sin(off)
        rear, front = (
            end * cosine + height * sine
            for end, height in zip(line.ends_mm, line.points_mm[[0, -1], 1], strict=True)
        )
        along = self.points_mm[:, 0] * cosine + self.points_mm[:, 1] * sine
        return np.asarray((along - rear) / (front - rear))

    def place_of(self, fit: TreadFit) -> float:
        """Where along the standing length a model that fits has its tread, on its own ground."""
        return float(np.interp(fit.parameters[3], self.arc, self.places(fit.ground)))


@dataclass(frozen=True, slots=True)
class TreadFit:
    """The model that fits: the ground's angle (radians), its standard deviation, and the cost."""

    ground: float
    ground_sd: float
    cost: float
    parameters: Floats


def sloped(line: MiddleLine, arc: Floats, bandwidth: float) -> SlopedLine | None:
    """A middle line at arc lengths (k,), smoothed by local parabolas.

    None where the line has a gap, or ends before.
    """
    after = np.clip(np.searchsorted(line.arc, arc), 1, len(line.arc) - 1)
    nearest = np.minimum(np.abs(arc - line.arc[after - 1]), np.abs(line.arc[after] - arc))
    if nearest.max() > 2.0 * bandwidth:
        return None
    value, change = local_quadratic(arc, line.arc, bandwidth)
    direction = change @ line.points_mm
    slope = np.arctan2(direction[:, 1], direction[:, 0]) + line.ground
    return SlopedLine(arc, slope, value @ line.points_mm, line)


def model_arc(settings: TreadFitSettings = TREAD_FIT) -> Floats:
    """The arc lengths at which the model is compared with the line."""
    low, high = settings.window
    return np.arange(low, high + settings.step, 2 * settings.step)


def fitted_tread(
    line: SlopedLine,
    ground: float,
    start: Floats | float,
    least_ground: float = -np.inf,
    settings: TreadFitSettings = TREAD_FIT,
) -> TreadFit:
    """The model that fits a line best, by damped Gauss-Newton steps.

    Parameters
    ----------
    line : SlopedLine
        At :func:`model_arc`.
    ground : float
        The ground along which the tread's place is counted, radians.
    start : (7,) or float
        The parameters to begin with, or the ground's angle alone.
    least_ground : float
        The ground is not sought below this angle, radians.
    """
    least, most, scale = (
        np.array(value) for value in (settings.least, settings.most, settings.scale)
    )
    least[0] = max(least[0], least_ground)
    begin = np.array(start)
    if begin.ndim == 0:
        fall = max(float(begin) - float(line.slope.min()), _LEAST_FALL)
        begin = np.array([float(begin), fall, *_START])
    parameters = np.clip(begin, least + 1e-6, most - 1e-6)
    places = line.places(ground)
    residual, jacobian = _residuals(parameters, line, places, settings)
    damping = 1e-2
    for _ in range(settings.rounds):
        scaled = jacobian * scale
        normal, gradient = scaled.T @ scaled, scaled.T @ residual
        for _ in range(6):
            damped = normal + damping * np.diag(np.diag(normal) + 1e-9)
            tried = parameters - np.linalg.solve(damped, gradient) * scale
            tried = np.clip(tried, least + 1e-6, most - 1e-6)
            left, slopes = _residuals(tried, line, places, settings)
            if left @ left < residual @ residual:
                break
            damping *= 6.0
        else:
            break
        gained = residual @ residual - left @ left
        parameters, residual, jacobian = tried, left, slopes
        damping = max(damping / 4.0, 1e-7)
        if gained < settings.settled * float(residual @ residual):
            break
    covariance = np.linalg.pinv(jacobian.T @ jacobian)
    cost = float(residual @ residual)
    return TreadFit(float(parameters[0]), float(np.sqrt(covariance[0, 0])), cost, parameters)


def _residuals(
    parameters: Floats, line: SlopedLine, places: Floats, settings: TreadFitSettings
) -> tuple[Floats, Floats]:
    """What the model leaves, over its standard deviations, and its Jacobian (r,), (r, 7)."""
    model, slopes = _model(parameters, settings)
    off, step = line.slope - model, 2 * settings.step
    height, height_change = np.cumsum(off) * step, -np.cumsum(slopes, axis=1) * step
    height -= height.mean()
    height_change -= height_change.mean(axis=1, keepdims=True)
    share = np.sqrt(_CORRELATED / len(off))
    place, place_change = _place_at(parameters[3], line.arc, places)
    crease, crease_change = _seldom(parameters[6] / settings.crease)
    crease_change /= settings.crease
    toe, toe_change = _toe(parameters[3:6], settings.tip)
    prior = np.array(
        [
            (place - settings.tread[0]) / settings.tread[1],
            np.log(parameters[2] / settings.turn[0]) / settings.turn[1],
            (parameters[5] - settings.power[0]) / settings.power[1],
            np.log(parameters[1] / settings.fall[0]) / settings.fall[1],
            max(toe - settings.toe[0], 0.0) / settings.toe[1],
            crease,
        ]
    )
    prior_change = np.zeros((6, 7))
    prior_change[0, 3] = place_change / settings.tread[1]
    prior_change[1, 2] = 1.0 / (parameters[2] * settings.turn[1])
    prior_change[2, 5] = 1.0 / settings.power[1]
    prior_change[3, 1] = 1.0 / (parameters[1] * settings.fall[1])
    if toe > settings.toe[0]:
        prior_change[4, 3:6] = toe_change / settings.toe[1]
    prior_change[5, 6] = crease_change
    weights = share / settings.height_sd, share / settings.slope_sd
    return (
        np.concatenate([height * weights[0], off * weights[1], prior]),
        np.concatenate([height_change.T * weights[0], -slopes.T * weights[1], prior_change]),
    )


def _seldom(share: float) -> tuple[float, float]:
    """What is left of something that is seldom there, and seldom little if it is: the residual of a
    distribution with heavy tails (Student's), and its derivative.
    """
    share = max(share, 1e-6)
    left = float(np.sqrt(2.0 * np.log1p(0.5 * share**2)))
    return left, share / ((1.0 + 0.5 * share**2) * left)


def _place_at(at: float, arc: Floats, places: Floats) -> tuple[float, float]:
    """Where along the standing length an arc length lies, and how fast that changes."""
    step = float(arc[1] - arc[0])
    before, place, after = np.interp([at - step, at, at + step], arc, places)
    return float(place), float((after - before) / (2 * step))


def _toe(parameters: Floats, tip: float) -> tuple[float, Floats]:
    """How high the toe springs at a place by (tread, spring, power), and the derivatives (3,)."""
    tread, spring, power = parameters
    ahead = max(tip - tread, 1e-9)
    rise = spring * ahead**power
    toe = rise * ahead / (power + 1.0)
    by_power = toe * (np.log(ahead) - 1.0 / (power + 1.0))
    return float(toe), np.array([-rise, ahead ** (power + 1.0) / (power + 1.0), by_power])


@lru_cache(maxsize=4)
def _model_grid(settings: TreadFitSettings) -> tuple[Floats, Floats]:
    """Where the model is computed, (n,), and what smooths it to :func:`model_arc`, (k, n)."""
    margin, reach = 24, 20
    low, high = settings.window
    arc = np.arange(
        low - margin * settings.step, high + (margin + 1) * settings.step, settings.step
    )
    off = np.arange(len(arc)) - (margin + 2 * np.arange(len(model_arc(settings))))[:, None]
    kernel = np.exp(-0.5 * (off * settings.step / settings.bandwidth) ** 2) * (np.abs(off) <= reach)
    return arc, kernel / kernel.sum(axis=1, keepdims=True)


def _model(parameters: Floats, settings: TreadFitSettings) -> tuple[Floats, Floats]:
    """The smoothed slopes at :func:`model_arc`, (k,), and their derivatives, (7, k)."""
    ground, fall, turn, tread, spring, power, crease = parameters
    arc, smoothing = _model_grid(settings)
    share = (arc - tread + turn) / turn
    inside = np.clip(share, 0.0, 1.0)
    rest = 1.0 - (3.0 - 2.0 * inside) * inside**2
    change = 6.0 * inside * (1.0 - inside)
    beyond = np.clip(arc - tread, 0.0, None)
    safe = np.where(beyond > 0.0, beyond, 1e-9)
    rise = np.where(beyond > 0.0, safe**power, 0.0)
    behind = np.clip((tread - arc) / settings.step + 0.5, 0.0, 1.0)
    there = (behind > 0.0) & (behind < 1.0)
    slope = ground - fall * rest + spring * rise - crease * behind
    rows = np.stack(
        [
            np.ones_like(arc),
            -rest,
            fall * change * (tread - arc) / turn**2,
            -fall * change / turn
            - spring * np.where(beyond > 0.0, power * rise / safe, 0.0)
            - crease * there / settings.step,
            rise,
            spring * rise * np.log(safe),
            -behind,
        ]
    )
    return smoothing @ slope, rows @ smoothing.T
