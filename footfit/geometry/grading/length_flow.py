"""How a last's bottom becomes longer: along its whole run, or in the shank alone.

Grading back must give the last that one began with. So a change of length is a flow: every place
goes ahead by a rate that depends on the share of the run where it then is. A flow can be followed
back.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.deform.chart import Chart, eased
from footfit.geometry.grading.steady_lines import free_of_top
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class LengthSettings:
    """Where the shank takes up the length, and how a flow is followed.

    The seat lies behind ``shank``, the tread and the toes in front of it: shares of the line's run
    along the ground. What lies higher takes up the length over ``upper``, whose middle is the
    instep: it goes over to that ``between`` two heights over the bottom. ``rounds`` bring the line
    to its length. The tread's lowest place lies in front of ``behind``, and a heel's rise is taken
    up over a share ``taken_up`` of the way to it.
    """

    shank: tuple[float, float] = (0.22, 0.60)
    upper: tuple[float, float] = (0.22, 0.78)
    between: tuple[float, float] = (0.03, 0.13)
    step_mm: float = 1.0
    rounds: int = 12
    behind: float = 0.4
    taken_up: float = 0.65
    even_rounds: int = 6


LENGTHENING = LengthSettings()


def ahead_mm(
    x_mm: Floats, new_z_mm: Floats, length_mm: float, *, shank_only: bool
) -> tuple[Floats, Floats]:
    """How far places (n,) of a bottom's line, and what lies over it, go ahead along the ground.

    The line runs through ``x_mm`` (n,), which begins at 0, densely. Afterwards it has the heights
    ``new_z_mm`` (n,) and the length ``length_mm``.

    Examples
    --------
    >>> x, z = np.array([0.0, 30.0, 60.0]), np.array([40.0, 0.0, 0.0])
    >>> ahead_mm(x, z, 114.0, shank_only=False)[0].round(1).tolist()
    [0.0, 20.0, 40.0]
    """
    over = LENGTHENING.shank if shank_only else None
    by_mm = length_mm - _arc_mm(x_mm, new_z_mm)
    for _ in range(LENGTHENING.rounds):
        by_mm += length_mm - _arc_mm(flowed_mm(x_mm, by_mm, over), new_z_mm)
    bottom = flowed_mm(x_mm, by_mm, over) - x_mm
    if not shank_only:
        return bottom, bottom
    return bottom, flowed_mm(x_mm, by_mm, LENGTHENING.upper) - x_mm


def _arc_mm(x_mm: Floats, z_mm: Floats) -> float:
    return float(np.hypot(np.diff(x_mm), np.diff(z_mm)).sum())


def flowed_mm(
    x_mm: Floats,
    by_mm: float,
    over: tuple[float, float] | None,
    settings: LengthSettings = LENGTHENING,
) -> Floats:
    """Where places (n,) along the ground are when the last of them is ahead by ``by_mm``.

    The length is taken up evenly, or ``over`` a stretch of the run alone.

    Examples
    --------
    >>> flowed_mm(np.array([0.0, 100.0, 200.0]), 50.0, None).tolist()
    [0.0, 125.0, 250.0]
    >>> flowed_mm(np.array([20.0, 180.0, 200.0]), 20.0, (0.22, 0.60)).tolist()
    [20.0, 200.0, 220.0]
    """
    whole_mm = float(x_mm[-1])
    if over is None:
        return np.asarray(x_mm * (1.0 + by_mm / whole_mm))
    start, end = over
    count = max(1, int(np.ceil(abs(by_mm) / settings.step_mm)))
    step = by_mm / count

    def rate(place: Floats, whole_mm: float) -> Floats:
        return eased((place / whole_mm - start) / (end - start))

    place = np.asarray(x_mm, dtype=np.float64)
    for at in range(count):
        now_mm = whole_mm + at * step
        first = rate(place, now_mm)
        second = rate(place + 0.5 * step * first, now_mm + 0.5 * step)
        third = rate(place + 0.5 * step * second, now_mm + 0.5 * step)
        fourth = rate(place + step * third, now_mm + step)
        place = place + step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)
    return place


def raised_mm(x_mm: Floats, z_mm: Floats, ratio: float, held: tuple[bool, bool]) -> Floats:
    """How far places (n,) of a bottom's line are raised if its heights grow by ``ratio``.

    ``held`` says whether the heel and the toe keep their heights: what lies behind, and in front
    of, the lowest place.

    Examples
    --------
    >>> x, z = np.array([0.0, 100.0, 160.0, 250.0]), np.array([40.0, 10.0, 0.0, 10.0])
    >>> raised_mm(x, z, 1.1, (False, True)).round(6).tolist()
    [4.0, 1.0, 0.0, 0.0]
    """
    lowest = _lowest(x_mm, z_mm)
    place = np.arange(len(x_mm))
    kept = np.where(place < lowest, held[0], held[1])
    return np.where(kept, 0.0, (ratio - 1.0) * (z_mm - z_mm[lowest]))


def lengthened_mm(
    chart: Chart,
    points_mm: Floats,
    ahead_mm: tuple[Floats, Floats],
    aside_mm: Floats,
    raised_mm: Floats,
) -> Floats:
    """Points (n, 3) of the resting frame where the bottom's line goes ahead and is raised.

    ``ahead_mm`` says how far the bottom, and what lies over it, go ahead; ``aside_mm`` how far both
    move across, and ``raised_mm`` up: (k,) each, at the chart's stations. Each point moves by what
    the line does that has its middle where the point has it, and is as free of a held top as there.
    So the way back is the same one.
    """
    standing = chart.standing(points_mm)
    x, z = chart.arc.line.at(chart.stations * chart.arc.length_mm)
    bottom_mm, upper_mm = (x + 0.5 * curve for curve in ahead_mm)
    half_z_mm = z + 0.5 * raised_mm
    low_mm, high_mm = (share * bottom_mm[-1] for share in LENGTHENING.between)
    shift = np.zeros_like(standing)
    for _ in range(LENGTHENING.even_rounds):
        half_way = standing + 0.5 * shift
        x_mm = half_way[:, 0]
        over_mm = half_way[:, 2] - np.interp(x_mm, bottom_mm, half_z_mm)
        risen = eased((over_mm - low_mm) / (high_mm - low_mm))
        bottom, upper = (
            np.interp(x_mm, places, curve)
            for places, curve in zip((bottom_mm, upper_mm), ahead_mm, strict=True)
        )
        aside, raised = (np.interp(x_mm, bottom_mm, curve) for curve in (aside_mm, raised_mm))
        shift = np.column_stack([bottom + risen * (upper - bottom), aside, raised])
        shift *= free_of_top(chart, half_way)[:, None]
    return chart.resting(standing + shift)


def sideways_mm(x_mm: Floats, middle_mm: Floats, ahead_mm: Floats) -> Floats:
    """How far places (n,) of a plan's middle move across, so that it keeps its heading.

    Examples
    --------
    >>> x, middle = np.array([0.0, 100.0, 200.0]), np.array([2.0, 2.0, 12.0])
    >>> sideways_mm(x, middle, 0.1 * x).tolist()
    [0.0, 0.0, 1.0]
    """
    steps_mm = np.diff(middle_mm) / np.diff(x_mm) * np.diff(ahead_mm)
    return np.concatenate([[0.0], np.cumsum(steps_mm)])


def ends_raised_mm(x_mm: Floats, z_mm: Floats, by_mm: tuple[float, float]) -> Floats:
    """How far places (n,) of a bottom's line are raised if its heel and its tip are, (n,).

    The seat rises as a whole, and the shank takes it up; the toe rises towards its tip.

    Examples
    --------
    >>> x, z = np.array([0.0, 30.0, 120.0, 250.0]), np.array([40.0, 40.0, 0.0, 10.0])
    >>> ends_raised_mm(x, z, (1.0, 2.0)).tolist()
    [1.0, 1.0, 0.0, 2.0]
    """
    low_mm = float(x_mm[_lowest(x_mm, z_mm)])
    heel = eased((low_mm - x_mm) / (LENGTHENING.taken_up * low_mm))
    tip = eased((x_mm - low_mm) / (float(x_mm[-1]) - low_mm))
    return np.asarray(by_mm[0] * heel + by_mm[1] * tip)


def _lowest(x_mm: Floats, z_mm: Floats) -> int:
    """Where a bottom's line is lowest: in the tread, not at a heel that lies on the ground."""
    return int(np.argmin(np.where(x_mm > LENGTHENING.behind * x_mm[-1], z_mm, np.inf)))
