"""What is measured in millimetres on a canonical right shape: one function a measure, one table.

A new measure is a function and an entry of ``MEASURES``. Its row in the catalogue, its key in JSON
and its line in the report follow. ``docs/measures.md`` has the definitions in full.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.measures import girths, heights, lengths, widths
from footfit.geometry.measures.landmarks import LANDMARKS, Shape
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.stance.resting_tilt import resting_tilt
from footfit.number_words import plain

BOTH, LAST = ("foot", "last"), ("last",)
HEELS_MM = (15.0, 45.0, 75.0, 105.0)
"""The heels of lasts for which a trueness is stated; it is interpolated between them."""
LEAST_TILT = 0.001
"""Radians: a last that is turned by less rests on seat and tread as well as a scan tells."""


class Trueness(NamedTuple):
    """How far a measure of a kind is from its definition, on shapes whose truth is known, in mm.

    ``bias`` is the mean of the errors. ``sd`` (1,) of a foot, or (4,) of a last with a heel of
    ``HEELS_MM``, is what they have on top of all else that is known of a value's uncertainty, with
    the bias in it. ``python -m benchmarks.trueness --fit`` prints both.
    """

    bias: float
    sd: tuple[float, ...]

    def sd_at(self, heel_mm: float | None) -> float:
        """The standard deviation at a heel; the largest one if the heel is not known.

        Examples
        --------
        >>> known = Trueness(-0.3, (0.2, 0.5, 0.5, 0.9))
        >>> known.sd_at(30.0), known.sd_at(120.0), known.sd_at(None)
        (0.35, 0.9, 0.9)
        """
        if heel_mm is None or len(self.sd) == 1:
            return max(self.sd)
        return float(np.interp(heel_mm, HEELS_MM, self.sd))


NO_VALUE = Trueness(0.0, (0.0,))
"""Of a kind that does not have the measure."""


def off(bias: float, *sd: float) -> Trueness:
    """A trueness as the table has it."""
    return Trueness(bias, sd)


@dataclass(frozen=True, slots=True)
class MeasureDefinition:
    """An entry of the table; a measure is in mm, or in degrees if its name ends in ``_deg``.

    The docstring of ``value_of`` is the definition, and ``version`` counts its changes. ``sd`` is
    the repeatability of the whole way from a scan, in any pose, with noise or ripple of 0.3 mm, or
    with a quarter of the faces (benchmarks/measures.py); ``last_sd`` is that of a last, if it
    differs: its surface is smoother. ``foot`` and ``last`` are the trueness of
    each kind (benchmarks/trueness.py). ``usual_mm`` in mm, or ``usual_share``
    over the length, is the range of the feet of a survey's 6,068 people [ansur2].
    ``tilts``: of a last it is measured twice, in its frame and as it rests on seat and tread.
    """

    value_of: Callable[[Shape], MeasureValue]
    version: int
    sd: float
    kinds: tuple[str, ...] = BOTH
    foot: Trueness = NO_VALUE
    last: Trueness = NO_VALUE
    usual_mm: tuple[float, float] | None = None
    usual_share: tuple[float, float] | None = None
    last_sd: float | None = None
    tilts: bool = False

    @property
    def name(self) -> str:
        """The function's name: the key in JSON and in the catalogue."""
        return self.value_of.__name__

    def taken_of(self, shape: Shape) -> MeasureValue:
        """The measure of a shape: it is taken once, and kept with what was found on the shape."""
        taken: dict[str, MeasureValue] = vars(shape).setdefault("taken", {})
        if self.name not in taken:
            taken[self.name] = self.value_of(shape)
        return taken[self.name]

    def with_tilt(self, shape: Shape) -> MeasureValue:
        """The measure of a shape, with what it changes by if a last lies on seat and tread."""
        value = self.taken_of(shape)
        rests = at_rest(shape) if self.tilts else None
        there = MeasureValue(None) if rests is None else self.value_of(rests)
        if value.value is None or there.value is None:
            return value
        return value._replace(tilt_mm=there.value - value.value)

    @property
    def definition_id(self) -> str:
        """The name with the version: what a stored value was measured by."""
        return f"{self.name}/{self.version}"

    def sd_of(self, kind: str) -> float:
        """The repeatability on a "foot" or a "last"."""
        return self.sd if kind == "foot" or self.last_sd is None else self.last_sd

    def trueness(self, kind: str) -> Trueness:
        """What is known of the trueness of a "foot" or a "last"."""
        return self.foot if kind == "foot" else self.last


