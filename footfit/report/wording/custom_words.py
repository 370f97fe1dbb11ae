"""A custom last, in words that the terminal and the page share."""

from __future__ import annotations

from footfit.number_words import plain, signed
from footfit.report.wording.text import visible
from footfit.results import CustomLast


def custom_verdict_words(custom: CustomLast) -> str:
    """The verdict of a custom last, and the zones that it comes from."""
    if custom.verdict is None:
        return "no zone can be judged"
    words = f"{custom.record.labels.name} is {custom.verdict} for this foot"
    worst = [z.label for z in custom.judged if z.custom_verdict == custom.verdict]
    if custom.verdict == "good":
        return visible(f"{words}, in all {len(worst)} zones")
    return visible(f"{words}, because of {', '.join(worst)}")


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
