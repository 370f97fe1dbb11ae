"""From the entries of the fit log to the ratings of each zone."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from footfit.errors import BadOption
from footfit.pipeline.evidence.ratings_model import RATINGS, Ratings
from footfit.results import FitEntry
from footfit.results.evidence.fit_entries import PLACES


@dataclass(frozen=True, slots=True)
class LogRatings:
    """The ratings of each zone, and how many entries were left out for each reason."""

    zones: Mapping[str, Ratings]
    left_out: Mapping[str, int]


def place_ratings(given: Iterable[str]) -> dict[str, int]:
    """The ratings of texts such as ``ball=+1``.

    Raises
    ------
    BadOption
        A text has no place that is known, or no rating from -2 to +2; or a place comes twice.
    """
    ratings: dict[str, int] = {}
    for text in given:
        place, _, said = (part.strip() for part in text.partition("="))
        if place not in PLACES:
            raise BadOption(f"{text!r} names no place; the places are {', '.join(PLACES)}")
        if said not in {f"{number:+d}" for number in RATINGS} | {str(n) for n in RATINGS}:
            words = "write a number from -2 (much too tight) to +2 (much too loose)"
            raise BadOption(f"{text!r} has no rating; {words}, such as {place}=+1")
        if place in ratings:
            raise BadOption(f"{place} is rated twice; give each place once")
        ratings[place] = int(said)
    return ratings


def log_ratings(
    entries: Iterable[FitEntry], profile: str, definitions: Mapping[str, str]
) -> LogRatings:
    """The ratings of each zone by entries that can be compared.

    Entries of another profile are left out. So is a zone whose measure had another definition than
    ``definitions`` has for it, or none. What was worn is taken off the clearances: a profile asks
    for a clearance without it, and a match adds what is worn.
    """
    rows: dict[str, list[tuple[float, float, int, str]]] = defaultdict(list)
    left_out: Counter[str] = Counter()
    for entry in entries:
        if entry.profile != profile:
            left_out["of another profile"] += 1
            continue
        if not entry.ratings:
            left_out["without a rating of a place"] += 1
            continue
        zones = {zone.zone: zone for zone in entry.zones}
        known = 0
        for place, rating in entry.ratings.items():
            for name in PLACES.get(place, ()):
                zone = zones.get(name)
                if zone is not None and zone.definition == definitions.get(name):
                    room = zone.clearance - zone.asked_more
                    rows[name].append((room, zone.sd**2, rating, entry.wearer_key))
                    known += 1
        if not known:
            left_out["of other definitions, or not measured where it was rated"] += 1
    return LogRatings({name: _ratings(of_zone) for name, of_zone in rows.items()}, dict(left_out))


def _ratings(rows: list[tuple[float, float, int, str]]) -> Ratings:
    clearance, variance, rating, who = zip(*rows, strict=True)
    _, wearer = np.unique(np.array(who), return_inverse=True)
    return Ratings(
        clearance_mm=np.array(clearance),
        variance_mm2=np.array(variance),
        rating=np.array(rating),
        wearer=wearer,
        random=np.zeros(len(rows)),
    )