MEASURES: tuple[MeasureDefinition, ...] = (
    MeasureDefinition(
        lengths.length,
        3,
        0.25,
        foot=off(-0.30, 0.47),
        last=off(-0.12, 0.07, 0.16, 0.28, 0.22),
        usual_mm=(200.0, 310.0),
    ),
    MeasureDefinition(
        lengths.functional_length,
        2,
        0.25,
        foot=off(-0.34, 0.52),
        last=off(-0.15, 0.06, 0.18, 0.28, 0.32),
    ),
    MeasureDefinition(
        lengths.ball_length,
        2,
        0.45,
        last_sd=0.6,
        foot=off(0.71, 0.80),
        last=off(0.07, 1.45, 1.07, 1.47, 2.15),
        usual_share=(0.66, 0.80),
    ),
    MeasureDefinition(
        widths.ball_width,
        3,
        0.25,
        last_sd=0.15,
        foot=off(-0.21, 0.33),
        last=off(-0.03, 0.28, 0.31, 0.27, 0.64),
        usual_share=(0.31, 0.46),
    ),
    MeasureDefinition(
        widths.ball_width_orthogonal,
        2,
        0.2,
        last_sd=0.15,
        foot=off(-0.34, 0.38),
        last=off(-0.13, 0.19, 0.20, 0.25, 0.15),
        usual_share=(0.31, 0.46),
    ),
    MeasureDefinition(
        girths.ball_girth,
        3,
        0.5,
        foot=off(-0.55, 0.94),
        last=off(-0.07, 0.38, 0.77, 0.59, 1.01),
        usual_share=(0.77, 1.10),
    ),
    MeasureDefinition(
        girths.waist_girth,
        3,
        0.3,
        foot=off(-0.24, 0.24),
        last=off(-0.37, 0.28, 0.51, 0.54, 0.68),
        tilts=True,
    ),
    MeasureDefinition(
        girths.instep_girth,
        3,
        0.3,
        foot=off(-0.20, 0.39),
        last=off(-0.37, 0.11, 0.49, 0.60, 0.58),
        tilts=True,
    ),
    MeasureDefinition(
        girths.long_heel_girth,
        3,
        0.4,
        foot=off(-0.28, 0.44),
        last=off(-0.43, 1.51, 0.46, 0.14, 0.52),
        tilts=True,
    ),
    MeasureDefinition(
        girths.short_heel_girth,
        5,
        0.35,
        last_sd=0.8,
        foot=off(-0.35, 0.29),
        last=off(-0.56, 0.72, 0.07, 0.24, 1.31),
        usual_share=(1.12, 1.47),
    ),
    MeasureDefinition(
        girths.ball_girth_least,
        2,
        0.5,
        foot=off(-0.17, 0.70),
        last=off(0.34, 0.40, 0.62, 0.83, 0.96),
    ),
    MeasureDefinition(
        girths.waist_girth_least,
        3,
        0.3,
        foot=off(0.09, 0.00),
        last=off(-0.17, 0.39, 0.29, 0.43, 0.36),
        tilts=True,
    ),
    MeasureDefinition(
        girths.instep_girth_least,
        2,
        0.3,
        last_sd=0.25,
        foot=off(0.06, 0.36),
        last=off(0.02, 0.21, 0.17, 0.14, 0.22),
        tilts=True,
    ),
    MeasureDefinition(
        girths.heel_girth_instep,
        2,
        0.45,
        last_sd=0.55,
        foot=off(0.27, 0.34),
        last=off(-0.31, 0.74, 0.71, 0.37, 0.66),
        tilts=True,
    ),
    MeasureDefinition(
        widths.heel_width,
        2,
        0.2,
        last_sd=0.1,
        foot=off(-0.08, 0.18),
        last=off(-0.03, 0.13, 0.15, 0.14, 0.11),
        usual_share=(0.19, 0.35),
    ),
    MeasureDefinition(
        heights.arch_height,
        1,
        0.2,
        foot=off(-0.47, 0.61),
        last=off(0.18, 0.00, 0.16, 0.00, 0.10),
        tilts=True,
    ),
    MeasureDefinition(
        heights.instep_height,
        1,
        0.25,
        last_sd=0.2,
        foot=off(-0.53, 0.73),
        last=off(0.12, 0.19, 0.21, 0.17, 0.24),
        tilts=True,
    ),
    MeasureDefinition(
        heights.toe_height, 1, 0.25, foot=off(-0.19, 0.20), last=off(0.11, 0.28, 0.22, 0.29, 0.40)
    ),
    MeasureDefinition(
        heights.toe_spring,
        3,
        0.2,
        last_sd=0.25,
        foot=off(-0.25, 0.52),
        last=off(0.04, 0.00, 0.00, 0.00, 0.13),
    ),
    MeasureDefinition(heights.heel_height, 3, 0.5, last=off(-0.83, 0.00, 1.30, 1.10, 0.70)),
    MeasureDefinition(
        widths.bottom_width_ball, 2, 0.3, LAST, last=off(0.21, 0.33, 0.23, 0.31, 0.27)
    ),
    MeasureDefinition(
        widths.bottom_width_heel, 2, 0.2, LAST, last=off(-0.01, 0.00, 0.00, 0.00, 0.11)
    ),
    MeasureDefinition(lengths.tape_length, 3, 0.3, LAST, last=off(-0.26, 0.13, 0.40, 0.43, 0.56)),
    MeasureDefinition(lengths.stick_length, 2, 0.3, LAST, last=off(-0.01, 0.15, 0.15, 0.08, 0.42)),
    MeasureDefinition(lengths.bottom_length, 2, 0.35, LAST, last=off(0.15, 0.48, 0.41, 0.37, 0.72)),
    MeasureDefinition(
        heights.toe_spring_tip, 1, 0.45, LAST, last=off(0.21, 0.40, 0.30, 1.48, 0.14)
    ),
    MeasureDefinition(lengths.tread_from, 1, 2.0, LAST, last=off(0.17, 1.12, 0.00, 0.48, 0.22)),
    MeasureDefinition(lengths.tread_to, 1, 2.0, LAST, last=off(-2.21, 3.73, 4.95, 1.42, 0.69)),
    MeasureDefinition(
        heights.seat_angle_deg, 1, 0.4, LAST, last=off(-0.15, 0.22, 0.00, 0.00, 0.00)
    ),
)


