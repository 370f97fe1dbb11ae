"""A smooth change of a last, section by section: the section field.

Every change is a curve along the bottom's arc. The map is triangular: the way ahead is changed by
the station, the width by the station and the height, the height by the station and itself. So it
cannot fold while its diagonal is positive; :func:`least_determinant` says how far it is from that.
A field whose curves are zero moves no point at all.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from footfit.geometry.deform.chart import Chart, Places, eased
from footfit.geometry.deform.hump import Hump, HumpCurve
from footfit.geometry.numeric.arrays import Floats

STEP_MM = 0.02
"""Of the differences that the determinant is taken by."""
EVEN_ROUNDS = 4
"""After so many, the place half-way is found to a thousandth of a change of one size."""


@dataclass(frozen=True, slots=True)
class Bump:
    """A smooth swelling of at most ``size_mm`` about a place; - is a dent.

    ``centre_mm`` (3,) and the unit vector ``outward`` (3,) are in the standing frame. Beyond
    ``radius_mm`` it changes nothing.
    """

    centre_mm: Floats
    outward: Floats
    radius_mm: float
    size_mm: float

    def shift(self, points_mm: Floats) -> Floats:
        """How far points (n, 3) are moved, (n, 3)."""
        away = np.linalg.norm(points_mm - self.centre_mm, axis=1) / self.radius_mm
        return np.asarray((self.size_mm * (1.0 - eased(away)))[:, None] * self.outward)


@dataclass(frozen=True)
class Field:
    """What changes along the arc; each curve is the coefficients (knots,) of the chart's splines.

    Attributes
    ----------
    ahead : (knots,)
        How far places move along the ground towards the toe, in mm.
    raised : (knots,)
        How far the bottom, and all over it, is raised, in mm.
    wider, higher : (knots,)
        The natural logarithms of the scales of widths and of heights over the bottom.
    turned : (knots,)
        By how much the plan's heading turns to the medial side, in radians.
    bottom_kept : bool
        Whether the bottom keeps its outline: then widths change only above it.
    even : bool
        Whether points are moved by what the curves say half-way between their old and their new
        place. The field with the opposite curves then leads back, in the same chart. It turns no
        plan and has no bumps.
    bumps : tuple of Bump
        The top plane does not hold them, so none may reach it.
    humps : tuple of Hump
        What is added to the curves over short stretches of the arc.
    """

    chart: Chart
    ahead: Floats
    raised: Floats
    wider: Floats
    higher: Floats
    turned: Floats
    bottom_kept: bool = False
    even: bool = False
    bumps: tuple[Bump, ...] = ()
    humps: tuple[Hump, ...] = ()

    @classmethod
    def still(cls, chart: Chart, *, bottom_kept: bool = False) -> Self:
        """The field that moves nothing."""
        level = np.zeros(chart.settings.knots)
        return cls(chart, level, level, level, level, level, bottom_kept)

    def with_curves(self, **curves: Floats) -> Field:
        """The same field with other curves, by their names."""
        return replace(self, **curves)  # type: ignore[arg-type]

    def moved(self, places: Places) -> Floats:
        """Where the field moves places of its chart: (n, 3) of the standing frame."""
        splines, points = places.splines, places.points_mm
        width = places.risen if self.bottom_kept else 1.0
        wider = np.expm1(width * self._curve("wider", places))
        shift = np.column_stack(
            [
                splines @ self.ahead,
                places.across_mm * wider + width * self._humps("aside", places),
                splines @ self.raised + places.scaled_mm * np.expm1(self._curve("higher", places)),
            ]
        )
        if self.turned.any():
            shift += self._bent(points + shift) - (points + shift)
        shift *= places.free[:, None]
        for bump in self.bumps:  # in full: a bump ends before what is held
            shift += bump.shift(points)
        return np.asarray(points + shift)

    def _curve(self, name: HumpCurve, places: Places) -> Floats:
        """A curve of the field with its humps, (n,)."""
        return np.asarray(places.splines @ getattr(self, name) + self._humps(name, places))

    def _humps(self, name: HumpCurve, places: Places) -> Floats | float:
        return sum((hump.at(places.share) for hump in self.humps if hump.curve == name), 0.0)

    def scales(self, points_mm: Floats) -> tuple[Floats, Floats]:
        """By which factors widths and heights change at points (n, 3) of the resting frame, (n,)
        each; what holds a point holds its scales too.
        """
        places = self.chart.places(self.chart.standing(points_mm))
        width = places.risen if self.bottom_kept else 1.0
        wider = np.expm1(width * self._curve("wider", places))
        higher = np.expm1(self._curve("higher", places))
        higher *= places.scaled_mm / np.maximum(places.over_mm, STEP_MM)
        return 1.0 + places.free * wider, 1.0 + places.free * higher

    def moved_points(self, points_mm: Floats, places: Places | None = None) -> Floats:
        """Where the field moves points (n, 3) of the resting frame, in that frame.

        ``places`` are theirs in the chart, if they are known.
        """
        standing = self.chart.standing(points_mm)
        if self.even:
            shift = self._even_shift(standing)
        else:
            shift = self.moved(places or self.chart.places(standing)) - standing
        return np.asarray(points_mm + shift @ self.chart.arc.stands[:3, :3])

    def _even_shift(self, standing: Floats) -> Floats:
        """How far points (n, 3) of the standing frame are moved: the implicit midpoint rule."""
        shift = np.zeros_like(standing)
        for _ in range(EVEN_ROUNDS):
            places = self.chart.places(standing + 0.5 * shift)
            splines, width = places.splines, places.risen if self.bottom_kept else 1.0
            rate = [
                splines @ self.ahead,
                places.across_mm * width * self._curve("wider", places)
                + width * self._humps("aside", places),
                splines @ self.raised + places.scaled_mm * self._curve("higher", places),
            ]
            shift = places.free[:, None] * np.column_stack(rate)
        return shift

    def _bent(self, points_mm: Floats) -> Floats:
        """Points (n, 3) with the plan bent along the line through the seat's middle.

        Heights do not change. What lies in front of the bend turns rigidly.
        """
        share = self.chart.stations
        along = self.chart.arc.line.at(share * self.chart.arc.length_mm)[0]
        splines = self.chart.splines(share)
        along, heading = along + splines @ self.ahead, splines @ self.turned
        middle = 0.5 * (heading[1:] + heading[:-1])
        step = np.diff(along)
        x, y = (
            np.concatenate([[0.0], np.cumsum(step * part)])
            for part in (np.cos(middle), np.sin(middle))
        )
        at, across, up = points_mm.T
        beyond = np.maximum(at - along[-1], 0.0) + np.minimum(at - along[0], 0.0)
        turn = np.interp(at, along, heading)
        start_mm = float(np.interp(0.1, share, self.chart.middle_mm))
        away = across - start_mm
        cosine, sine = np.cos(turn), np.sin(turn)
        return np.column_stack(
            [
                along[0] + np.interp(at, along, x) + beyond * cosine - away * sine,
                start_mm + np.interp(at, along, y) + beyond * sine + away * cosine,
                up,
            ]
        )


def least_determinant(field: Field, points_mm: Floats) -> float:
    """The least determinant of a field's derivative at points (n, 3) of the resting frame.

    1 keeps volumes; at 0 the field folds. It is taken by central differences.
    """
    standing = field.chart.standing(points_mm)
    columns = []
    for axis in range(3):
        by = np.zeros(3)
        by[axis] = STEP_MM
        ahead, behind = (
            field.moved(field.chart.places(standing + sign * by)) for sign in (1.0, -1.0)
        )
        columns.append((ahead - behind) / (2.0 * STEP_MM))
    return float(np.linalg.det(np.stack(columns, axis=2)).min())
