"""Which way is up over a bottom that slopes: straight up, or with sections that turn with it.

Where a last is bent, its sections may stay upright or turn with the bottom. The edge of the bottom
lies up to 20 mm over the line along which it is laid flat. So the place that it belongs to depends
on which of the two was done. The back of the heel says it: it leans as far as the seat is pitched
if the sections turned, and not at all if they stayed upright.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.unrolling import SideLine
from footfit.geometry.mesh.sections import lowest, sections_across
from footfit.geometry.numeric.arrays import Floats, Ints

_HIGH = 0.4  # of the arc: points that lie higher are no bottom, whichever way is up


def laid_flat(
    standing_mm: Floats,
    faces: Ints,
    line: SideLine,
    length_mm: float,
    definition: FlareDefinition,
) -> Floats:
    """A right shape with its bottom laid flat, (n, 3): along the line, across, over it.

    Parameters
    ----------
    standing_mm : (n, 3)
        In the standing frame.
    faces : (m, 3)
    line : SideLine
    length_mm : float
        The standing length.
    definition : FlareDefinition
    """
    flat = line.unrolled(standing_mm)
    arc_mm = float(line.arc(np.array([length_mm]))[0])
    share = turning(standing_mm, faces, line, arc_mm, definition)
    if share > 0.0:
        near = flat[:, 2] < _HIGH * arc_mm
        flat[near] = _leaning(standing_mm[near], flat[near, 0], line, share, arc_mm, definition)
    return flat


def turning(
    standing_mm: Floats, faces: Ints, line: SideLine, arc_mm: float, definition: FlareDefinition
) -> float:
    """How far the sections of a standing last turn with its bottom: 0 not at all, 1 all the way.

    It is the lean of the heel's back over the pitch of the seat, eased at both ends, because a back
    may lean by a few degrees for other reasons. A nearly level seat says nothing. Nor does a back
    that leans much more than its seat: such a last was drawn as it rests.

    Parameters
    ----------
    standing_mm : (n, 3)
    faces : (m, 3)
    line : SideLine
    arc_mm : float
        The length of the bottom's arc.
    definition : FlareDefinition
    """
    doubtful, sure = np.radians(definition.seat_sure_deg)
    seat_mm = np.array([definition.seat_place * arc_mm])
    pitch = -float(line.slope(seat_mm)[0])
    if pitch <= doubtful:
        return 0.0
    along, height = (float(value[0]) for value in line.at(seat_mm))
    seat = standing_mm - np.array([along, 0.0, height])
    lean = pitch + _lean_of_back(seat / arc_mm, faces, pitch, definition)
    share = np.clip(lean / pitch, 0.0, 1.0)
    eased = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    pitched, alike = np.clip(
        np.array([pitch - doubtful, sure - (lean - pitch)]) / (sure - doubtful), 0.0, 1.0
    )
    return float(np.nan_to_num(eased * pitched * alike))


def _lean_of_back(points: Floats, faces: Ints, pitch: float, definition: FlareDefinition) -> float:
    """How far the heel's back leans forward from the normal of its seat, radians; NaN if unseen.

    ``points`` (n, 3) stand over the arc's length, with the place of the seat at 0.
    """
    cosine, sine = np.cos(pitch), np.sin(pitch)
    along = cosine * points[:, 0] - sine * points[:, 2]
    height = sine * points[:, 0] + cosine * points[:, 2]
    heel = faces[(along < 0.0)[faces].any(axis=1)]
    at = np.linspace(*definition.back_heights, definition.back_points)
    cuts = sections_across(np.column_stack([height, points[:, 1], along]), heel, at)
    back = lowest(cuts.points[:, :, 2], cuts)
    if not np.isfinite(back).all():
        return np.nan
    return float(np.arctan(np.polyfit(at, back, 1)[0]))


def _leaning(
    points_mm: Floats,
    arc_mm: Floats,
    line: SideLine,
    share: float,
    length_mm: float,
    definition: FlareDefinition,
) -> Floats:
    """Points (n, 3) laid flat along directions that lean ``share`` times as much as the bottom.

    ``arc_mm`` (n,) is where the points lie straight above, the first guess of their place.
    """
    window = np.array(definition.lean_window) * length_mm
    for rounds in range(definition.lean_rounds + 1):
        x, z = line.at(arc_mm)
        lean = share * line.slope(np.clip(arc_mm, *window))
        cosine, sine = np.cos(lean), np.sin(lean)
        run, rise = points_mm[:, 0] - x, points_mm[:, 2] - z
        if rounds < definition.lean_rounds:
            rate = np.maximum(np.cos(line.slope(arc_mm) - lean), definition.turn_least)
            arc_mm = arc_mm + definition.lean_step * (run * cosine + rise * sine) / rate
    return np.column_stack([arc_mm, points_mm[:, 1], rise * cosine - run * sine])