def at_rest(shape: Shape) -> Shape | None:
    """A last as it rests on its seat and its tread; how it stands stays. It is kept.

    None if it rests there already, of a foot, and of an open bottom.
    """
    kept: dict[str, Shape | None] = vars(shape)
    if "at_rest" not in kept:
        kept["at_rest"] = _laid_down(shape)
    return kept["at_rest"]


def _laid_down(shape: Shape) -> Shape | None:
    """A last, turned in the side view until it rests on its seat and its tread."""
    if shape.kind == "foot" or shape.stance is None:
        return None
    waist_mm = shape.x_mm(LANDMARKS.waist)
    tilt = resting_tilt(shape.vertices_mm, shape.low, waist_mm, shape.length_mm)
    if tilt is None or abs(tilt.angle) < LEAST_TILT:
        return None
    rests = Shape(tilt.levelled(shape.vertices_mm), shape.faces, shape.kind, shape.labels)
    vars(rests)["stance"] = shape.stance.turned(tilt.angle, tilt.height_mm)
    return rests


def measure_named(name: str) -> MeasureDefinition:
    """The entry of that name."""
    return next(entry for entry in MEASURES if entry.name == name)


def of_kind(kind: str) -> tuple[MeasureDefinition, ...]:
    """The entries of the table that a "foot" or a "last" has."""
    return tuple(entry for entry in MEASURES if kind in entry.kinds)


def unusual(entry: MeasureDefinition, value: float, length_mm: float) -> str | None:
    """Why a value is unusual for a foot, or None if it is within the survey's range.

    Examples
    --------
    >>> unusual(MEASURES[0], 250.0, 250.0)
    >>> unusual(MEASURES[5], 300.0, 250.0)
    'ball girth 300.0 mm is 1.20 of the length; feet have 0.77-1.10'
    """
    words = f"{entry.name.replace('_', ' ')} {plain(value)} mm is"
    if entry.usual_mm is not None and not entry.usual_mm[0] <= value <= entry.usual_mm[1]:
        low, high = entry.usual_mm
        return f"{words} unusual; feet have {low:.0f}-{high:.0f} mm"
    if entry.usual_share is not None:
        low, high = entry.usual_share
        if not low <= value / length_mm <= high:
            return f"{words} {value / length_mm:.2f} of the length; feet have {low:.2f}-{high:.2f}"
    return None
