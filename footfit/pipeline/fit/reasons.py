"""A fit in words: one plain sentence a last, in terms of zone and mm."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.geometry.fit.sizes import SYSTEMS, foot_size, system_named
from footfit.pipeline.fit.scoring import VERDICTS, Column
from footfit.pipeline.fit.zones import ZONES
from footfit.results import Notice, Profiled, ZoneFit, ZoneRule

WORTH_SAYING = 0.5
"""The score from which a zone is worth a word: half-way to the edge of good."""
DEFAULT_SYSTEM = "eu"


def length_words(clearance_mm: float, target_mm: float) -> str:
    """The length clearance in words.

    Examples
    --------
    >>> length_words(12.6, 13.0)
    '12.6 mm toe room (asked 13)'
    >>> length_words(-4.0, 13.0)
    '4.0 mm shorter than the foot'
    """
    if clearance_mm < 0:
        return f"{-clearance_mm:.1f} mm shorter than the foot"
    return f"{clearance_mm:.1f} mm toe room (asked {target_mm:g})"


def flare_words(delta_deg: float, sd_deg: float) -> str:
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
    return (
        f"turns {abs(delta_deg):.1f} deg {'more' if delta_deg > 0 else 'less'} inward than the foot"
    )


def zone_words(zone: str, clearance: float, target: float, sd: float = 0.0) -> str:
    """One zone's clearance against what is asked.

    Examples
    --------
    >>> zone_words("ball_girth", -3.0, 0.0), zone_words("ball_line", 2.4, 0.0)
    ('ball girth 3.0 mm tighter than asked', 'ball line 2.4 % too far forward')
    """
    if zone == "length":
        return length_words(clearance, target)
    if zone == "flare":
        return flare_words(clearance, sd)
    kind, off = ZONES[zone], clearance - target
    word = kind.more if off > 0 else kind.less
    if kind.unit == "ratio":
        return f"{kind.label} differs by {clearance:.2f}"
    if kind.unit == "percent":
        return f"{kind.label} {abs(off):.1f} % {word}"
    return f"{kind.label} {abs(off):.1f} mm {word} than asked"


def said(zone: ZoneFit) -> str:
    """One judged zone in words."""
    assert zone.clearance.value is not None
    return zone_words(zone.zone, zone.clearance.value, zone.target, zone.clearance.sd or 0.0)


def best_sentence(zones: Sequence[ZoneFit]) -> str:
    """Why the first is first: its toe room, and what it is furthest off in."""
    room, others = _room(zones), _notable(zones)
    if not others:
        return f"{room}; near the target in every zone judged"
    return f"{room}; {said(others[0])}"


def behind_sentence(zones: Sequence[ZoneFit], cost: Sequence[float], first: str) -> str:
    """Why a last stands behind the first: the zone that costs it most, by ``cost``."""
    room = _room(zones)
    worst = max(range(len(zones)), key=lambda i: cost[i])
    if cost[worst] <= 0.0 or zones[worst].score is None:
        return f"{room}; a little further off in several zones than {first}"
    if zones[worst].zone == "length":
        return f"{room}: further off than {first}"
    return f"{room}; {said(zones[worst])}, behind {first} by that"


def missed_sentence(zones: Sequence[ZoneFit], rules: Sequence[ZoneRule]) -> str:
    """Why a last does not fit: each zone that rejects it, and by how much it misses."""
    words = []
    for zone, rule in zip(zones, rules, strict=True):
        rejects = zone.counts and zone.verdict == "reject"
        if not rejects or zone.clearance.value is None or rule.poor is None:
            continue
        low, high = rule.poor
        value = zone.clearance.value
        miss, kind = (low - value if value < low else value - high), ZONES[zone.zone]
        unit = {"percent": "%", "ratio": ""}.get(kind.unit, kind.unit)
        words.append(f"{said(zone)}, {miss:.1f} {unit} past the limit".replace("  ", " "))
    return "; ".join(words) or _room(zones)


def _room(zones: Sequence[ZoneFit]) -> str:
    return next(said(zone) for zone in zones if zone.zone == "length")


def _notable(zones: Sequence[ZoneFit]) -> list[ZoneFit]:
    """The zones but the length that are worth a word, the worst first."""
    known = [z for z in zones if z.zone != "length" and z.counts and z.score is not None]
    notable = [z for z in known if abs(z.score or 0.0) >= WORTH_SAYING]
    return sorted(notable, key=lambda z: (-VERDICTS.index(z.verdict or "good"), -abs(z.score or 0)))


def not_judged(columns: Sequence[Column], known: Sequence[bool]) -> tuple[str, ...]:
    """The zones of the profile that were not judged, by name, each once, in their order."""
    names = [c.rule.zone for c, there in zip(columns, known, strict=True) if c.counts and not there]
    return tuple(dict.fromkeys(names))


def unknown_words(columns: Sequence[Column], known: Sequence[bool]) -> str:
    """The required zones that were not judged, as the end of a sentence; empty without any."""
    settled = [there or not c.rule.required for c, there in zip(columns, known, strict=True)]
    names = not_judged(columns, settled)
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
"""Two feet that differ by more are hardly of one person."""


def pair_notice(feet: Sequence[Profiled], system_name: str | None) -> Notice | None:
    """How a pair differs, with advice where it is by a size or more; None for one foot, or where
    a length is not known.
    """
    known = [(foot.length_mm, foot) for foot in feet if foot.length_mm is not None]
    if len(known) != 2:
        return None
    system = system_named(system_name) or SYSTEMS[DEFAULT_SYSTEM]
    (long_mm, longer), (short_mm, shorter) = sorted(known, key=lambda pair: -pair[0])
    side, other = (f.aligned.alignment.side.side for f in (longer, shorter))
    which = f"{side} foot" if side and side != other else "longer foot"
    difference = f"the {which} is {long_mm - short_mm:.1f} mm longer and governs the length"
    if long_mm - short_mm > ONE_CUSTOMER_MM:
        return Notice("pair_differs_widely", f"{difference}: are these one customer's feet?")
    sizes = (long_mm - short_mm) / (system.step_mm * system.numbers_per_size)
    if sizes < 1.0:
        return Notice("pair_difference", difference)
    words = [foot_size(mm, system).words for mm in (long_mm, short_mm)]
    advice = f"that is {sizes:.1f} sizes: think of two sizes, {words[0]} and {words[1]}"
    return Notice("feet_differ_by_a_size", f"{difference}; {advice}, or fit the shorter with a pad")
