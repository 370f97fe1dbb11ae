"""What is measured in millimetres on a canonical right shape: one function a measure, one table.

A new measure is a function and an entry of ``MEASURES``. Its row in the catalogue, its key in JSON
and its line in the report follow. ``docs/measures.md`` has the definitions in full.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from footfit.geometry.measures.girths import (
    ball_girth,
    instep_girth,
    long_heel_girth,
    short_heel_girth,
    waist_girth,
)
from footfit.geometry.measures.heights import (
    arch_height,
    heel_height,
    instep_height,
    toe_height,
    toe_spring,
)
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.measures.lengths import (
    ball_length,
    functional_length,
    length,
    tape_length,
)
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.measures.widths import (
    ball_width,
    ball_width_orthogonal,
    bottom_width_ball,
    bottom_width_heel,
    heel_width,
)

BOTH, LAST = ("foot", "last"), ("last",)


@dataclass(frozen=True, slots=True)
class MeasureDefinition:
    """An entry of the table; all measures are in mm.

    ``version`` counts the changes of the definition, and ``definition`` says it in a line. ``sd``
    is the repeatability of the whole way from a scan, in any pose, with noise or ripple of 0.3 mm,
    or with a quarter of the faces (benchmarks/measures.py). ``usual_mm`` in mm, or ``usual_share``
    over the length, is the range of the feet of a survey's 6,068 people [ansur2].
    """

    value_of: Callable[[Shape], MeasureValue]
    version: int
    sd: float
    definition: str
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


# fmt: off
MEASURES: tuple[MeasureDefinition, ...] = (
    MeasureDefinition(length, 2, 0.25, "pternion to the foremost point, along X",
                      usual_mm=(200.0, 310.0)),
    MeasureDefinition(functional_length, 1, 0.25, "pternion to the toe farthest from it, in plan"),
    MeasureDefinition(ball_length, 1, 0.45, "pternion to MT1, along X", usual_share=(0.66, 0.80)),
    MeasureDefinition(ball_width, 2, 0.3, "MT1 to MT5, in plan (oblique)",
                      usual_share=(0.31, 0.46)),
    MeasureDefinition(ball_width_orthogonal, 1, 0.25,
                      "between the tangents along X at the forefoot", usual_share=(0.31, 0.46)),
    MeasureDefinition(ball_girth, 1, 0.6, "around the upright plane through MT1 and MT5",
                      usual_share=(0.77, 1.10)),
    MeasureDefinition(waist_girth, 1, 0.35, "around the section half-way from ball to instep"),
    MeasureDefinition(instep_girth, 1, 0.45, "around the section at half the length"),
    MeasureDefinition(long_heel_girth, 1, 0.4, "around the heel's base and the instep"),
    MeasureDefinition(short_heel_girth, 1, 0.6, "the least girth around the heel's base and "
                      "the ankle's bend, or a last's cone",
                      usual_share=(1.12, 1.47)),
    MeasureDefinition(heel_width, 2, 0.2, "across the heel at 1/6 of the length",
                      usual_share=(0.19, 0.35)),
    MeasureDefinition(arch_height, 1, 0.2, "the underside's greatest height along the inner arch"),
    MeasureDefinition(instep_height, 1, 0.3, "the top of the section at half the length"),
    MeasureDefinition(toe_height, 1, 0.3,
                      "lowest to highest point of the section at .92 of the length"),
    MeasureDefinition(toe_spring, 2, 0.3, "the underside at .94 of the length, over the ground"),
    MeasureDefinition(heel_height, 2, 0.6,
                      "how high a last's heel stands when its tread lies level"),
    MeasureDefinition(bottom_width_ball, 1, 0.4,
                      "feather edge to feather edge at .66 of the length", LAST),
    MeasureDefinition(bottom_width_heel, 1, 0.2,
                      "feather edge to feather edge at 1/6 of the length", LAST),
    MeasureDefinition(tape_length, 1, 0.25, "along the middle of the bottom", LAST),
)
# fmt: on


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
    words = f"{entry.name.replace('_', ' ')} {value:.1f} mm is"
    if entry.usual_mm is not None and not entry.usual_mm[0] <= value <= entry.usual_mm[1]:
        low, high = entry.usual_mm
        return f"{words} unusual; feet have {low:.0f}-{high:.0f} mm"
    if entry.usual_share is not None:
        low, high = entry.usual_share
        if not low <= value / length_mm <= high:
            return f"{words} {value / length_mm:.2f} of the length; feet have {low:.2f}-{high:.2f}"
    return None
