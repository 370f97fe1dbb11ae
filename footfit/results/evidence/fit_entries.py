"""What wearers said of worn shoes: the entries of the fit log."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from footfit.results.values import Document, Json, Part, SideName, exact, fields, part

Outcome = Literal["kept", "returned", "altered"]


@dataclass(frozen=True, slots=True)
class RatedZone(Part):
    """One zone as the match had it: the clearance with its standard deviation, both in ``unit``.

    ``definition`` is that of the measure; entries of another one cannot be compared. ``asked_more``
    is by how much more was asked of the zone because of a sock, an insole, the load or the time.
    """

    zone: str
    unit: str
    clearance: float
    sd: float
    definition: str
    asked_more: float = 0.0

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


PLACES: dict[str, tuple[str, ...]] = {
    "toe": ("length", "toe_height", "toes"),
    "ball": ("ball_girth", "ball_width"),
    "waist": ("waist_girth",),
    "instep": ("instep_girth",),
    "heel": ("heel_width", "short_heel_girth"),
    "opening": ("long_heel_girth",),
}
"""The places that a wearer can name, and the zones that a rating of each speaks for."""

OF_ENTRY = (
    *("id", "recorded", "wearer", "last", "last_sha256", "foot_sha256", "side"),
    *("profile", "profile_version", "profile_sha256", "footfit_version"),
    *("comfort", "outcome", "alteration", "hours", "days"),
)
OF_ZONE = ("place", "rating", "zone", "unit", "clearance", "sd", "definition", "asked_more")


@dataclass(frozen=True, slots=True)
class RecordOutcome(Document):
    """The entry that was stored."""

    entry: FitEntry

    schema = "record-fit/1"

    def _keys(self) -> Json:
        return {"status": "recorded", **self.entry._keys()}


@dataclass(frozen=True, slots=True)
class FitList(Document):
    """The entries of the fit log, oldest first."""

    entries: tuple[FitEntry, ...]

    columns = (*OF_ENTRY, *OF_ZONE)
    schema = "list-fits/1"

    def _keys(self) -> Json:
        return {"fits": list(self.entries)}

    def rows(self) -> list[Json]:
        """A row for each zone of each entry, with the rating that speaks for it, if there is one.

        A place that was rated and has no measured zone has a row of its own.
        """
        values = [
            (*(getattr(entry, name) for name in OF_ENTRY), *of_zone)
            for entry in self.entries
            for of_zone in _zone_rows(entry)
        ]
        return [dict(zip(self.columns, row, strict=True)) for row in values]


def _zone_rows(entry: FitEntry) -> list[tuple[object, ...]]:
    place_of = {zone: place for place, zones in PLACES.items() for zone in zones}
    rows: list[tuple[object, ...]] = []
    for zone in entry.zones:
        place = place_of.get(zone.zone)
        rating = None if place is None else entry.ratings.get(place)
        values = (zone.zone, zone.unit, zone.clearance, zone.sd, zone.definition, zone.asked_more)
        rows.append((None if rating is None else place, rating, *values))
    shown = {row[0] for row in rows}
    rows += [
        (place, rating, *(None,) * (len(OF_ZONE) - 2))
        for place, rating in entry.ratings.items()
        if place not in shown
    ]
    return rows or [(None,) * len(OF_ZONE)]


@dataclass(frozen=True, slots=True)
class ForgetOutcome(Document):
    """How many entries were removed for good, by the wearer's code or the entry's id."""

    asked: str
    entries: int

    schema = "forget-fits/1"

    def _keys(self) -> Json:
        return {"status": "forgotten", **fields(self)}
