"""Zones of a custom last that are not good: what can be pressed into good, and why not."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from footfit.pipeline.last_making.custom.custom_aims import (
    BALL_LENGTH,
    MOST_BALL_MM,
    PULLED,
    CustomAim,
    CustomQuestion,
    inner_good,
)
from footfit.pipeline.last_making.custom.custom_reading import value_mm
from footfit.pipeline.last_making.custom.custom_tries import Attempt, Given
from footfit.results import JudgedZone, Notice, Profiled, Verdict

NEAR = 0.5
"""A clearance that is farther outside of its good range, over the width of that, is not pressed;
the ball line comes as near as the ball may move."""
VERDICTS: tuple[Verdict, ...] = ("good", "acceptable", "poor", "reject")
PRESSABLE = (BALL_LENGTH, *PULLED)
PRESSED = (PRESSABLE, PRESSABLE, (BALL_LENGTH,))
"""What is pressed: all that can be; what is then no longer good; or else the ball's place alone."""
WHY = {
    "length": "the toe room is kept, because a longer or shorter toe box would fit worse",
    "ball_line": f"the forepart keeps its length, but for {MOST_BALL_MM:g} mm",
    "ball_girth": "its section keeps the shape that the base has: the least tape has its target",
    "instep_girth": "its section keeps the shape that the base has: the least tape has its target",
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
    firm in the good range; none if there is nothing to press.
    """
    rules = {rule.zone: rule for rule in question.profile.zones}
    more_mm = {}
    for zone in not_good(judged):
        if zone.custom is not None:
            rule = rules[zone.name]
            off = inner_good(rule, zone.custom - zone.target)
            if zone.name == "ball_line" or abs(off) <= NEAR * (rule.good[1] - rule.good[0]):
                percent_mm = 0.01 * foot.aligned.alignment.extent_mm
                more_mm[zone.name] = -off * (percent_mm if zone.unit == "percent" else 1.0)
    aims = [
        _pressed(given, attempt, aim, more_mm[aim.zone])
        if aim.measure in names and aim.zone in more_mm and not aim.firm
        else aim
        for aim in attempt.aims
    ]
    return tuple(aims) if any(aim.pressed for aim in aims) else ()


def _pressed(given: Given, attempt: Attempt, aim: CustomAim, more_mm: float) -> CustomAim:
    """An aim that should read so much more than the try does; the ball moves only so far."""
    base = given.base
    grown_mm = value_mm(attempt.made.shape, aim.measure, base) + more_mm
    grown_mm -= value_mm(base.shape, aim.measure, base)
    if aim.measure == BALL_LENGTH:
        grown_mm = min(max(grown_mm, -MOST_BALL_MM), MOST_BALL_MM)
    return replace(aim, target=aim.base + grown_mm, firm=True, pressed=True)


def zone_notices(
    judged: Sequence[JudgedZone], question: CustomQuestion, roomy: Collection[str] = ()
) -> tuple[Notice, ...]:
    """A warning that names the zones that are not good, with what is kept and so forbids it.

    ``roomy`` are the zones that were good before room for single places was added.
    """
    words = []
    for zone in not_good(judged):
        why = WHY.get(zone.name, "the base's shape is kept there")
        if question.bottom_kept and zone.name.endswith("_width"):
            why = "--keep bottom keeps the outline of the bottom"
        elif zone.name in roomy:
            why = "it was good before --room was given"
        elif zone.name == "flare" and question.flare_follow == 0.0:
            why += "; --flare-follow turns it"
        words.append(f"{zone.label} ({why})")
    return (Notice("not_good", f"not good in {', '.join(words)}"),) if words else ()
