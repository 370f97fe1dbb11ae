"""A fit in words: one plain sentence for each last, with zones and mm."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.geometry.fit.sizes import EQUALLY_LONG_MM, SYSTEMS, foot_size, system_named
from footfit.number_words import UNITS, plain, rounded, some_digits
from footfit.pipeline.fit.zones import ZONES, Zone
from footfit.results import Notice, Profiled, ZoneFit, ZoneRule
from footfit.results.values import VERDICTS

WORTH_SAYING = 0.5
"""The score from which on a zone is named: half-way to the edge of good."""
DEFAULT_SYSTEM = "eu"
GIRTH_WORDS = {"tighter": "smaller", "looser": "larger"}
"""What a sentence says of a girth; the codes of rejects keep the other words."""


def flare_words(delta_deg: float, sd_deg: float, digits: int = 1) -> str:
    """The flare difference (last minus foot) in words.

    Examples
    --------
    >>> flare_words(-2.13, 0.2)
    'turns 2.1 deg less inward than the foot'
    >>> flare_words(0.1, 0.2)
    'turns inward as the foot does'
    """
    if abs(delta_deg) <= sd_deg:
        return "turns inward as the foot does"
    more = "more" if delta_deg > 0 else "less"
    return f"turns {plain(abs(delta_deg), digits)} deg {more} inward than the foot"


def zone_words(zone: str, clearance: float, target: float, sd: float = 0.0, digits: int = 1) -> str:
    """One zone's clearance, and what is wanted.

    Examples
    --------
    >>> zone_words("length", 12.6, 13.0), zone_words("length", -4.0, 13.0)
    ('12.6 mm toe room (wanted: 13 mm)', '4.0 mm shorter than the foot')
    >>> zone_words("short_heel_girth", 14.6, -4.0)
    'short heel girth: 14.6 mm larger than the foot (wanted: 4 mm smaller)'
    >>> zone_words("ball_girth", 0.0, 0.0), zone_words("ball_line", 2.4, 0.0)
    ('ball girth: the same as the foot (wanted: the same)', 'ball line 2.4 % too far forward')
    """
    kind, off = ZONES[zone], clearance - target
    if zone == "length" and clearance < 0:
        return f"{plain(-clearance, digits)} mm shorter than the foot"
    if zone == "length":
        return f"{plain(clearance, digits)} mm toe room (wanted: {target:g} mm)"
    if zone == "flare":
        return flare_words(clearance, sd, digits)
    if kind.unit == "ratio":
        return f"{kind.label} differs by {plain(clearance, max(digits, 2))} (0 = the same)"
    if kind.unit == "percent":
        return f"{kind.label} {plain(abs(off), digits)} % {kind.more if off > 0 else kind.less}"
    size = plain(abs(clearance), digits)
    there = _than(kind, clearance, size, " than the foot", " as the foot")
    return f"{kind.label}: {there} (wanted: {_than(kind, target, f'{abs(target):g}')})"


def _than(kind: Zone, clearance: float, size: str, than: str = "", same: str = "") -> str:
    """How much larger or smaller a last is in one zone: "4 mm smaller"."""
    if not float(size):
        return f"the same{same}"
    word = kind.more if clearance > 0 else kind.less
    return f"{size} mm {GIRTH_WORDS.get(word, word)}{than}"


def place_words(place: str, clearance_mm: float, digits: int = 1) -> str:
    """A toe and the wall beside it, in words.

    Examples
    --------
    >>> place_words("big toe, inner wall", -3.2), place_words("little toe, outer wall", 1.4)
    ('big toe 3.2 mm through the inner wall', 'little toe 1.4 mm from the outer wall')
    """
    toe, _, wall = place.partition(", ")
    way = "through" if clearance_mm < 0.0 else "from"
    return f"{toe} {plain(abs(clearance_mm), digits)} mm {way} the {wall}"


def judged_words(zone: ZoneFit) -> str:
    """One zone that has a clearance, in words."""
    value = zone.clearance.value
    assert value is not None
    if zone.place is not None:
        return place_words(zone.place, value, zone.digits)
    return zone_words(zone.zone, value, zone.target, zone.clearance.sd or 0.0, zone.digits)


def best_sentence(zones: Sequence[ZoneFit]) -> str:
    """Why the first is first: its toe room, and what it is furthest off in."""
    others = _notable(zones)
    worst = judged_words(others[0]) if others else "near the target in every zone judged"
    return f"{toe_room_words(zones)}; {worst}"


def behind_sentence(zones: Sequence[ZoneFit], costs: Sequence[float], first: str) -> str:
    """Why a last stands behind the first: the zone that costs it most, by ``costs``."""
    room = toe_room_words(zones)
    worst, cost = max(zip(zones, costs, strict=True), key=lambda pair: pair[1])
    if cost <= 0.0 or worst.score is None:
        return f"{room}; a little further off in several zones than {first}"
    if worst.zone == "length":
        return f"{room}: further off than {first}"
    return f"{room}; {judged_words(worst)}, behind {first} by that"


def missed_sentence(zones: Sequence[ZoneFit], rules: Sequence[ZoneRule]) -> str:
    """Why a last does not fit: each zone that rejects it, and by how much it misses."""
    words = []
    for zone, rule in zip(zones, rules, strict=True):
        value = zone.clearance.value
        if not zone.counts or zone.verdict != "reject" or value is None or rule.poor is None:
            continue
        miss = max(rule.poor[0] - value, value - rule.poor[1])
        unit = UNITS[zone.unit]
        words.append(f"{judged_words(zone)}, {some_digits(miss)}{unit} past the limit")
    return "; ".join(words) or toe_room_words(zones)


def toe_room_words(zones: Sequence[ZoneFit]) -> str:
    """The toe room of the foot that governs the length, in words."""
    return next(judged_words(zone) for zone in zones if zone.zone == "length" and zone.counts)


def _notable(zones: Sequence[ZoneFit]) -> list[ZoneFit]:
    """The zones but the length that are worth a word, the worst first."""
    scores = [(zone, abs(zone.score or 0.0)) for zone in zones if zone.counts]
    notable = [pair for pair in scores if pair[0].zone != "length" and pair[1] >= WORTH_SAYING]
    notable.sort(key=lambda pair: (-VERDICTS.index(pair[0].verdict or "good"), -pair[1]))
    return [zone for zone, _ in notable]


def not_judged(zones: Sequence[ZoneFit]) -> tuple[str, ...]:
    """The zones that count and were not judged, by name, each once, in their order."""
    return tuple(dict.fromkeys(z.zone for z in zones if z.counts and z.score is None))


def unknown_words(zones: Sequence[ZoneFit], required: Sequence[bool]) -> str:
    """The required zones that were not judged, as the end of a sentence; empty without any."""
    names = not_judged([zone for zone, needed in zip(zones, required, strict=True) if needed])
    return f"; not judged: {zone_list(names)}" if names else ""


def zone_list(names: Sequence[str]) -> str:
    """Zones as people read them.

    Examples
    --------
    >>> zone_list(("ball_girth", "ball_line"))
    'ball girth, ball line'
    """
    return ", ".join(ZONES[name].label for name in names)


ONE_CUSTOMER_MM = 20.0
"""Two feet whose lengths differ by more are probably not of one person."""


def pair_notice(feet: Sequence[Profiled], system_name: str | None) -> Notice | None:
    """How the feet of a pair differ, with advice if it is by a size or more.

    None for one foot, or if a length is not known.
    """
    known = [(foot.length_mm, foot) for foot in feet if foot.length_mm is not None]
    if len(known) != 2:
        return None
    system = system_named(system_name) or SYSTEMS[DEFAULT_SYSTEM]
    (long_mm, longer), (short_mm, shorter) = sorted(known, key=lambda pair: -pair[0])
    apart_mm = long_mm - short_mm
    if rounded(apart_mm) < EQUALLY_LONG_MM:
        words = f"the feet are equally long: they differ by {plain(apart_mm)} mm"
        return Notice("pair_difference", words)
    side, other = (f.aligned.alignment.side.side for f in (longer, shorter))
    which = f"{side} foot" if side and side != other else "longer foot"
    difference = f"the {which} is {plain(apart_mm)} mm longer and decides the size and the length"
    if apart_mm > ONE_CUSTOMER_MM:
        return Notice("pair_differs_widely", f"{difference}: are these one customer's feet?")
    sizes = apart_mm / (system.step_mm * system.numbers_per_size)
    if sizes < 1.0:
        return Notice("pair_difference", difference)
    larger, smaller = (foot_size(mm, system).words for mm in (long_mm, short_mm))
    advice = f"that is {plain(sizes)} sizes: think of two sizes, {larger} and {smaller}"
    return Notice("feet_differ_by_a_size", f"{difference}; {advice}, or fit the shorter with a pad")
