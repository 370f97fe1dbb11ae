"""What measures are called on a drawing, in the words of a last maker."""

from __future__ import annotations

MEASURE_WORDS = {
    "length": "length, as it rests",
    "toe_spring": "toe spring at .94 L",
    "toe_spring_tip": "toe spring at the tip",
    "tread_from": "tread begins at",
    "tread_to": "tread ends at",
}
"""What a measure of a last is called, if its name does not say enough. L is the length."""
LENGTH_WORDS = (
    "Length is along the plane on which the last rests without its heel, and holds its back. Stick"
    " length is along the ground on which it stands. Bottom length is along its bottom, from"
    " feather edge to feather edge. L is length."
)


def measure_words(name: str, kind: str) -> str:
    """What a measure of a foot or a last is called.

    Examples
    --------
    >>> measure_words("toe_spring_tip", "last"), measure_words("seat_angle_deg", "last")
    ('toe spring at the tip', 'seat angle')
    """
    known = MEASURE_WORDS if kind == "last" else {}
    return known.get(name, name.removesuffix("_deg").replace("_", " "))
