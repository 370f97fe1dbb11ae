"""Rules of fit, as pure functions on numbers. For now the length rule of a walking shoe."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LengthRule:
    """Toe allowance: how much longer than the foot a last is asked to be, in mm.

    The published allowances are 10 to 17 mm (docs/references.md); 8 to 20 is still worn.
    """

    name: str = "walking"
    version: str = "length/1"
    target_mm: float = 13.0
    good_mm: tuple[float, float] = (10.0, 17.0)
    acceptable_mm: tuple[float, float] = (8.0, 20.0)


WALKING = LengthRule()
TIE_DISTANCE = 2.0**0.5
"""Two distances closer than this are a tie: each of the two profiles carries one sigma."""


def length_refusal(clearance_mm: float, rule: LengthRule = WALKING) -> str | None:
    """Why a last is out by its length: "too_short", "too_long", or None where it is not.

    Examples
    --------
    >>> length_refusal(5.0), length_refusal(13.0), length_refusal(21.0)
    ('too_short', None, 'too_long')
    """
    shortest, longest = rule.acceptable_mm
    if clearance_mm < shortest:
        return "too_short"
    return "too_long" if clearance_mm > longest else None


def tiers(distances: Sequence[float], tie: float = TIE_DISTANCE) -> list[int]:
    """The tier of each distance: a tier begins at its smallest and is ``tie`` wide.

    Examples
    --------
    >>> tiers([3.0, 1.0, 2.0, 9.0], tie=1.5)
    [1, 0, 0, 2]
    """
    tier_of: dict[int, int] = {}
    tier, start = -1, float("-inf")
    for index in sorted(range(len(distances)), key=lambda i: distances[i]):
        if distances[index] > start + tie:
            tier, start = tier + 1, distances[index]
        tier_of[index] = tier
    return [tier_of[i] for i in range(len(distances))]


def length_words(clearance_mm: float, rule: LengthRule = WALKING) -> str:
    """The length clearance in words.

    Examples
    --------
    >>> length_words(12.6)
    '12.6 mm toe room (asked 13)'
    >>> length_words(-4.0)
    '4.0 mm shorter than the foot'
    """
    if clearance_mm < 0:
        return f"{-clearance_mm:.1f} mm shorter than the foot"
    return f"{clearance_mm:.1f} mm toe room (asked {rule.target_mm:.0f})"


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
