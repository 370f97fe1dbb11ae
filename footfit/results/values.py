"""What every result is made of: measured values, notices, and the words they use."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

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
