"""Numbers as people read them: every shown number is the document's, rounded half up."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import ROUND_HALF_UP, Decimal

KEPT = 3
"""The decimals of a number in JSON and CSV: mm and degrees. Ratios have 6, cm2 have 1."""
RATIO_KEPT = 6
AREA_KEPT = 1
MOST_DIGITS = KEPT
UNITS = {"mm": " mm", "deg": " deg", "percent": " %", "ratio": ""}
"""What a number in each unit ends in."""


def rounded(value: float, digits: int = 1, kept: int = KEPT) -> Decimal:
    """``value`` to so many decimals, half up, and never a negative zero.

    It is rounded to the decimals that documents have first. So a number in a table is the number
    that JSON and CSV give, rounded.

    Examples
    --------
    >>> [str(rounded(value)) for value in (0.25, 0.35, 0.45, -0.25, -0.01)]
    ['0.3', '0.4', '0.5', '-0.3', '0.0']
    >>> str(rounded(0.2496)), str(rounded(0.2496, kept=6))
    ('0.3', '0.2')
    """
    document = Decimal(repr(round(float(value), kept)))
    return document.quantize(Decimal(1).scaleb(-digits), ROUND_HALF_UP) + 0


def plain(value: float, digits: int = 1, kept: int = KEPT) -> str:
    """A number without a plus sign, and never a negative zero.

    Examples
    --------
    >>> plain(3.24), plain(-0.01), plain(0.45), plain(1.005, 2, RATIO_KEPT)
    ('3.2', '0.0', '0.5', '1.01')
    """
    return f"{rounded(value, digits, kept):.{digits}f}"


def signed(value: float, digits: int = 1, kept: int = KEPT) -> str:
    """A number with its sign, and never a negative zero.

    Examples
    --------
    >>> signed(3.24), signed(-3.25), signed(-0.01)
    ('+3.2', '-3.3', '+0.0')
    """
    return f"{rounded(value, digits, kept):+.{digits}f}"


def some_digits(value: float, digits: int = 1) -> str:
    """A number that is not 0, with as many decimals as it needs not to look like 0.

    Examples
    --------
    >>> some_digits(0.26), some_digits(0.03), some_digits(0.0)
    ('0.3', '0.03', '0.000')
    """
    enough = (more for more in range(digits, MOST_DIGITS) if rounded(value, more))
    return plain(value, next(enough, MOST_DIGITS))


def bound_words(most_mm: float) -> str:
    """How far something is at most; what two decimals would show as 0 is named as less.

    Examples
    --------
    >>> bound_words(0.384), bound_words(0.002)
    ('at most 0.38 mm', 'less than 0.01 mm')
    """
    known = rounded(most_mm, 2) > 0
    return f"at most {plain(most_mm, 2)} mm" if known else "less than 0.01 mm"


def first_names(names: Sequence[str], named: int) -> str:
    """The first few names, and how many more there are.

    Examples
    --------
    >>> first_names(("a", "b"), 3), first_names(("a", "b", "c", "d", "e"), 3)
    ('a, b', 'a, b, c and 2 more')
    """
    more = f" and {len(names) - named:,} more" if len(names) > named else ""
    return f"{', '.join(names[:named])}{more}"
