"""Shares, groups and lasts of a coverage in words."""

from __future__ import annotations

from footfit.number_words import RATIO_KEPT, first_names, plain
from footfit.results.population.coverage_answer import Coverage
from footfit.results.population.served_feet import NextLast
from footfit.results.population.shares import Share

GREEDY_WORDS = (
    "Each next last is the one that serves most feet more. So the lasts together serve at least "
    "63 % of the feet that the best choice of as many planned lasts would serve."
)
PRIVACY_WORDS = (
    "Feet are named as they were given, and nowhere else: footfit stores and sends nothing."
)

NAMED_TO_GO = 8
"""So many of the lasts that could go are named."""


def percent_words(value: float | None, digits: int = 1) -> str:
    """A share in percent.

    Examples
    --------
    >>> percent_words(0.70644), percent_words(None)
    ('70.6 %', '-')
    """
    return "-" if value is None else f"{plain(100.0 * value, digits, RATIO_KEPT)} %"


def share_words(share: Share) -> str:
    """A share with its interval.

    Examples
    --------
    >>> share_words(Share(45, 50)), share_words(Share(0, 0))
    ('90.0 % (78.6 to 95.7)', '-')
    """
    if share.value is None or share.low is None or share.high is None:
        return "-"
    low, high = (plain(100.0 * end, 1, RATIO_KEPT) for end in (share.low, share.high))
    return f"{percent_words(share.value)} ({low} to {high})"


def feet_words(count: int) -> str:
    """So many feet.

    Examples
    --------
    >>> feet_words(1), feet_words(1986)
    ('1 foot', '1,986 feet')
    """
    return "1 foot" if count == 1 else f"{count:,} feet"


def coverage_sentence(answer: Coverage) -> str:
    """What was asked, in one sentence."""
    lasts = "1 last" if answer.lasts == 1 else f"{answer.lasts:,} lasts"
    judged = feet_words(answer.judged)
    return f"{judged} judged in {lasts} by the profile {answer.fit_profile.name}"


def go_words(answer: Coverage) -> str:
    """Which lasts could go, and what that would cost."""
    names = answer.could_go
    if not names:
        return "No last could go: each one serves a foot that no other last serves."
    kept = "every foot that has an acceptable last keeps one"
    lost = answer.served.good.count - answer.good_if_gone
    cost = f", but {feet_words(lost)} would have no good last any more" if lost else ""
    count = "1 last" if len(names) == 1 else f"{len(names):,} lasts"
    return f"{count} could go together: {kept}{cost}. {first_names(names, NAMED_TO_GO)}."


def next_words(last: NextLast) -> str:
    """The numbers of a last to make, in mm.

    Examples
    --------
    >>> measures = (("length", 259.14), ("ball_girth", 228.0))
    >>> next_words(NextLast(1, "EU 39", "D", 246.1, measures, None, 12, Share(20, 40), 0.6))
    'length 259.1, ball girth 228.0'
    """
    names = ("length", "ball_girth", "ball_width", "heel_width", "instep_girth")
    known = dict(last.measures)
    parts = [f"{name.replace('_', ' ')} {plain(known[name])}" for name in names if name in known]
    return ", ".join(parts)
