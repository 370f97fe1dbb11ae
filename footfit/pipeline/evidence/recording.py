"""An entry of the fit log: what a match knew of a foot in a last, and what its wearer said."""

from __future__ import annotations

import re
import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from footfit.errors import BadOption, HalfScan
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.measures.measure_table import MEASURES
from footfit.locations import Location
from footfit.pipeline.evidence.zone_ratings import place_ratings
from footfit.pipeline.fit.judging.judged_lasts import asked_of
from footfit.pipeline.fit.ranking import foot_fits, judged_last
from footfit.pipeline.fit.worn_shifts import measure_of
from footfit.results import (
    FitEntry,
    FitProfile,
    HeelQuestion,
    LastRecord,
    Profiled,
    RatedZone,
    Worn,
)
from footfit.results.evidence.fit_entries import Outcome
from footfit.results.worn import BAREFOOT
from footfit.version import __version__

CODE = re.compile(r"[A-Za-z0-9._-]{1,40}")
LONGEST_ALTERATION = 200
TOES = "toes/1"
"""The definition of the walls beside the toes; a change of it needs another number."""
NO_CONSENT = (
    "nothing was stored: the wearer must agree that ratings and clearances are kept;"
    " then add --consent"
)


@dataclass(frozen=True, slots=True)
class Said:
    """What a wearer said of a shoe; checked when it is made.

    Raises
    ------
    BadOption
        Nothing is said, or a value is not possible.
    """

    zones: Sequence[str] = ()
    comfort: float | None = None
    outcome: Outcome | None = None
    alteration: str | None = None
    hours: float | None = None
    days: float | None = None
    wearer: str | None = None

    def __post_init__(self) -> None:
        place_ratings(self.zones)
        if not self.zones and self.comfort is None and self.outcome is None:
            raise BadOption(
                "nothing is said of the fit; add --zone, --comfort, --kept, --returned or --altered"
            )
        if self.comfort is not None and not 0.0 <= self.comfort <= 100.0:
            raise BadOption(f"comfort {self.comfort:g} is not from 0 (worst) to 100 (best)")
        for name, value in (("hours", self.hours), ("days", self.days)):
            if value is not None and not 0.0 <= value <= 100_000.0:
                raise BadOption(f"{name} {value:g} is not possible")
        if self.wearer is not None and not CODE.fullmatch(self.wearer):
            raise BadOption(
                f"{self.wearer!r} is no code; take up to 40 letters, digits, dots and dashes,"
                " and never a name"
            )
        if self.alteration is not None and not 0 < len(self.alteration) <= LONGEST_ALTERATION:
            raise BadOption(f"say in 1 to {LONGEST_ALTERATION} characters what was altered")


def fit_entry(
    foot: Profiled,
    last: LastRecord,
    profile: FitProfile,
    heel: HeelQuestion,
    said: Said,
    worn: Worn = BAREFOOT,
    file: Location | None = None,
) -> FitEntry:
    """The entry for a foot that wore a shoe on this last, with the clearances of a match.

    ``file`` is the catalogue that holds the sections of the last, for its toe box.

    Raises
    ------
    HalfScan
        The length of the foot is not known.
    """
    alignment = foot.aligned.alignment
    if alignment.length.value is None:
        words = f"{alignment.length.reason}; its clearances are not known: scan again"
        raise HalfScan(words, alignment.info.path)
    asked = asked_of([foot], profile, "fit", heel, worn)
    (fit,) = foot_fits(judged_last(asked, last, file), 0, last)
    known = definitions()
    zones = [
        RatedZone(
            zone=zone.zone,
            unit=zone.unit,
            clearance=zone.clearance.value,
            sd=zone.clearance.sd or 0.0,
            definition=known.get(zone.zone, ""),
            asked_more=asked.shifts[0][zone.zone].more,
        )
        for zone in fit.zones
        if zone.clearance.value is not None
    ]
    return FitEntry(
        id=secrets.token_hex(6),
        recorded=datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        last=last.labels.name,
        last_sha256=last.info.sha256,
        foot_sha256=alignment.info.sha256,
        side=alignment.side.side,
        wearer=said.wearer,
        profile=profile.name,
        profile_version=profile.version,
        profile_sha256=profile.sha256,
        worn={"drop_mm": last.drop_mm} | worn.to_dict(),
        zones=tuple(zones),
        ratings=place_ratings(said.zones),
        comfort=said.comfort,
        outcome=said.outcome,
        alteration=said.alteration,
        hours=said.hours,
        days=said.days,
        footfit_version=__version__,
    )


def definitions() -> dict[str, str]:
    """The definition of each zone's measure: only lasts that have it are judged in the zone."""
    by_name = {measure.name: measure.definition_id for measure in MEASURES}
    length, ball = by_name[measure_of("length")], by_name["ball_length"]
    flare = FlareDefinition().version
    return by_name | {
        "length": length,
        "ball_line": ball,
        "flare": flare,
        "plan": flare,
        "toes": TOES,
    }
