"""How a foot fits a last, in words and numbers that the terminal and the pages share."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from footfit.number_words import plain, signed

if TYPE_CHECKING:
    from footfit.results import Candidate, ZoneFit

OTHER_FOOT = "shown on the last of the other foot"
"""What is said of a last whose mirror image was compared."""
SAME_IS_ZERO = "0 = the same"
_PLACES = {
    "ball_girth": "at the ball",
    "ball_width": "across the ball",
    "ball_width_orthogonal": "straight across the ball",
    "waist_girth": "at the waist",
    "instep_girth": "at the instep",
    "short_heel_girth": "around the heel",
    "long_heel_girth": "around heel and instep",
    "heel_width": "at the heel",
    "toe_height": "over the toes",
    "toes": "at the toes",
    "instep_height": "over the instep",
}
_SIZES = {
    "tighter": "too narrow",
    "looser": "too wide",
    "narrower": "too narrow",
    "wider": "too wide",
    "lower": "too low",
    "higher": "too high",
}
"""What a reject is called, by the last word of its code."""
_CODES = {
    "length_unknown": ("of unknown length", ""),
    "ball_line_too_far_back": ("with the ball too far back", ""),
    "ball_line_too_far_forward": ("with the ball too far forward", ""),
    "flare_less_inward": ("too little turned inward", ""),
    "flare_more_inward": ("too much turned inward", ""),
    "plan_further": ("of another outline", ""),
}


def left_out_words(rejected: Iterable[tuple[str, int]]) -> str:
    """How many lasts were left out, and why; a place is named once.

    Examples
    --------
    >>> left_out_words((("ball_girth_looser", 7), ("ball_girth_tighter", 2), ("too_long", 1)))
    '7 too wide at the ball, 2 too narrow; 1 too long'
    >>> left_out_words((("ball_line_too_far_back", 1), ("damaged", 2)))
    '1 with the ball too far back; 2 damaged'
    """
    words, before = "", ""
    for code, count in rejected:
        size, place = _left_out(code)
        again = bool(place) and place == before
        words += (", " if again else "; " if words else "") + f"{count} {size}"
        words += f" {place}" if place and not again else ""
        before = place
    return words


def _left_out(code: str) -> tuple[str, str]:
    """What a reject is called, and where."""
    zone, _, word = code.rpartition("_")
    if zone in _PLACES and word in _SIZES:
        return _SIZES[word], _PLACES[zone]
    return _CODES.get(code, (code.replace("_", " "), ""))


def zone_label(zone: ZoneFit) -> str:
    """The name of a zone; of a ratio it says what 0 is."""
    name = zone.label or zone.zone.replace("_", " ")
    return f"{name} ({SAME_IS_ZERO})" if zone.unit == "ratio" else name


def zone_number(zone: ZoneFit) -> str:
    """The clearance in a zone without its unit, a dash where there is none.

    It has more decimals where they decide the verdict.
    """
    value, least = zone.clearance.value, 2 if zone.unit == "ratio" else 1
    return "-" if value is None else signed(value, max(zone.digits, least))


def toe_room_text(candidate: Candidate, *, spread: bool = True) -> str:
    """The toe room of the foot that governs the length, in mm, with its spread."""
    room = dict(candidate.clearance_mm).get("length")
    if room is None or room.value is None:
        return "-"
    zones = (zone for fit in candidate.fits for zone in fit.zones)
    digits = next((z.digits for z in zones if z.zone == "length" and z.counts), 1)
    around = f" ± {plain(room.sd)}" if spread and room.sd is not None else ""
    return f"{signed(room.value, digits)}{around}"
