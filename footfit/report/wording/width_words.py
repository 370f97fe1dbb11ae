"""How wide a foot is, in words: beside its size, and among the people of a survey."""

from __future__ import annotations

from footfit.geometry.fit.sizes import SYSTEMS, Size, foot_size
from footfit.number_words import RATIO_KEPT, rounded
from footfit.results import FootWidth, WidthShare

SHARE_STEP = 10.0
LEAST_SHARE, LARGEST_SHARE = 5.0, 95.0
"""A share is said in steps of 10 %, because a girth is not surer than that; the ends stand for
"nearly nobody" and "nearly everybody"."""
CLASSES = ((10.0, "very narrow"), (30.0, "narrow"), (60.0, "medium"), (80.0, "wide"))
"""The name of a width up to a share in percent, as it is said; above the last it is "very wide"."""


def size_with_width(size: Size, width: FootWidth) -> str:
    """A size with the width beside it, where its system has one.

    Examples
    --------
    >>> from footfit.geometry.fit.width_fitting import Fitting
    >>> wide = FootWidth((Fitting("mondopoint", "98", False),), ())
    >>> [size_with_width(foot_size(251.0, SYSTEMS[name]), wide) for name in ("uk", "mondopoint")]
    ['UK 6.5', 'Mondopoint 250/98']
    """
    fitting = width.fitting(size.system)
    return size.words + (fitting.after_size if fitting else "")


def fittings_words(width: FootWidth, size_mm: float | None) -> str:
    """The widths of a foot in every system that has one, each with the customer's size.

    ``size_mm`` is the length that decides the size; nothing is said if it is not known.

    Examples
    --------
    >>> from footfit.geometry.fit.width_fitting import fittings
    >>> fittings_words(FootWidth(fittings(251.0, 231.0, 97.6), ()), 251.0)
    'EU 40 (width about D), UK 6.5 (width about E), Mondopoint 250/98'
    """
    if size_mm is None:
        return ""
    systems = [SYSTEMS[fitting.system] for fitting in width.fittings]
    return ", ".join(size_with_width(foot_size(size_mm, system), width) for system in systems)


def shares_words(width: FootWidth) -> str:
    """How wide a foot is among women and among men, or the reason why nobody knows.

    Examples
    --------
    >>> known = WidthShare("women", 83.2, 4.0), WidthShare("men", 24.0, 4.0)
    >>> shares_words(FootWidth((), known))
    'wider than about 80 % of women, narrower than about 80 % of men with feet this long'
    >>> shares_words(FootWidth((), (WidthShare("women", 24.0, 4.0), WidthShare("men", 7.0, 4.0))))
    'narrower than about 80 % of women, 90 % of men with feet this long'
    """
    reasons = dict.fromkeys(share.reason or "" for share in width.shares if share.percent is None)
    words, before = "", ""
    for share in width.shares:
        if share.percent is not None:
            way, rest = _than(share)
            words += (", " if words else "") + (rest if way == before else f"{way} about {rest}")
            before = way
    return "; ".join([f"{words} with feet this long"] * bool(words) + list(reasons))


def _than(share: WidthShare) -> tuple[str, str]:
    """A known share: "wider than" or "narrower than", and of how many."""
    least = about_percent(share.percent or 0.0)
    if least < 50.0:
        return "narrower than", f"{100.0 - least:g} % of {share.people}"
    return "wider than", f"{least:g} % of {share.people}"


def share_words(share: WidthShare) -> str:
    """How wide a foot is among people, or why nobody knows.

    Examples
    --------
    >>> share_words(WidthShare("women", 83.2, 4.0))
    'wide: wider than about 80 % of women with feet this long'
    >>> share_words(WidthShare("men", 24.0, 4.0))
    'narrow: narrower than about 80 % of men with feet this long'
    >>> share_words(WidthShare("men", None, None, "the survey has no children"))
    'not compared: the survey has no children'
    """
    if share.percent is None:
        return f"not compared: {share.reason}"
    return f"{width_class(share.percent)}: {' about '.join(_than(share))} with feet this long"


def about_percent(percent: float) -> float:
    """A share as the sheet says it.

    Examples
    --------
    >>> [about_percent(value) for value in (0.0, 8.0, 54.9, 97.0)]
    [5.0, 10.0, 50.0, 95.0]
    """
    steps = float(rounded(percent / SHARE_STEP, 0, RATIO_KEPT))
    return min(max(SHARE_STEP * steps, LEAST_SHARE), LARGEST_SHARE)


def width_class(percent: float) -> str:
    """The name of a width by its share, so that equal shares have one name.

    Examples
    --------
    >>> [width_class(value) for value in (3.0, 29.0, 50.0, 71.0, 99.0)]
    ['very narrow', 'narrow', 'medium', 'wide', 'very wide']
    >>> [width_class(value) for value in (9.6, 10.4)]
    ['very narrow', 'very narrow']
    """
    said = about_percent(percent)
    return next((name for most, name in CLASSES if said <= most), "very wide")
