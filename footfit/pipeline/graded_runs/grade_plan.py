"""What a graded run is asked: its sizes and widths, what is held, and each measure's target."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import SizeSystem, label_number
from footfit.geometry.stance.cues import StanceLabels
from footfit.pipeline.batch.sources import LABELLED_MM
from footfit.pipeline.graded_runs.grade_shape import (
    HELD,
    HELD_BY_DEFAULT,
    THICKNESS,
)
from footfit.pipeline.graded_runs.run_sizes import width_numbers
from footfit.results.last_making.graded_run import By
from footfit.results.last_making.grading_rule import GradingRule

MOST_LASTS = 200
MOST_SIZES = 30
"""So far a run reaches from its base; adults' lasts of all sizes lie within 15."""
HEEL, SPRING, GIRTH = "heel_height", "toe_spring_tip", "ball_girth_least"
NOTHING = "none"


@dataclass(frozen=True, slots=True)
class Fitting:
    """One last of a run: its labels, and how many sizes and widths it is from the base."""

    size: str
    width: str | None
    sizes: float
    widths: float


@dataclass(frozen=True, slots=True)
class GradePlan:
    """A run that is asked for. ``held`` are some of ``HELD``; ``start`` are the base's labels."""

    rule: GradingRule
    system: SizeSystem
    start: Fitting
    fittings: tuple[Fitting, ...]
    held: frozenset[str]


@dataclass(frozen=True, slots=True)
class Planned:
    """The target of a measure, and by what it is: the rule, because it is held, or scaled."""

    target: float
    by: By


def grade_plan(
    rule: GradingRule,
    system: SizeSystem,
    base: tuple[str | None, str | None],
    asked: tuple[str, str | None],
    hold: str | None,
) -> GradePlan:
    """The plan of a run.

    Parameters
    ----------
    rule : GradingRule
    system : SizeSystem
    base : tuple
        The size and the width of the base, as labelled.
    asked : tuple
        The sizes, such as "38:46" or "39,40.5,42 2/3", and the widths, such as "E,F,G".
    hold : str or None
        What is held, such as "heel,spring,toe", or "none".

    Raises
    ------
    BadOption
        The size or the width of the base is not known, a text is not understood, there are too many
        lasts, or one is too far from the base.
    """
    base_size, base_width = base
    if base_size is None:
        raise BadOption("the size of the base is not known: add --base-size, such as 42")
    if label_number(base_size) is None:
        words = f"the size of the base is {base_size!r}, which is no number"
        raise BadOption(f"{words}: add --base-size, such as 42")
    start = _number(base_size, system)
    sizes = _sizes(asked[0], rule.size_step, system)
    widths = _widths(asked[1], base_width, rule)
    fittings = tuple(
        Fitting(size, width, (_number(size, system) - start) / rule.size_step, steps)
        for width, steps in widths.items()
        for size in sizes
    )
    if len(fittings) > MOST_LASTS:
        raise BadOption(f"a run has at most {MOST_LASTS} lasts, and these are {len(fittings)}")
    far = max(fittings, key=lambda each: abs(each.sizes))
    if abs(far.sizes) > MOST_SIZES:
        words = f"size {far.size} is {abs(far.sizes):.0f} sizes from the base's {base_size}"
        hint = f"take sizes of {system.name} nearer to it, or another --size-system"
        raise BadOption(f"{words}, and a run reaches {MOST_SIZES} at most: {hint}")
    held = _held(hold)
    return GradePlan(rule, system, Fitting(base_size, base_width, 0.0, 0.0), fittings, held)


def _number(label: str, system: SizeSystem) -> float:
    """A size on the adults' scale.

    Raises
    ------
    BadOption
        It is no number.
    """
    number = label_number(label)
    if number is None:
        raise BadOption(f"--sizes takes sizes such as 38:46, 38:42:0.5 or 39,40.5, not {label!r}")
    return number[0] - (system.child_add or 0.0) if number[1] else number[0]


def _sizes(text: str, step: float, system: SizeSystem) -> list[str]:
    """The labels of the sizes, each once; where semicolons part them, a comma is a decimal one."""
    labels: list[str] = []
    for part in text.split(";" if ";" in text else ","):
        ends = [each.strip() for each in part.split(":")]
        if len(ends) == 1:
            labels.append(ends[0])
            _number(ends[0], system)
            continue
        if len(ends) > 3:
            raise BadOption(f"--sizes takes FROM:TO or FROM:TO:STEP, not {part.strip()!r}")
        by = _step(ends[2]) if len(ends) == 3 else step
        start, end = (_number(each, system) for each in ends[:2])
        count = math.floor((end - start) / by + 1e-6)
        if count < 0:
            words = f"--sizes {part.strip()!r} holds no sizes: give FROM:TO with FROM first"
            raise BadOption(words)
        if count >= MOST_LASTS:
            words = f"--sizes {part.strip()!r} holds more than {MOST_LASTS} sizes: give fewer"
            raise BadOption(words)
        child = "C" if ends[0].lower().endswith(("c", "k", "y")) else ""
        added = (system.child_add or 0.0) if child else 0.0
        labels += [f"{size_label(start + at * by + added)}{child}" for at in range(count + 1)]
    return list(dict.fromkeys(labels))


