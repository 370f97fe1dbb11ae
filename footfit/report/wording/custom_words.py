"""A custom last, in words that the terminal and the page share."""

from __future__ import annotations

from footfit.number_words import plain
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


def room_words(custom: CustomLast) -> list[str]:
    """A line for each place that was given room: how far it swells."""
    return [
        f"room at {room.name}: the surface swells by {plain(room.reached_mm)} mm"
        f" ({plain(room.asked_mm)} mm asked)"
        for room in custom.rooms
    ]
