"""Zones of a custom last that are not good, and why."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from footfit.number_words import signed
from footfit.pipeline.fit.zones import TOE_BOX
from footfit.pipeline.last_making.custom.custom_aims import (
    LENGTH,
    MOST_BALL_MM,
    CustomAim,
    CustomQuestion,
    good_range,
)
from footfit.results import JudgedZone, Notice, Verdict

GOOD_ROOM = 0.9
"""A toe room that is next to the base's stays within so much of its good range."""
VERDICTS: tuple[Verdict, ...] = ("good", "acceptable", "poor", "reject")
WHY = {
    "length": "the toe room is kept, because a longer or shorter toe box would fit worse",
    "ball_line": f"the ball moves by at most {MOST_BALL_MM:g} mm",
    "ball_girth": "its section keeps the shape of the base, and its least tape is good",
    "instep_girth": "its section keeps the shape of the base, and its least tape is good",
    "short_heel_girth": "the bottom, the back and the top stay, and nearly set it",
    "toe_height": "the toe keeps its shape and its heights",
    "toes": "the toe keeps its shape",
    "flare": "the flare stays",
    "plan": "the toe and the flare keep their outlines",
}
"""Why a zone is not good: what a custom last keeps of its base."""


def not_good(judged: Sequence[JudgedZone]) -> list[JudgedZone]:
    """The zones of a custom last that are judged, and are not good."""
    return [zone for zone in judged if zone.custom_verdict not in (None, "good")]


def toe_faults(judged: Sequence[JudgedZone]) -> int:
    """How bad the zones of the toe box are together: 1 for each that is acceptable, 2 for poor."""
    return sum(
        VERDICTS.index(zone.custom_verdict)
        for zone in judged
        if zone.name in TOE_BOX and zone.custom_verdict is not None
    )


def nearer_length(
    aims: Sequence[CustomAim], judged: Sequence[JudgedZone], question: CustomQuestion
) -> tuple[CustomAim, ...] | None:
    """The aims with a good toe room that is next to the base's, if the toe box needs that.

    The toe box moves with the length. It needs it if one of its zones becomes worse: poor, or no
    longer good though the base's toe room is good.
    """
    length = next(zone for zone in judged if zone.name == LENGTH)
    least = 0 if length.base_verdict == "good" else 1
    worse = any(
        VERDICTS.index(zone.custom_verdict) > max(VERDICTS.index(zone.base_verdict), least)
        for zone in judged
        if zone.name in TOE_BOX and zone.base_verdict and zone.custom_verdict
    )
    if not worse or length.base is None:
        return None
    (rule,) = (rule for rule in question.profile.zones if rule.zone == LENGTH)
    low, high = good_range(rule.target, rule, GOOD_ROOM)
    room_mm = min(max(length.base, low), high) - length.base
    return tuple(replace(a, target=a.base + room_mm) if a.measure == LENGTH else a for a in aims)


def with_reasons(
    judged: Sequence[JudgedZone], question: CustomQuestion, roomy: Collection[str] = ()
) -> tuple[JudgedZone, ...]:
    """The zones; those that are not good with what is kept and so forbids it.

    ``roomy`` are the zones that were good before room for single places was added.
    """
    poor = not_good(judged)
    return tuple(
        replace(zone, why=_why(zone, question, roomy)) if zone in poor else zone for zone in judged
    )


def _why(zone: JudgedZone, question: CustomQuestion, roomy: Collection[str]) -> str:
    """Why a zone is not good."""
    if question.bottom_kept and zone.name.endswith("_width"):
        return "--keep bottom keeps the outline of the bottom"
    if zone.name in roomy:
        return "it was good before --room was given"
    why = WHY.get(zone.name, "the base's shape is kept there")
    turnable = zone.name == "flare" and question.flare_follow == 0.0
    return f"{why}; --flare-follow turns it" if turnable else why


def zone_notices(judged: Sequence[JudgedZone], aims: Sequence[CustomAim]) -> tuple[Notice, ...]:
    """Warnings that name the zones that are not good, and the girths whose targets moved.

    ``aims`` are those that the custom last was made with.
    """
    poor = [f"{zone.label} ({zone.why})" for zone in judged if zone.why is not None]
    notices = [Notice("not_good", f"not good in {', '.join(poor)}")] if poor else []
    for aim in aims:
        if aim.moved_mm:
            words = f"the {aim.words} aims at {signed(aim.moved_mm)} mm from the profile's target"
            notices.append(Notice("target_moved", f"{words}, so that the zone is good"))
    return tuple(notices)
