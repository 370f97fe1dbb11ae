"""What is measured in millimetres on a canonical right shape: one function a measure, one table.

A new measure is a function and an entry of ``MEASURES``; its row in the catalogue, its key in the
JSON and its line in the report follow. ``docs/measures.md`` has the definitions in full.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from footfit.geometry.landmarks import Shape
from footfit.geometry.measures_girths import (
    ball_girth,
    instep_girth,
    long_heel_girth,
    short_heel_girth,
    waist_girth,
)
from footfit.geometry.measures_heights import (
    arch_height,
    heel_height,
    instep_height,
    toe_height,
    toe_spring,
)
from footfit.geometry.measures_lengths import (
    ball_length,
    functional_length,
    length,
    tape_length,
)
from footfit.geometry.measures_widths import (
    ball_width,
    ball_width_orthogonal,
    bottom_width_ball,
    bottom_width_heel,
    heel_width,
)
from footfit.geometry.readings import Reading

BOTH, LAST = ("foot", "last"), ("last",)


@dataclass(frozen=True, slots=True)
class Measure:
    """An entry of the table.

    ``version`` counts the changes of the definition. ``sd`` is the repeatability of the whole way
    from a scan (any pose, noise of 0.3 mm, decimation to a quarter): benchmarks/measures.py.
    ``usual`` is the range over the length that nearly every foot and last lies in.
    """

    name: str
    version: int
    sd: float
    definition: str
    reading: Callable[[Shape], Reading]
    kinds: tuple[str, ...] = BOTH
    usual: tuple[float, float] | None = None

    @property
    def definition_id(self) -> str:
        """The name with the version: what a stored value was measured by."""
        return f"{self.name}/{self.version}"


def of_kind(kind: str) -> tuple[Measure, ...]:
    """The entries of the table that a "foot" or a "last" has."""
    return tuple(entry for entry in MEASURES if kind in entry.kinds)


# The limits hold 99 % of the feet of a large survey (fit over length); see docs/measures.md.
MEASURES: tuple[Measure, ...] = (
    Measure("length", 2, 0.5, "pternion to the foremost point, along X", length),
    Measure(
        "functional_length", 1, 0.5, "pternion to the farthest toe, in plan", functional_length
    ),
    Measure("ball_length", 1, 1.0, "pternion to MT1, along X", ball_length),
    Measure("ball_width", 2, 0.5, "MT1 to MT5, in plan", ball_width),
    Measure("ball_width_orthogonal", 1, 0.5, "between tangents along X", ball_width_orthogonal),
    Measure("ball_girth", 1, 1.0, "upright plane through MT1 and MT5", ball_girth),
    Measure("waist_girth", 1, 1.0, "half-way from ball to instep", waist_girth),
    Measure("instep_girth", 1, 1.0, "across X at half the length", instep_girth),
    Measure("long_heel_girth", 1, 1.0, "heel base and instep", long_heel_girth),
    Measure("short_heel_girth", 1, 1.0, "heel base and bend of the ankle", short_heel_girth),
    Measure("heel_width", 2, 0.5, "at one sixth of the length", heel_width),
    Measure("arch_height", 1, 0.5, "the inner arch, over the contact plane", arch_height),
    Measure("instep_height", 1, 0.5, "the top at half the length", instep_height),
    Measure("toe_height", 1, 0.5, "lowest to highest at .92 of the length", toe_height),
    Measure(
        "toe_spring", 1, 0.5, "the underside at .94 of the length, over the ground", toe_spring
    ),
    Measure("heel_height", 1, 1.0, "the seat over the tread's ground", heel_height),
    Measure("bottom_width_ball", 1, 0.5, "feather to feather", bottom_width_ball, LAST),
    Measure("bottom_width_heel", 1, 0.5, "feather to feather", bottom_width_heel, LAST),
    Measure("tape_length", 1, 0.5, "along the bottom", tape_length, LAST),
)
