"""How long a child's shoe will last: the room beyond what must stay, over the rate of growth.

Rates: Gould 1990 (107 children followed), an Austrian survey 2001-03, Cheng 1997 (2,829 children)
for the length by age; docs/references.md lists them. Feet grow in spurts, so a rate is sure to a
third.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from footfit.errors import BadOption
from footfit.results import Match, Notice
from footfit.results.evidence.child_growth import Growth, GrowthQuestion, Sex


@dataclass(frozen=True, slots=True)
class GrowthRule:
    """The constants of the forecast.

    ``rates`` are mm a month up to an age in years; ``last_rate`` holds until growth ends.
    ``length_mm`` at 3 years and ``mm_a_year`` up to 12 give the age of a foot whose age is not
    known, give or take ``age_sd_years``.
    """

    rates: tuple[tuple[float, float], ...] = ((1.25, 2.2), (2, 1.7), (3, 1.3), (6, 1.05), (12, 0.8))
    last_rate: float = 0.4
    end_years: tuple[tuple[Sex, float], ...] = (("female", 13.0), ("male", 14.0))
    kept_mm: float = 9.0
    room_sd_mm: float = 2.0
    rate_sd_share: float = 0.35
    length_mm: tuple[tuple[Sex, float], ...] = (("female", 153.0), ("male", 156.0))
    mm_a_year: float = 9.0
    age_sd_years: float = 1.3
    oldest_years: float = 18.0


RULE = GrowthRule()


def growth_question(
    growth: bool, age_years: float | None = None, sex: Sex | None = None
) -> GrowthQuestion | None:
    """What is asked of growth, or None.

    Raises
    ------
    BadOption
        Age or sex is given without growth, or the age is not a child's.
    """
    if not growth:
        if age_years is not None or sex is not None:
            raise BadOption("--age and --sex go with --growth; add it, or leave them out")
        return None
    if age_years is not None and not 0.5 <= age_years <= RULE.oldest_years:
        raise BadOption(f"--age takes 0.5 to {RULE.oldest_years:g} years, not {age_years:g}")
    return GrowthQuestion(age_years, sex)


def growth_of(match: Match, asked: GrowthQuestion) -> Growth | None:
    """How long the first last of an answer will do; None if there is none, or no toe room."""
    length_mm = match.customer_length_mm
    if not match.candidates or length_mm is None:
        return None
    first = match.candidates[0]
    room = dict(first.clearance_mm).get("length")
    if room is None or room.value is None:
        return None
    ages = age_range(length_mm, asked)
    fast, slow = growth_rate(ages[0], asked.sex), growth_rate(ages[1], asked.sex)
    kept = RULE.kept_mm + _worn_mm(match)
    months = month_range(room.value - kept, slow, fast) if fast > 0.0 else None
    by_length = asked.age_years is None
    known = "the length of the foot" if by_length else f"an age of {asked.age_years:g}"
    return Growth(
        last=first.last,
        room_mm=room.value,
        kept_mm=kept,
        months=months,
        check_months=None if months is None else 0.5 * months[0],
        rate_mm_per_month=(slow, fast),
        age_years=ages,
        sex=asked.sex,
        grounds=f"{known} and how fast children's feet grow",
    )


def _worn_mm(match: Match) -> float:
    """By how many mm sock, insole and load shift the toe room that the first last is asked for."""
    rules = () if match.fit_profile is None else match.fit_profile.zones
    asked = next((rule.target for rule in rules if rule.zone == "length"), None)
    if asked is None:
        return 0.0
    zones = (zone for fit in match.candidates[0].fits for zone in fit.zones if zone.counts)
    return next((zone.target - asked for zone in zones if zone.zone == "length"), 0.0)


def age_range(length_mm: float, asked: GrowthQuestion) -> tuple[float, float]:
    """The age in years: as given, else by the length of the foot, with a range.

    Examples
    --------
    >>> age_range(180.0, GrowthQuestion(age_years=6.0))
    (6.0, 6.0)
    >>> [round(age, 1) for age in age_range(183.0, GrowthQuestion(sex="male"))]
    [4.7, 7.3]
    """
    if asked.age_years is not None:
        return asked.age_years, asked.age_years
    at_three = [mm for sex, mm in RULE.length_mm if asked.sex in (None, sex)]
    ages = [3.0 + (length_mm - mm) / RULE.mm_a_year for mm in at_three]
    low, high = min(ages) - RULE.age_sd_years, max(ages) + RULE.age_sd_years
    return max(low, 0.5), min(max(high, 1.0), RULE.oldest_years)


def growth_rate(age_years: float, sex: Sex | None) -> float:
    """How fast a foot grows at an age, in mm a month; of an unknown sex the faster one.

    Examples
    --------
    >>> growth_rate(5.0, None), growth_rate(13.5, "female"), growth_rate(13.5, "male")
    (1.05, 0.0, 0.4)
    """
    end = max(years for kind, years in RULE.end_years if sex in (None, kind))
    if age_years > end:
        return 0.0
    return next((rate for years, rate in RULE.rates if age_years <= years), RULE.last_rate)


def month_range(spare_mm: float, slow: float, fast: float) -> tuple[float, float | None]:
    """For how many months the room to grow will do: one standard deviation to either side.

    Nothing ends the range where the foot may not grow at all.

    Examples
    --------
    >>> [round(month, 1) for month in month_range(5.0, 1.05, 1.05)]
    [2.2, 7.3]
    >>> month_range(5.0, 0.0, 0.4)[1]
    """
    least, sd = _months(spare_mm, fast)
    low = max(least - sd, 0.0)
    if spare_mm <= 0.0:
        return low, 0.0
    return low, sum(_months(spare_mm, slow)) if slow > 0.0 else None


def _months(spare_mm: float, rate: float) -> tuple[float, float]:
    """The months at a rate, and their standard deviation."""
    months = spare_mm / rate
    return months, math.hypot(RULE.room_sd_mm / rate, RULE.rate_sd_share * months)


def with_growth(match: Match, asked: GrowthQuestion) -> Match:
    """The answer with its forecast of growth, if there is one."""
    growth = growth_of(match, asked)
    if growth is None:
        return match
    notice = Notice("growth", growth.words)
    return replace(match, growth=growth, warnings=(*match.warnings, notice))
