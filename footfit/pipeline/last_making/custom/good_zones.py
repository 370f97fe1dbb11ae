"""Zones of a custom last that are not good, and why."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from footfit.number_words import plain, signed
from footfit.pipeline.last_making.custom.custom_aims import (
    LENGTH,
    MOST_BALL_MM,
    CustomAim,
    CustomQuestion,
)
from footfit.results import JudgedZone, Notice, ToeBoxChange
from footfit.results.last_making.custom_last import ROOM_WHY

NOT_ENOUGH = "and another toe room or toe box does not make it good or cannot be made"
WHY = {
    "ball_line": f"the ball moves by at most {MOST_BALL_MM:g} mm",
    "ball_girth": "its section keeps the shape of the base, and its least tape is good",
    "instep_girth": "its section keeps the shape of the base, and its least tape is good",
    "short_heel_girth": "the bottom, the back and the top stay, and nearly set it",
    "toe_height": f"the toe keeps its heights, {NOT_ENOUGH}",
    "toes": f"the toe keeps its shape, {NOT_ENOUGH}",
    "flare": "the flare stays",
    "plan": "the toe and the flare keep their outlines",
}
"""Why a zone is not good: what a custom last keeps of its base."""


def not_good(judged: Sequence[JudgedZone]) -> list[JudgedZone]:
    """The zones of a custom last that are judged, and are not good."""
    return [zone for zone in judged if zone.custom_verdict not in (None, "good")]


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
        return ROOM_WHY
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
        by_words = f"aims at {signed(aim.moved_mm)} mm from the profile's target"
        if aim.moved_mm and aim.measure == LENGTH:
            words = f"the toe room {by_words}, so that the toe box fits better"
            notices.append(Notice("toe_room_moved", words))
        elif aim.moved_mm:
            zone = aim.zone.replace("_", " ")
            words = f"the {aim.words} {by_words}, so that the zone {zone} is good"
            notices.append(Notice("target_moved", words))
    return tuple(notices)


def toe_box_notice(change: ToeBoxChange) -> list[Notice]:
    """The warning that the toe box was changed; none if it was not."""
    sizes_mm = {
        "outer wall {} mm out": change.outer_mm,
        "inner wall {} mm out": change.inner_mm,
        "top {} mm up": change.higher_mm,
    }
    parts = [words.format(plain(mm)) for words, mm in sizes_mm.items() if mm]
    words = (
        "the toe keeps its shape, and behind it the toe box is changed, so that it fits better:"
        f" {', '.join(parts)} where that is most"
    )
    return [Notice("toe_box_changed", words)] if parts else []
