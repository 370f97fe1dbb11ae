"""What ratings of worn shoes say of a fit profile."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from footfit.results.fit import FitProfile, ZoneRule
from footfit.results.values import Document, Json, Part, fields

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats, Ints

Status = Literal["applied", "shown", "too_few"]


@dataclass(frozen=True, slots=True)
class RatedClearances:
    """What a picture of one zone shows.

    ``clearance_mm`` (n,) and ``rating`` (n,) are the ratings; ``curve`` (k, 3) holds clearances in
    mm with the mean rating that the profile expects there, and that the ratings taught.
    """

    clearance_mm: Floats
    rating: Ints
    curve: Floats


@dataclass(frozen=True, slots=True)
class ZoneEvidence(Part):
    """What ratings say of one zone, in mm.

    ``after`` is the zone's rule after the ratings; it is the profile's own unless ``status`` is
    "applied". ``losses`` are the mean log losses of ratings that were held out: by the profile, and
    by what the others taught. ``reason`` says why a zone keeps its rule. ``shown`` is for pictures.
    """

    before: ZoneRule
    after: ZoneRule
    status: Status
    reason: str | None
    ratings: int
    wearers: int
    target_mm: float | None = None
    target_interval_mm: tuple[float, float] | None = None
    spread_mm: float | None = None
    spread_interval_mm: tuple[float, float] | None = None
    losses: tuple[float, float] | None = None
    shown: RatedClearances | None = None

    not_written = ("shown",)

    @property
    def zone(self) -> str:
        """The name of the zone."""
        return self.before.zone


@dataclass(frozen=True, slots=True)
class Calibration(Document):
    """A fit profile before and after ratings; the same profile if no zone changed.

    ``left_out`` counts entries by the reason why they do not count.
    """

    before: FitProfile
    after: FitProfile
    zones: tuple[ZoneEvidence, ...]
    entries: int
    left_out: Mapping[str, int]

    schema = "calibrate-profile/1"

    @property
    def applied(self) -> tuple[str, ...]:
        """The zones that changed."""
        return tuple(zone.zone for zone in self.zones if zone.status == "applied")

    def _keys(self) -> Json:
        zones = {zone.zone: zone.to_dict() for zone in self.zones}
        left_out = dict(self.left_out)
        return fields(self) | {"zones": zones, "left_out": left_out, "applied": list(self.applied)}
