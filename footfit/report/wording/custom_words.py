"""A custom last, in words that the terminal and the page share."""

from __future__ import annotations

from footfit.number_words import plain, signed
from footfit.report.wording.text import visible
from footfit.results import CustomLast, CustomZone, JudgedZone
from footfit.results.last_making.custom_last import ROOM_WHY


def custom_verdict_words(custom: CustomLast) -> str:
    """The verdict of a custom last, and the zones that it comes from."""
    if custom.verdict is None:
        return "no zone can be judged"
    worst = [z.label for z in custom.judged if z.custom_verdict == custom.verdict]
    name = custom.record.labels.name
    if custom.verdict == "good":
        return visible(f"{name} is good for this foot, in all {len(worst)} zones")
    words = f"{name} is {custom.verdict} for this foot"
    if custom.verdict == "poor":
        words = f"{name} fits this foot poorly (poor)"
    elif custom.verdict == "reject":
        words = f"{name} does not fit this foot (reject)"
    return visible(f"{words}, because of {', '.join(worst)}")


def advice_words(custom: CustomLast) -> str | None:
    """What to do with a last that fits poorly or not at all; None for the others.

    All its targets are met. What does not fit is what it keeps of its base.
    """
    meaning = {
        "reject": "Do not make a shoe on it: the customer could not wear it.",
        "poor": "A shoe on it would hurt or be loose there: let the customer try one on first.",
    }.get(custom.verdict or "")
    if meaning is None:
        return None
    worst = [z for z in custom.judged if z.custom_verdict == custom.verdict]
    if all(zone.why == ROOM_WHY for zone in worst):
        return f"{visible(', '.join(z.label for z in worst))}: {ROOM_ADVICE}"
    if any("--keep" in (zone.why or "") for zone in worst):
        return f"{meaning} Leave out --keep bottom."
    cause = "Its girths are right, but there it keeps the shape of its base."
    step = "Make it from another base: footfit match lists lasts, and --base names one"
    if custom.better_in_stock is not None:
        step = f"Use {visible(custom.better_in_stock.last)} of the catalogue"
    return f"{meaning} {cause} {step}, or choose another kind of shoe (--profile)."


ROOM_ADVICE = (
    "this is the room that was asked for, and not a fault of the last. Without the room it is good"
    " there. Keep the room if the foot needs it, and let the customer try a shoe on."
)
"""What to do if nothing but the room for single places is why the last is not good."""


def zone_words(zone: JudgedZone) -> str:
    """The label of a zone; a girth that has a least tape too is said to be the upright one."""
    return f"upright {zone.label}" if zone.name in UPRIGHT else zone.label


UPRIGHT = ("ball_girth", "instep_girth")
"""The zones whose girths have least tapes among the targets."""
GIRTH_WORDS = (
    "least: the shortest tape around the place, as a last maker takes it. upright: the tape in a"
    " plane that stands upright, in which a match judges; it is often longer."
)


def with_spread(words: str, sd: float | None, digits: int = 1) -> str:
    """A number in words with its spread, if that is known.

    Examples
    --------
    >>> with_spread("252.2", 0.6), with_spread("+1.0", None)
    ('252.2 ± 0.6', '+1.0')
    """
    return words if sd is None else f"{words} ± {plain(sd, digits)}"


def judged_words(value: float | None, sd: float | None, unit: str) -> str:
    """The clearance of a zone with its spread, without its unit; a ratio has two decimals.

    Examples
    --------
    >>> judged_words(0.726, 0.049, "ratio"), judged_words(-2.38, 1.38, "mm")
    ('+0.73 ± 0.05', '-2.4 ± 1.4')
    """
    digits = 2 if unit == "ratio" else 1
    return "-" if value is None else with_spread(signed(value, digits), sd, digits)


def has_room(zone: CustomZone) -> bool:
    """Whether the room for single places changes the target of a measure so much that it shows."""
    return abs(zone.room) >= 0.05


CUSTOM_SPREADS = (
    "± is the spread of a second scan: of the foot for a target, of the last for what is reached,"
    " of both for a zone."
)


def room_words(custom: CustomLast) -> list[str]:
    """A line for each place that was given room: how far it swells."""
    return [
        f"room at {room.name}: the surface swells by {plain(room.reached_mm)} mm"
        f" ({plain(room.asked_mm)} mm asked)"
        for room in custom.rooms
    ]
