"""The curves that a last is drawn from: plan widths, side view, sections. Lengths over L.

The proportions follow common last-making practice: heel about a quarter of the length wide, ball
three eighths, seat and tread joined by the shank, cone a third of the length high.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

from footfit.geometry.numeric.arrays import Floats

Curve = Callable[[Floats], Floats]

BALL_STATION = 0.67
SHANK_STATION = 0.43
WIDTH_STATIONS = (0.0, 0.09, 0.17, 0.30, 0.42, 0.55, BALL_STATION, 0.76, 0.84, 0.92, 1.0)

# toe shape: half widths at .76, .84, .92 and 1.0 as shares of the ball's, and the length of the cap
TOES = {
    "round": (0.965, 0.86, 0.73, 0.62, 0.14),
    "almond": (0.94, 0.80, 0.60, 0.46, 0.13),
    "square": (0.97, 0.90, 0.81, 0.74, 0.085),
    "pointed": (0.90, 0.74, 0.53, 0.33, 0.10),
    "oblique": (0.975, 0.87, 0.70, 0.55, 0.11),  # with a toe turned far to the medial side
}


@dataclass(frozen=True, slots=True)
class Widths:
    """Half width of the widest row and the end caps' factor, on a grid of stations."""

    half: Floats
    cap: Floats


def _cap(distance: Floats, length: float) -> Floats:
    """Rounds an end off: 0 at it, 1 from ``length`` on, with a finite radius in plan."""
    u = np.clip(1.0 - distance / length, 0.0, 1.0)
    return np.sqrt(1.0 - u**2.5)


def widths(s: Floats, *, ball: float, heel: float, waist: float, toe_shape: str) -> Widths:
    """Half widths at stations ``s`` (n,) of a last of the given full widths; 0 beyond its ends."""
    t0, t1, t2, t3, toe_length = TOES[toe_shape]
    b, h, w = ball / 2.0, heel / 2.0, waist / 2.0
    mid = 0.5 * (w + b)
    rear = (0.93 * h, 0.985 * h, h, 0.5 * (h + w) * 1.005, w)
    fore = (1.01 * mid, b, t0 * b, t1 * b, t2 * b, t3 * b)
    nodes = CubicSpline(WIDTH_STATIONS, (*rear, *fore), bc_type="natural")
    inside = np.clip(s, 0.0, 1.0)
    cap = _cap(inside, 0.13) * _cap(1.0 - inside, toe_length)
    return Widths(nodes(inside) * cap * ((s >= 0.0) & (s <= 1.0)), cap)


def crest_shape(
    s: Floats, cone_length: float, cone_width: float = 0.31
) -> tuple[Floats, Floats, Floats]:
    """How sections close at the top, per station (n,): width kept, sharpness, ridge swing.

    The first is the share of the width that the wall's taper keeps, the second the exponent of
    the closing (high: a flat top with an edge, 2: round), the third 0-1 the ridge's way to
    the medial side.
    """
    c, w = cone_length, cone_width
    keep = PchipInterpolator(
        [0.0, 0.10, c - 0.05, c + 0.06, 0.52, 0.66, 0.80, 1.0],
        [w + 0.19, w + 0.09, w, w - 0.01, 0.42, 0.66, 0.82, 0.90],
    )
    power = PchipInterpolator(
        [0.0, c - 0.06, c + 0.05, 0.52, 0.66, 1.0], [26.0, 26.0, 6.0, 2.8, 2.4, 2.2]
    )
    swing = np.exp(-0.5 * ((s - 0.56) / 0.15) ** 2)
    return keep(s), power(s), swing


def wall_window(s: Floats) -> Floats:
    """How far the medial wall may stay upright, per station (n,): 0 at the heel, 1 ahead of it."""
    return eased((s - 0.10) / 0.18)


@dataclass(frozen=True, slots=True)
class SideView:
    """The last seen from the side, lying on its sole; functions of the station.

    ``pitch_deg`` is the angle between the resting plane and the floor of the drafted pose;
    ``drafted`` (k, 2) are the ordered points (x, z) of the bottom's middle in that pose, in the
    same unit as the other curves, with z = 0 on the floor.
    """

    bottom: Curve
    crest: Curve
    crown: Curve
    widest: Curve
    pitch_deg: float
    drafted: Floats


def eased(t: Floats) -> Floats:
    """From 0 to 1 over 0 to 1, with two smooth derivatives."""
    t = np.clip(t, 0.0, 1.0)
    return t**3 * (10.0 - 15.0 * t + 6.0 * t**2)


@dataclass(frozen=True, slots=True)
class Draft:
    """The side view as it is drafted, standing on its heel; lengths and heights over the length.

    ``heel`` and ``spring`` are heights, ``seat_pitch`` is the seat's slope over the mean slope,
    the shank turns into the tread over ``break_length`` before ``break_station``, and the toe
    springs from ``spring_station`` on. With ``level_tread`` the shank's hollow ends before it.
    """

    heel: float
    spring: float
    seat_pitch: float = 0.55
    break_station: float = 0.66
    break_length: float = 0.18
    spring_station: float = 0.67
    level_tread: bool = False


