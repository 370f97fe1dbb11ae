"""The surface of a foot that was scanned flat, as it would be in the heel of a shoe.

A heel model says how lengths, widths and girths change. The surface follows: it is stretched along
the foot, across it and upwards, by another amount at each station. What a model does not say, the
height, is what brings the girths there with these widths.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.stations import STATIONS
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats
from footfit.geometry.numeric.hulls import convex_hull


@dataclass(frozen=True, slots=True)
class SurfaceChange:
    """How the sizes of a foot change in a heel, as shares of them."""

    length: float = 0.0
    heel_width: float = 0.0
    ball_width: float = 0.0
    instep_girth: float = 0.0
    waist_girth: float = 0.0
    ball_girth: float = 0.0


SHARES = {station.name: station.share for station in STATIONS}


def foot_in_heel(foot: Shape, change: SurfaceChange) -> Floats:
    """The vertices (n, 3) of a canonical right foot in a heel, still flat on its sole plane.

    Heel and toes keep their heights, and widths go over from the heel's to the ball's. The foot is
    not turned: a placement turns it anyway, to lay its tread on the last's.
    """
    length_mm, start_mm = foot.length_mm, foot.x_mm(0.0)
    x, y, z = foot.vertices_mm.T
    station = (x - start_mm) / length_mm
    heights = {"heel": 0.0, "toes": 0.0}
    for name in ("instep", "waist", "ball"):
        share = SHARES[name]
        girth = getattr(change, f"{name}_girth")
        heights[name] = _height_change(foot, share, girth, float(_width_change(share, change)))
    places = sorted(heights, key=SHARES.__getitem__)
    height = np.interp(station, [SHARES[name] for name in places], [heights[n] for n in places])
    wider = 1.0 + _width_change(station, change)
    return np.column_stack(
        [start_mm + (1.0 + change.length) * (x - start_mm), wider * y, (1.0 + height) * z]
    )


def _width_change(station: Floats | float, change: SurfaceChange) -> Floats:
    """How the width changes at stations, as shares of it."""
    places = [SHARES["heel"], SHARES["ball"]]
    return np.asarray(np.interp(station, places, [change.heel_width, change.ball_width]))


def _height_change(foot: Shape, share: float, girth: float, width: float) -> float:
    """How the height of a section must change so that its girth changes by the share ``girth`` if
    its width changes by ``width``; to first order, and 0 if there is no section.
    """
    points = foot.across(share).points
    if len(points) < 3:
        return 0.0
    hull = convex_hull(points)
    sides = np.abs(np.roll(hull, -1, axis=0) - hull)
    lengths = np.hypot(*sides.T)
    across, up = (np.square(sides) / np.maximum(lengths, 1e-9)[:, None]).sum(axis=0)
    return float((girth * lengths.sum() - width * across) / up)
