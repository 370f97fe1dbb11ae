"""What a fit profile asks of each zone, and how a foot fares in a last."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from footfit.results.values import Json, Part, exact, fields, part

if TYPE_CHECKING:
    from footfit.results.values import Measured, SideName, Verdict


@dataclass(frozen=True, slots=True)
class ZoneRule:
    """What a fit profile asks of one zone, in the zone's unit; a clearance is last minus foot.

    ``good`` holds ``target``, ``acceptable`` holds ``good``, ``poor`` holds ``acceptable``; what is
    outside of ``poor`` is a reject, None never is one. ``weight`` counts in the distance; 0 shows
    the zone and judges nothing by it. Without a ``required`` zone no last is good. ``cavity`` is
    what lining, insole and counter take from the last, and is taken off first.
    """

    zone: str
    target: float
    good: tuple[float, float]
    acceptable: tuple[float, float]
    poor: tuple[float, float] | None
    weight: float
    required: bool
    cavity: float

    def to_dict(self) -> Json:
        """The rule without its zone's name, which is its key."""
        return exact(fields(self, "zone"))


@dataclass(frozen=True, slots=True)
class FitProfile:
    """What kind of shoe is fitted: a rule for each zone, in the order in which they are judged.

    ``sha256`` is of the values, not of the file: a comment changes nothing. Two distances that
    differ by at most ``tie_sds`` standard deviations of their difference are a tie.
    """

    name: str
    version: int
    summary: str
    tie_sds: float
    zones: tuple[ZoneRule, ...]
    sha256: str

    def to_dict(self) -> Json:
        """The whole profile, its rules by zone."""
        rules = {rule.zone: rule.to_dict() for rule in self.zones}
        return exact(fields(self, "zones")) | {"zones": rules}


@dataclass(frozen=True, slots=True)
class ZoneFit(Part):
    """One foot in one zone of a last.

    ``clearance`` is in ``unit``, ``target`` what the profile asks, ``score`` 0 at the target and
    1 at the edge of good, - tight and + loose. ``verdict`` and ``score`` are None where the
    clearance is not measured. ``counts`` False: another foot of the pair governs this zone, or
    its weight is 0.
    """

    zone: str
    unit: str
    clearance: Measured
    target: float
    score: float | None
    verdict: Verdict | None
    counts: bool

    not_written = ("zone",)


@dataclass(frozen=True, slots=True)
class FootFit(Part):
    """One foot of the customer in one last; ``verdict`` is the worst of the zones that count."""

    side: SideName | None
    verdict: Verdict
    zones: tuple[ZoneFit, ...]

    def _keys(self) -> Json:
        return fields(self) | {"zones": part({zone.zone: zone for zone in self.zones})}