def drafted_bottom(x: Floats, draft: Draft) -> Floats:
    """Height of the sole's middle over the floor the shoe will stand on, at ordered stations.

    As the default draft has it, the seat slopes down by three fifths of the way's mean slope (12
    degrees under a heel of 60 mm), the shank is steeper, the tread level.
    """
    peak = 0.35 + draft.seat_pitch  # a level seat needs a steeper shank
    slope = draft.seat_pitch + max(0.9, 1.8 - 2.0 * peak) * bell(x, 0.38, 0.11)
    rear = 1.0 - eased((x - draft.break_station + draft.break_length) / draft.break_length)
    slope *= rear
    fall = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])
    shank = draft.heel * (1.0 - fall / fall[-1])
    hollow = 0.010 * bell(x, 0.43, 0.09) * (rear if draft.level_tread else 1.0)
    start = draft.spring_station
    toe = draft.spring * np.clip((x - start) / (1.0 - start), 0.0, None) ** 2.2
    bottom: Floats = shank + hollow + toe
    return bottom


def bell(x: Floats, centre: float, sd: float) -> Floats:
    """A bell curve of height 1."""
    return np.exp(-0.5 * ((x - centre) / sd) ** 2)


def _resting_slope(x: Floats, z: Floats) -> float:
    """Slope dz/dx of the line on which the sole rests: it touches behind and ahead of the shank."""
    rear, fore = (x < SHANK_STATION), (x >= SHANK_STATION)
    slope = (z[fore][None, :] - z[rear][:, None]) / (x[fore][None, :] - x[rear][:, None])
    return float(slope.min(axis=1).max())  # under all of the fore part, then of the rear


THICKNESS = (  # of the forepart over the sole's middle, at stations
    (0.22, 0.30, 0.38, 0.46, 0.54, 0.62, 0.70, 0.80, 0.90, 1.00),
    (0.520, 0.425, 0.345, 0.283, 0.232, 0.187, 0.150, 0.116, 0.094, 0.076),
)


def side_view(
    draft: Draft,
    *,
    cone: float,
    cone_length: float,
    fullness: float = 1.0,
    shaft: float = 0.0,
    sole_crown: float = 1.0,
) -> SideView:
    """The side view of a drafted last, laid onto its sole.

    The forepart is ``fullness`` times as thick as usual; ``shaft`` is the height of a boot's shaft
    over the seat, 0 for none. The sole's bulge is ``sole_crown`` times as deep as usual.
    """
    x = np.linspace(0.0, 1.0, 1001)
    drafted = drafted_bottom(x, draft)
    touching = (x >= 0.02) & (x <= 0.95)
    pitch = -np.arctan(_resting_slope(x[touching], drafted[touching]))
    along = x * np.cos(pitch) - drafted * np.sin(pitch)
    above = x * np.sin(pitch) + drafted * np.cos(pitch)
    scale = 1.0 / (along[-1] - along[0])
    s, bottom = (along - along[0]) * scale, (above - above[touching].min()) * scale
    thickness = fullness * CubicSpline(*THICKNESS)(np.clip(s + 0.34 - cone_length, 0.22, 1.0))
    comb = cone + 0.5 * np.tan(pitch) * (s - 0.15)  # the shin leans half the way with the foot
    if shaft > 0.0:  # thick enough behind the instep for the shaft to come out of it
        comb = np.full_like(s, shaft)
        thickness = thickness + shaft * (1.0 - eased((s - cone_length + 0.06) / 0.14))
    softness = 0.012
    crest = -softness * np.logaddexp(-(bottom + thickness) / softness, -comb / softness)
    low = PchipInterpolator(
        [0.0, 0.15, 0.42, 0.60, 0.72, 0.85, 1.0], [0.074, 0.074, 0.070, 0.062, 0.056, 0.046, 0.038]
    )
    crown = PchipInterpolator(
        [0.0, 0.15, 0.42, 0.66, 0.85, 1.0],
        sole_crown * np.array([0.010, 0.010, 0.005, 0.012, 0.009, 0.007]),
    )

    def bottom_at(at: Floats) -> Floats:
        return np.asarray(np.interp(at, s, bottom))

    def crest_at(at: Floats) -> Floats:
        return np.asarray(np.interp(at, s, crest))

    def widest_at(at: Floats) -> Floats:
        rise: Floats = low(np.clip(at, 0.0, 1.0))
        return bottom_at(at) + rise

    standing = np.column_stack([x, drafted]) * scale
    return SideView(bottom_at, crest_at, crown, widest_at, float(np.degrees(pitch)), standing)
