"""What is measured in millimetres on a canonical right shape: one function a measure, one table.

A new measure is a function and an entry of ``MEASURES``. Its row in the catalogue, its key in JSON
and its line in the report follow. ``docs/measures.md`` has the definitions in full.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from footfit.geometry.measures import girths, heights, lengths, widths
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.number_words import plain

BOTH, LAST = ("foot", "last"), ("last",)


@dataclass(frozen=True, slots=True)
class MeasureDefinition:
    """An entry of the table; a measure is in mm, or in degrees if its name ends in ``_deg``.

    The docstring of ``value_of`` is the definition, and ``version`` counts its changes. ``sd`` is
    the repeatability of the whole way from a scan, in any pose, with noise or ripple of 0.3 mm, or
    with a quarter of the faces (benchmarks/measures.py). ``usual_mm`` in mm, or ``usual_share``
    over the length, is the range of the feet of a survey's 6,068 people [ansur2].
    """

    value_of: Callable[[Shape], MeasureValue]
    version: int
    sd: float
    kinds: tuple[str, ...] = BOTH
    usual_mm: tuple[float, float] | None = None
    usual_share: tuple[float, float] | None = None

    @property
    def name(self) -> str:
        """The function's name: the key in JSON and in the catalogue."""
        return self.value_of.__name__

    @property
    def definition_id(self) -> str:
        """The name with the version: what a stored value was measured by."""
        return f"{self.name}/{self.version}"


MEASURES: tuple[MeasureDefinition, ...] = (
    MeasureDefinition(lengths.length, 2, 0.25, usual_mm=(200.0, 310.0)),
    MeasureDefinition(lengths.functional_length, 1, 0.25),
    MeasureDefinition(lengths.ball_length, 1, 0.45, usual_share=(0.66, 0.80)),
    MeasureDefinition(widths.ball_width, 2, 0.3, usual_share=(0.31, 0.46)),
    MeasureDefinition(widths.ball_width_orthogonal, 1, 0.25, usual_share=(0.31, 0.46)),
    MeasureDefinition(girths.ball_girth, 1, 0.6, usual_share=(0.77, 1.10)),
    MeasureDefinition(girths.waist_girth, 1, 0.35),
    MeasureDefinition(girths.instep_girth, 1, 0.45),
    MeasureDefinition(girths.long_heel_girth, 1, 0.4),
    MeasureDefinition(girths.short_heel_girth, 1, 0.6, usual_share=(1.12, 1.47)),
    MeasureDefinition(girths.ball_girth_least, 1, 0.6),
    MeasureDefinition(girths.waist_girth_least, 1, 0.35),
    MeasureDefinition(girths.instep_girth_least, 1, 0.4),
    MeasureDefinition(girths.heel_girth_instep, 1, 0.6),
    MeasureDefinition(widths.heel_width, 2, 0.2, usual_share=(0.19, 0.35)),
    MeasureDefinition(heights.arch_height, 1, 0.2),
    MeasureDefinition(heights.instep_height, 1, 0.3),
    MeasureDefinition(heights.toe_height, 1, 0.3),
    MeasureDefinition(heights.toe_spring, 3, 0.5),
    MeasureDefinition(heights.heel_height, 3, 1.2),
    MeasureDefinition(widths.bottom_width_ball, 1, 0.4, LAST),
    MeasureDefinition(widths.bottom_width_heel, 1, 0.2, LAST),
    MeasureDefinition(lengths.tape_length, 1, 0.25, LAST),
    MeasureDefinition(lengths.stick_length, 1, 0.3, LAST),
    MeasureDefinition(lengths.bottom_length, 2, 0.5, LAST),
    MeasureDefinition(heights.toe_spring_tip, 1, 0.8, LAST),
    MeasureDefinition(lengths.tread_from, 1, 2.0, LAST),
    MeasureDefinition(lengths.tread_to, 1, 2.0, LAST),
    MeasureDefinition(heights.seat_angle_deg, 1, 0.5, LAST),
)


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
