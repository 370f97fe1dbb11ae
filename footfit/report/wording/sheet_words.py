"""What the customer's sheet says: plain words for one customer, from the verdict of each zone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from footfit.number_words import plain, rounded
from footfit.report.wording.text import shown_size_text
from footfit.results import Candidate, FootFit, Measured, SideName, Verdict, ZoneFit
from footfit.results.values import VERDICTS

EQUALLY_WIDE_MM = 2.0
"""Feet whose ball girths differ by less are equally wide: scans repeat to about 0.8 mm."""
DEGREES: dict[Verdict, str] = {
    "good": "",
    "acceptable": "a little ",
    "poor": "too ",
    "reject": "far too ",
}
MONTHS = (
    *("January", "February", "March", "April", "May", "June", "July"),
    *("August", "September", "October", "November", "December"),
)


@dataclass(frozen=True, slots=True)
class Place:
    """A place of the foot that customers know, and what a zone there is if it is tight or loose."""

    name: str
    tight: str
    loose: str


TOES, BALL, INSTEP, HEEL, SOLE = "toes", "ball", "instep", "heel", "sole"
PLACES = {
    "length": Place(TOES, "short", "long"),
    "toe_height": Place(TOES, "low over the toes", "high over the toes"),
    "toes": Place(TOES, "tight around the toes", "wide around the toes"),
    "ball_line": Place(BALL, "far back with its widest part", "far forward with its widest part"),
    "ball_girth": Place(BALL, "tight at the ball", "wide at the ball"),
    "ball_width": Place(BALL, "narrow at the ball", "wide at the ball"),
    "ball_width_orthogonal": Place(BALL, "narrow at the ball", "wide at the ball"),
    "waist_girth": Place(INSTEP, "tight behind the ball", "loose behind the ball"),
    "instep_girth": Place(INSTEP, "tight at the instep", "loose at the instep"),
    "instep_height": Place(INSTEP, "low at the instep", "high at the instep"),
    "short_heel_girth": Place(HEEL, "tight around the heel", "loose around the heel"),
    "long_heel_girth": Place(HEEL, "tight from heel to instep", "loose from heel to instep"),
    "heel_width": Place(HEEL, "narrow at the heel", "wide at the heel"),
    "flare": Place(SOLE, "straight along the sole", "curved along the sole"),
    "plan": Place(SOLE, "different in the shape of the sole", "different in the shape of the sole"),
}


def rank(verdict: Verdict | None) -> int:
    """How bad a verdict is: 0 is good; -1 is none."""
    return -1 if verdict is None else VERDICTS.index(verdict)


def place_verdicts(fit: FootFit) -> dict[str, Verdict]:
    """The worst verdict of the zones that count at each place, for one foot."""
    worst: dict[str, Verdict] = {}
    for zone in _judged(fit):
        place = PLACES[zone.zone].name
        worst[place] = max((zone.verdict or "good", worst.get(place, "good")), key=rank)
    return worst


def _judged(fit: FootFit) -> list[ZoneFit]:
    return [
        zone
        for zone in fit.zones
        if zone.counts and zone.verdict is not None and zone.zone in PLACES
    ]


def fit_words(candidate: Candidate) -> str:
    """One sentence on how a shoe fits: its toe room, and each place that is not good.

    The places that it names are those with a verdict that is not good, the worst first. If only
    one foot of a pair has a verdict there, the sentence says which.
    """
    faults = _faults(candidate.fits)
    room = dict(candidate.clearance_mm).get("length", Measured(None)).value
    parts = []
    if room is not None:
        size = plain(abs(room))
        where = "of room in front of the toes" if room >= 0.0 else "shorter than the foot"
        parts.append(f"about {size} mm {where}")
    parts += faults or ["good everywhere else"]
    words = "; ".join(parts)
    lacking = _lacking(candidate)
    return words + (f"; not fully judged: {lacking}" if lacking else "")


def shoe_labels(candidate: Candidate) -> str:
    """The style and the size of a shoe, as the maker labels it, and in the shop's size system."""
    return ", ".join(part for part in (candidate.style, shown_size_text(candidate)) if part)


def _faults(fits: Sequence[FootFit]) -> list[str]:
    """What is not good: the worst of each place, a part for each degree, the worst part first."""
    places: dict[str, list[_Fault]] = {}
    for fit in fits:
        for zone in _judged(fit):
            fault = _Fault(rank(zone.verdict), abs(zone.score or 0.0), zone, fit.side)
            if fault.level > 0:
                places.setdefault(PLACES[zone.zone].name, []).append(fault)
    degrees: dict[int, list[str]] = {}
    for faults in sorted(places.values(), key=lambda known: max(known).badness, reverse=True):
        worst = max(faults)
        sides = {fault.side for fault in faults if fault.level == worst.level}
        alone = len(fits) > 1 and len(sides) == 1 and worst.zone.zone != "length"
        words = f"{worst.words} ({worst.side} foot)" if alone and worst.side else worst.words
        degrees.setdefault(worst.level, []).append(words)
    return [DEGREES[VERDICTS[level]] + ", ".join(words) for level, words in degrees.items()]


@dataclass(frozen=True, slots=True)
class _Fault:
    """One zone of one foot that is not good; the worse one is greater."""

    level: int
    score: float
    zone: ZoneFit
    side: SideName | None

    @property
    def badness(self) -> tuple[int, float]:
        return self.level, self.score

    def __lt__(self, other: _Fault) -> bool:
        return self.badness < other.badness

    @property
    def words(self) -> str:
        place = PLACES[self.zone.zone]
        return place.loose if (self.zone.score or 0.0) > 0.0 else place.tight


def _lacking(candidate: Candidate) -> str:
    """The places where a zone could not be judged, and no fault is known."""
    known = [place_verdicts(fit) for fit in candidate.fits]
    faulty = {place for fit in known for place, verdict in fit.items() if verdict != "good"}
    places = [PLACES[name].name for name in candidate.not_judged if name in PLACES]
    return ", ".join(dict.fromkeys(f"the {place}" for place in places if place not in faulty))


def difference_words(values_mm: Sequence[float], equal_mm: float, word: str) -> str:
    """How a left and a right measure differ: ``word`` is "long" or "wide".

    Examples
    --------
    >>> difference_words((251.5, 252.1), 1.0, "long")
    'Both feet are equally long.'
    >>> difference_words((254.0, 252.1), 1.0, "long")
    'The left foot is 1.9 mm longer.'
    """
    left, right = values_mm
    if rounded(abs(left - right)) < equal_mm:
        return f"Both feet are equally {word}."
    side = "left" if left > right else "right"
    more = {"long": "longer", "wide": "larger around the ball"}[word]
    return f"The {side} foot is {plain(abs(left - right))} mm {more}."


def date_words(day: date) -> str:
    """A day in words, the same on every machine.

    Examples
    --------
    >>> date_words(date(2026, 11, 3))
    '3 November 2026'
    """
    return f"{day.day} {MONTHS[day.month - 1]} {day.year}"
