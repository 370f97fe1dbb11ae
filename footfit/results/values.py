"""What every result is made of: measured values, notices, and the words they use."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from footfit.results.documents import Json, fields, part, rounded

if TYPE_CHECKING:
    from collections.abc import Iterable

SideName = Literal["left", "right"]
Confidence = Literal["sure", "low", "undecided"]
Method = Literal["footfit", "paper", "paper-literal"]
SearchBy = Literal["fit", "flare", "shape"]
Verdict = Literal["good", "acceptable", "poor", "reject"]


@dataclass(frozen=True, slots=True)
class Measured:
    """A measured value with its standard deviation, or the reason why there is none."""

    value: float | None
    sd: float | None = None
    reason: str | None = None

    def to_dict(self) -> Json:
        """``value`` and ``sd`` in mm, and a ``reason`` only where the value is null.

        Examples
        --------
        >>> Measured(262.31049, 0.4).to_dict()
        {'value': 262.31, 'sd': 0.4, 'reason': None}
        """
        value = rounded(self.value)
        reason = None if value is not None else self.reason or "not measured"
        return {"value": value, "sd": rounded(self.sd), "reason": reason}


FIT_NAMES = ("length", "ball_width", "ball_girth", "heel_width", "instep_girth")
"""The measures and clearances that every document names, measured or not."""

NOT_YET = Measured(None, reason="this version does not measure it")


@dataclass(frozen=True, slots=True)
class Measure:
    """One row of a shape's measures: a new measure is a new row, never a new column."""

    name: str
    measured: Measured
    definition: str


@dataclass(frozen=True, slots=True)
class Notice:
    """A warning: a stable ``code`` for scripts, a ``message`` for people."""

    code: str
    message: str

    def to_dict(self) -> Json:
        """Both, by name."""
        return part(fields(self))


def measures_part(measures: Iterable[Measure]) -> Json:
    """Every measure by its name; the ones every document names are never missing."""
    return measured_part((measure.name, measure.measured) for measure in measures)


def measured_part(values: Iterable[tuple[str, Measured]]) -> Json:
    """Measured values by name, completed with the names that every document has."""
    return part(dict.fromkeys(FIT_NAMES, NOT_YET) | dict(values))
