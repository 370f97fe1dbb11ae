"""The width fitting of a foot beside its size.

Mondopoint names the width in mm, by its standard [iso9407]. Letters are a convention of each maker,
so a letter here is about right: the rules are those of two makers' tables, which agree to within
2 mm where they meet. ``docs/fit.md`` has the table.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from footfit.geometry.fit.sizes import SYSTEMS, foot_size

MONDOPOINT = "mondopoint"
MIDDLE_FROM, MIDDLE_TO = 0.25, 0.75
"""A girth in this part of the step from one letter to the next lies between the two."""


@dataclass(frozen=True, slots=True)
class WidthRule:
    """Letters by the foot's ball girth: ``letter`` has ``girth_mm`` at ``size``, and each size and
    each letter adds a step.
    """

    letter: str
    size: float
    girth_mm: float
    per_size_mm: float
    per_letter_mm: float


LETTERS = "ABCDEFGH"
RULES = {
    "eu": WidthRule("G", 37.0, 230.0, 5.0, 5.0),
    "uk": WidthRule("F", 8.0, 245.0, 6.0, 6.0),
}
"""By size system, for adults. No other system has a rule that we know of."""


@dataclass(frozen=True, slots=True)
class Fitting:
    """The width of a foot in one system: a letter, two with a dash between, or a number of mm.

    ``about`` is True for letters, which are a convention.
    """

    system: str
    width: str
    about: bool

    @property
    def words(self) -> str:
        """The width in words.

        Examples
        --------
        >>> [Fitting("eu", width, True).words for width in ("G-H", "over H")]
        ['width about G-H', 'width over H']
        >>> Fitting("mondopoint", "98", False).words
        'width 98 mm'
        """
        if not self.about:
            return f"width {self.width} mm"
        return f"width {self.width}" if " " in self.width else f"width about {self.width}"

    @property
    def after_size(self) -> str:
        """The width as it stands after the size.

        Examples
        --------
        >>> Fitting("eu", "G-H", True).after_size, Fitting("mondopoint", "98", False).after_size
        (' (width about G-H)', '/98')
        """
        return f" ({self.words})" if self.about else f"/{self.width}"


def fittings(
    length_mm: float, girth_mm: float | None, width_mm: float | None
) -> tuple[Fitting, ...]:
    """The width of a foot at the nearest size of a length, in each system that has one.

    Parameters
    ----------
    length_mm : float
        The length that decides the size: of two feet, the longer one's.
    girth_mm, width_mm : float or None
        The ball girth, for letters, and the ball width, for Mondopoint; None if not measured.

    Examples
    --------
    >>> [fitting.width for fitting in fittings(262.5, 247.0, 99.6)]
    ['F-G', 'F-G', '100']
    >>> fittings(180.0, 170.0, None)  # a child: the letters are for adults
    ()
    """
    letters = [
        Fitting(name, letter(girth_mm, size.nearest, RULES[name]), True)
        for name, size in ((name, foot_size(length_mm, SYSTEMS[name])) for name in RULES)
        if girth_mm is not None and size.within and not size.child
    ]
    in_mm = [] if width_mm is None else [Fitting(MONDOPOINT, f"{width_mm:.0f}", False)]
    return (*letters, *in_mm)


def letter(girth_mm: float, size: float, rule: WidthRule) -> str:
    """The letter of a ball girth at a size.

    Examples
    --------
    >>> [letter(girth, 37.0, RULES["eu"]) for girth in (230.0, 232.0, 234.0, 180.0, 290.0)]
    ['G', 'G-H', 'H', 'under A', 'over H']
    """
    at_size = rule.girth_mm + rule.per_size_mm * (size - rule.size)
    steps = LETTERS.index(rule.letter) + (girth_mm - at_size) / rule.per_letter_mm
    below, part = math.floor(steps), steps % 1.0
    if MIDDLE_FROM <= part <= MIDDLE_TO and 0 <= below < len(LETTERS) - 1:
        return "-".join(LETTERS[below : below + 2])
    place = round(steps)
    if place < 0:
        return f"under {LETTERS[0]}"
    return LETTERS[place] if place < len(LETTERS) else f"over {LETTERS[-1]}"
