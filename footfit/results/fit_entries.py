"""What wearers said of worn shoes: the entries of the fit log."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from footfit.results.values import Document, Json, Part, SideName, exact, fields, part, rows

Outcome = Literal["kept", "returned", "altered"]


@dataclass(frozen=True, slots=True)
class RatedZone(Part):
    """One zone as the match had it: the clearance with its standard deviation, both in ``unit``.

    ``definition`` is that of the measure; entries of another one cannot be compared.
    """

    zone: str
    unit: str
    clearance: float
    sd: float
    definition: str

    not_written = ("zone",)

    def _keys(self) -> Json:
        return exact(fields(self, "zone"))


@dataclass(frozen=True, slots=True)
class FitEntry(Part):
    """One foot in one shoe that was worn, and what the wearer said of it.

    ``ratings`` are by place, from -2 (much too tight) to +2 (much too loose). ``comfort`` is from 0
    to 100. ``worn`` says with what the match was computed: socks, insoles, the drop. ``id`` is
    random; ``wearer`` is a code that the shop chose, or None. The foot is known by the hash of its
    scan; nothing can be computed back from it.
    """

    id: str
    recorded: str
    last: str
    last_sha256: str
    foot_sha256: str
    side: SideName | None
    wearer: str | None
    profile: str
    profile_version: int
    profile_sha256: str
    worn: Mapping[str, object]
    zones: tuple[RatedZone, ...]
    ratings: Mapping[str, int]
    comfort: float | None = None
    outcome: Outcome | None = None
    alteration: str | None = None
    hours: float | None = None
    days: float | None = None
    footfit_version: str = ""

    @property
    def wearer_key(self) -> str:
        """Who rated: the wearer's code; without one, every foot is a wearer."""
        return f"foot {self.foot_sha256}" if self.wearer is None else f"code {self.wearer}"

    def _keys(self) -> Json:
        return fields(self) | {"zones": part({zone.zone: zone for zone in self.zones})}


COLUMNS = (
    *("id", "recorded", "wearer", "last", "side", "profile", "profile_version"),
    *("comfort", "outcome", "alteration", "hours", "days"),
)


@dataclass(frozen=True, slots=True)
class FitList(Document):
    """The entries of the fit log, oldest first."""

    entries: tuple[FitEntry, ...]

    schema = "fits/1"
    rows_by = "fits"

    def _keys(self) -> Json:
        return {"fits": list(self.entries)}

    def to_rows(self) -> list[Json]:
        """One row for each entry; ratings and clearances have a column for each place and zone."""
        places = sorted({place for entry in self.entries for place in entry.ratings})
        zones = list(dict.fromkeys(z.zone for entry in self.entries for z in entry.zones))
        columns = (
            *COLUMNS,
            *(f"rating_{place}" for place in places),
            *(f"clearance_{zone}" for zone in zones),
        )
        return rows(columns, (_row(entry, places, zones) for entry in self.entries))


def _row(entry: FitEntry, places: list[str], zones: list[str]) -> list[object]:
    clearance = {zone.zone: zone.clearance for zone in entry.zones}
    return [
        *(getattr(entry, name) for name in COLUMNS),
        *(entry.ratings.get(place) for place in places),
        *(clearance.get(zone) for zone in zones),
    ]


@dataclass(frozen=True, slots=True)
class ForgetOutcome(Document):
    """How many entries were removed for good, by the wearer's code or the entry's id."""

    asked: str
    entries: int

    schema = "forget-fits/1"
