"""Zones of a custom last that are not good: what can be pressed into good, and why not."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from footfit.number_words import signed
from footfit.pipeline.last_making.custom.custom_aims import (
    BALL_LENGTH,
    HEEL_GIRTH,
    MOST_BALL_MM,
    MOST_HEEL_MM,
    CustomAim,
    CustomQuestion,
    inner_good,
)
from footfit.pipeline.last_making.custom.custom_reading import value_mm
from footfit.pipeline.last_making.custom.custom_tries import Attempt, Given
from footfit.results import JudgedZone, Notice, Profiled, Verdict, ZoneRule

NEAR = 0.5
"""A clearance that is farther outside of its good range, over the width of that, is not pressed;
the ball line comes as near as the ball may move, and what is kept leaves less to the heel."""
VERDICTS: tuple[Verdict, ...] = ("good", "acceptable", "poor", "reject")
LEAST = {"ball_girth_least": "ball_girth", "instep_girth_least": "instep_girth"}
"""The least tapes whose targets move if the upright girth of their zone is not good."""
MOVED_GOOD, FOLLOWS = 0.9, 0.7
"""A moved target stays so far in the zone's good range, as a share of that; the upright girth
changes by about so much of its least tape."""
PRESSABLE = (BALL_LENGTH, HEEL_GIRTH, *LEAST)
PRESSED = (PRESSABLE, PRESSABLE, tuple(LEAST), (BALL_LENGTH,))
"""What is pressed: all that can be; what is then no longer good; or else girths, or the ball's
place, alone."""
WHY = {
    "length": "the toe room is kept, because a longer or shorter toe box would fit worse",
    "ball_line": f"the forepart keeps its length, but for {MOST_BALL_MM:g} mm",
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


def faults(judged: Sequence[JudgedZone]) -> int:
    """How bad zones are together: 1 for each that is acceptable, 2 for a poor one, 3 for more."""
    known = [zone.custom_verdict for zone in judged if zone.custom_verdict is not None]
    return sum(VERDICTS.index(verdict) for verdict in known)


def pressed_aims(
    given: Given,
    attempt: Attempt,
    judged: Sequence[JudgedZone],
    question: CustomQuestion,
    foot: Profiled,
    names: Sequence[str],
) -> tuple[CustomAim, ...]:
    """The aims, with those of these names that were only pulled, and whose zones are not good, made
    firm in the good range; none if there is nothing to press. Of a girth it is the target of its
    least tape that moves.
    """
    rules = {rule.zone: rule for rule in question.profile.zones}
    more_mm = {}
    for zone in not_good(judged):
        if zone.custom is not None:
            rule = rules[zone.name]
            off = inner_good(rule, zone.custom - zone.target)
            near = NEAR * (rule.good[1] - rule.good[0])
            near = min(near, MOST_HEEL_MM) if zone.name == HEEL_GIRTH else near
            if zone.name == "ball_line" or abs(off) <= near:
                percent_mm = 0.01 * foot.aligned.alignment.extent_mm
                more_mm[zone.name] = -off * (percent_mm if zone.unit == "percent" else 1.0)
    aims = [
        _aim(given, attempt, aim, rules[aim.zone], more_mm[aim.zone])
        if aim.measure in names and aim.zone in more_mm
        else aim
        for aim in attempt.aims
    ]
    return () if aims == list(attempt.aims) else tuple(aims)


def _aim(
    given: Given, attempt: Attempt, aim: CustomAim, rule: ZoneRule, more_mm: float
) -> CustomAim:
    """An aim whose zone should have so much more clearance."""
    if aim.measure in LEAST:
        return moved_aim(aim, rule, more_mm)
    return aim if aim.firm else _pressed(given, attempt, aim, more_mm)


def moved_aim(aim: CustomAim, rule: ZoneRule, more_mm: float) -> CustomAim:
    """A least tape's aim with another allowance, which stays within the zone's good range.

    The zone should have ``more_mm`` of clearance.
    """
    assert aim.foot is not None
    assert aim.allowance is not None
    low, high = (rule.target + MOVED_GOOD * (end - rule.target) for end in rule.good)
    allowance = min(max(aim.allowance + more_mm / FOLLOWS, low + rule.cavity), high + rule.cavity)
    moved_mm = aim.moved_mm + allowance - aim.allowance
    return replace(aim, target=aim.foot + allowance, allowance=allowance, moved_mm=moved_mm)


def _pressed(given: Given, attempt: Attempt, aim: CustomAim, more_mm: float) -> CustomAim:
    """An aim that should read so much more than the try does; the ball moves only so far."""
    base = given.base
    grown_mm = value_mm(attempt.made.shape, aim.measure, base) + more_mm
    grown_mm -= value_mm(base.shape, aim.measure, base)
    if aim.measure == BALL_LENGTH:
        grown_mm = min(max(grown_mm, -MOST_BALL_MM), MOST_BALL_MM)
    return replace(aim, target=aim.base + grown_mm, firm=True, pressed=True)


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