def _step(text: str) -> float:
    """A step between sizes, such as 0.5 or 1/3; raises BadOption if it is none."""
    try:
        step = float(Fraction(text.replace(",", ".")))
    except (ValueError, ZeroDivisionError):
        step = 0.0
    if step <= 0.0:
        raise BadOption(f"--sizes takes a step of more than 0, such as 0.5 or 1/3, not {text!r}")
    return step


def size_label(number: float) -> str:
    """A size as it is marked: halves as decimals, thirds as fractions.

    Examples
    --------
    >>> [size_label(number) for number in (42.0, 42.5, 128 / 3, 42.25)]
    ['42', '42.5', '42 2/3', '42.25']
    """
    thirds = Fraction(number).limit_denominator(3)
    if thirds.denominator == 3 and abs(float(thirds) - number) < 1e-6:
        whole, rest = divmod(thirds.numerator, 3)
        return f"{whole} {rest}/3"
    return f"{round(number, 6):g}"


def _widths(text: str | None, base: str | None, rule: GradingRule) -> dict[str | None, float]:
    """How many widths each asked one is from the base's; the base's alone if none is asked for."""
    if text is None:
        return {base: 0.0}
    parts = (part.strip() for part in re.split("[;,]", text))
    asked = list(dict.fromkeys(part for part in parts if part))
    if not asked:
        raise BadOption("--widths names no width: give some, such as E,F,G")
    if base is None:
        raise BadOption("the width of the base is not known: add --base-width, such as F")
    listed = {width.casefold() for width in rule.widths}
    if listed and (other := [name for name in (*asked, base) if name.casefold() not in listed]):
        words = (
            f"the rule {rule.name!r} has the widths {', '.join(rule.widths)}, and not {other[0]}"
        )
        raise BadOption(f"{words}: take one of them, or another rule")
    numbers = width_numbers(list(dict.fromkeys([*asked, base])), rule.widths)
    if not rule.width and any(numbers[width] != numbers[base] for width in asked):
        raise BadOption(f"the rule {rule.name!r} has no [width] table: leave out --widths")
    return {width: (numbers[width] - numbers[base]) / rule.width_step for width in asked}


def _held(text: str | None) -> frozenset[str]:
    """What is held; raises BadOption for what cannot be."""
    if text is None:
        return frozenset(HELD_BY_DEFAULT)
    names = {part.strip().casefold() for part in re.split("[;,]", text) if part.strip()}
    unknown = sorted(names - {*HELD, NOTHING})
    if unknown or not names or (NOTHING in names and len(names) > 1):
        wrong = unknown[0] if unknown else text
        raise BadOption(f"--hold takes some of {', '.join(HELD)}, or none, not {wrong!r}")
    return frozenset(names - {NOTHING})


def targets(
    plan: GradePlan, base_mm: Mapping[str, float], sizes: float, widths: float
) -> dict[str, Planned]:
    """The target of each measure that is planned, so many sizes and widths from the base.

    ``base_mm`` are the base's measures. What the rule does not name and nothing holds, follows.
    """
    result: dict[str, Planned] = {}
    bottom = "bottom" in plan.held
    for name, value in base_mm.items():
        planned = plan.rule.planned(name, value, sizes, widths)
        if planned is not None:
            result[name] = Planned(planned, "rule")
    length = result["bottom_length"].target / base_mm["bottom_length"]
    thicker = result[GIRTH].target / base_mm[GIRTH] if GIRTH in result else length
    for name, held, scale in (
        (HEEL, bottom or "heel" in plan.held, length),
        (SPRING, bottom or "spring" in plan.held, length),
        (THICKNESS, "toe" in plan.held, thicker),
    ):
        if name in base_mm:
            by: By = "held" if held else "scaled"
            result[name] = Planned(base_mm[name] * (1.0 if held else scale), by)
    return result


def standing(targets_mm: Mapping[str, Planned], platform_mm: float | None) -> StanceLabels:
    """How a last with these targets stands: by its heel and its spring, where labels can say so."""
    said: dict[str, float | None] = {}
    for label, name, over in (
        ("heel_height_mm", HEEL, platform_mm or 0.0),
        ("toe_spring_mm", SPRING, 0.0),
    ):
        value = targets_mm[name].target + over if name in targets_mm else None
        low, high = LABELLED_MM[label]
        said[label] = value if value is not None and low <= value <= high else None
    return StanceLabels(said["heel_height_mm"], said["toe_spring_mm"], platform_mm or 0.0)
