"""Shoe sizes from a foot's length, and a last's label against its geometry.

Sources: [iso9407] for Mondopoint, [iso19407] for the conversions; ``docs/fit.md`` has the table.
A size is ``(foot length - zero) / step``. A last is longer than the foot it is made for, and by how
much is part of the system.
"""

from __future__ import annotations

import math
import re
import unicodedata
from dataclasses import dataclass

from footfit.number_words import RATIO_KEPT, plain

PARIS_POINT_MM = 20.0 / 3.0
BARLEYCORN_MM = 25.4 / 3.0
EQUALLY_LONG_MM = 1.0
"""Two feet whose lengths differ by less are equally long for any size."""
LABEL_TOLERANCE_SIZES = 1.0
"""A label that is further off its last's length than this is reported."""
LENGTH_NAME = "length"
"""What the length is called that a label is compared with, unless the caller says otherwise."""


@dataclass(frozen=True, slots=True)
class SizeSystem:
    """One system: ``exact = (foot length - zero_mm) / step_mm``.

    ``grid`` is the step in which sizes are sold. A size under ``child_below`` is a child's;
    ``child_add`` is by how much the children's own numbers are higher, None if all have one scale.
    ``least`` and ``largest`` are the smallest and the largest size made. ``allowance_mm`` is how
    much longer a last of the size is than the foot, from and to. ``numbers_per_size`` is how far
    apart the labels of two whole sizes are.
    """

    name: str
    title: str
    step_mm: float
    zero_mm: float
    grid: float
    child_below: float
    child_add: float | None
    least: float
    largest: float
    allowance_mm: tuple[float, float]
    numbers_per_size: float = 1.0


_EU_ALLOWANCE_MM = 2.0 * PARIS_POINT_MM  # 13.3: size = 1.5 FL_cm + 2 = 1.5 (last length in cm)
_TWO_BARLEYCORNS_MM = (2.0 * BARLEYCORN_MM, 2.0 * BARLEYCORN_MM)  # 16.9; a size is 3 FL_in - zero
# fmt: off
SYSTEMS: dict[str, SizeSystem] = {system.name: system for system in (
    # name, title; step and zero in mm; grid; child_below, child_add; least, largest; allowance_mm
    SizeSystem("eu", "EU", PARIS_POINT_MM, -_EU_ALLOWANCE_MM, 1.0, 35.0, None, 16.0, 52.0,
               (_EU_ALLOWANCE_MM, _EU_ALLOWANCE_MM)),
    SizeSystem("uk", "UK", BARLEYCORN_MM, 23.0 * BARLEYCORN_MM, 0.5, 1.0, 13.0, -12.0, 16.0,
               _TWO_BARLEYCORNS_MM),
    SizeSystem("us-men", "US men", BARLEYCORN_MM, 22.0 * BARLEYCORN_MM, 0.5, 1.0, 13.0, -12.0, 16.0,
               _TWO_BARLEYCORNS_MM),
    SizeSystem("us-women", "US women", BARLEYCORN_MM, 20.5 * BARLEYCORN_MM, 0.5, 2.5, 11.5,
               -10.5, 17.5, _TWO_BARLEYCORNS_MM),
    SizeSystem("us-women-fia", "US women (FIA)", BARLEYCORN_MM, 21.0 * BARLEYCORN_MM, 0.5, 2.0,
               12.0, -11.0, 17.0, _TWO_BARLEYCORNS_MM),
    SizeSystem("mondopoint", "Mondopoint", 1.0, 0.0, 5.0, 220.0, None, 95.0, 345.0,
               (10.0, 17.0),  # the label is the foot's length; the last's is the maker's
               numbers_per_size=5.0),
)}
# fmt: on
ALIASES = {"us": "us-men", "fr": "eu", "paris": "eu", "mondo": "mondopoint", "gb": "uk"}


@dataclass(frozen=True, slots=True)
class Size:
    """A foot's size in one system.

    ``exact`` is the formula's number, ``nearest`` the nearest size that is sold, also in ``words``;
    ``beside`` are the next smaller and larger, in words. ``within`` is False if no such size is
    made.
    """

    system: str
    exact: float
    nearest: float
    words: str
    beside: tuple[str, str]
    child: bool
    within: bool


@dataclass(frozen=True, slots=True)
class LabelCheck:
    """A last's label against its length: ``by_length`` is the size that its length has, and ``off``
    the label minus that, in whole sizes; + means that the label is too large. ``length_name`` says
    which length counts.
    """

    system: str
    by_length: float
    off: float
    length_name: str = LENGTH_NAME

    @property
    def flagged(self) -> bool:
        """Is the label more than a size from the geometry?"""
        return abs(self.off) > LABEL_TOLERANCE_SIZES


def system_named(name: str | None) -> SizeSystem | None:
    """The system of that name or alias, in any case; None for one that is not known.

    Examples
    --------
    >>> system_named("EU").title, system_named("US_Men").title, system_named("shop's own")
    ('EU', 'US men', None)
    """
    if name is None:
        return None
    plain = "-".join(name.casefold().replace("_", " ").replace("-", " ").split())
    return SYSTEMS.get(ALIASES.get(plain, plain))


def exact_size(foot_length_mm: float, system: SizeSystem) -> float:
    """The formula's number for a foot of this length (mm), unrounded, on the adults' scale.

    Examples
    --------
    >>> round(exact_size(260.0, SYSTEMS["eu"]), 3)  # 1.5 x 26 + 2
    41.0
    >>> round(exact_size(254.0, SYSTEMS["uk"]), 3)  # 3 x 10 - 23
    7.0
    """
    return (foot_length_mm - system.zero_mm) / system.step_mm


def foot_size(foot_length_mm: float, system: SizeSystem) -> Size:
    """The nearest size of a foot, with the two beside it.

    Examples
    --------
    >>> size = foot_size(261.0, SYSTEMS["eu"])
    >>> size.words, size.beside
    ('EU 41', ('EU 40', 'EU 42'))
    >>> foot_size(180.0, SYSTEMS["uk"]).words
    "UK child's 11.5"
    >>> foot_size(365.0, SYSTEMS["eu"]).words
    'over EU 52, the largest made'
    """
    exact = exact_size(foot_length_mm, system)
    nearest = _nearest_sold(exact, system)
    smaller, words, larger = (
        size_words(nearest + step * system.grid, system) for step in (-1.0, 0.0, 1.0)
    )
    return Size(
        system=system.name,
        exact=exact,
        nearest=nearest,
        words=words,
        beside=(smaller, larger),
        child=nearest < system.child_below,
        within=system.least <= nearest <= system.largest,
    )


def _nearest_sold(exact: float, system: SizeSystem) -> float:
    """The nearest size that is sold; half-way goes up, since a shoe is better too long."""
    return math.floor(exact / system.grid + 0.5 + 1e-9) * system.grid


def foot_sizes(foot_length_mm: float) -> tuple[Size, ...]:
    """A foot's size in every system."""
    return tuple(foot_size(foot_length_mm, system) for system in SYSTEMS.values())


def size_words(size: float, system: SizeSystem) -> str:
    """A size on the adults' scale in words, children's in their own numbers.

    Examples
    --------
    >>> size_words(41.0, SYSTEMS["eu"]), size_words(33.0, SYSTEMS["eu"])
    ('EU 41', "EU child's 33")
    >>> size_words(7.5, SYSTEMS["us-men"]), size_words(0.5, SYSTEMS["uk"])
    ('US men 7.5', "UK child's 13.5")
    """
    child_add = system.child_add or 0.0
    if size < system.least:
        return f"under {system.title} child's {system.least + child_add:g}, the least made"
    if size > system.largest:
        return f"over {system.title} {system.largest:g}, the largest made"
    if size < system.child_below:
        return f"{system.title} child's {size + child_add:g}"
    return f"{system.title} {size:g}"


_LABEL = re.compile(
    r"\s*(\d+(?:[.,]\d+)?)(?:\s*([¼½¾⅓⅔])|\s+([1-3])[/⁄]([234]))?\s*([cky])?\s*", re.IGNORECASE
)
"""A number, a fraction in one character or in three (42⅔, 42 2/3), and a child's letter."""


def label_check(
    label: str | None,
    system_name: str | None,
    last_length_mm: float | None,
    length_name: str = LENGTH_NAME,
) -> LabelCheck | None:
    """A last's label against its length (mm), or one of another name; None if the label or its
    system says no number, or if the length is not known.

    A label that can be an adult's or a child's counts as the one that is nearer to the length.

    Examples
    --------
    >>> check = label_check("42", "eu", 280.0)
    >>> round(check.by_length, 2), round(check.off, 2), check.flagged
    (42.0, 0.0, False)
    >>> label_check("38", "eu", 280.0).flagged, label_check("large", "eu", 280.0)
    (True, None)
    """
    system, labelled = system_named(system_name), label_number(label)
    if system is None or labelled is None or last_length_mm is None:
        return None
    number, child = labelled
    as_child = number - (system.child_add or 0.0)
    meanings = {as_child} if child or system.child_add is None else {number, as_child}
    shortest, longest = system.allowance_mm
    least, most = (exact_size(last_length_mm - mm, system) for mm in (longest, shortest))
    by_length = {size: min(max(size, least), most) for size in meanings}
    nearest = min(meanings, key=lambda size: (abs(size - by_length[size]), size))
    off = (nearest - by_length[nearest]) / system.numbers_per_size
    return LabelCheck(system.name, by_length[nearest], off, length_name)


def label_in(label: str | None, system_name: str | None, asked: str | None) -> str | None:
    """A last's label in another system: the size of the foot that the label is made for.

    None if the label or one of the systems says no number, or if the label is in that system.

    Examples
    --------
    >>> label_in("40", "eu", "uk"), label_in("40", "eu", "eu"), label_in("L", "eu", "uk")
    ('UK 7', None, None)
    """
    own, other, labelled = system_named(system_name), system_named(asked), label_number(label)
    if own is None or other is None or own == other or labelled is None:
        return None
    number, child = labelled
    adult = number - (own.child_add or 0.0) if child else number
    return foot_size(own.zero_mm + own.step_mm * adult, other).words


def label_number(label: str | None) -> tuple[float, bool] | None:
    """The number of a label, and whether the label says that it is a child's (12C, 12K).

    Examples
    --------
    >>> [label_number(label)[0] for label in ("6½", "6,5", "6.5 ", "6 1/2")]
    [6.5, 6.5, 6.5, 6.5]
    >>> [round(label_number(label)[0], 3) for label in ("42⅔", "42 2/3", "42 ⅔")]
    [42.667, 42.667, 42.667]
    >>> label_number("42W")
    """
    parts = _LABEL.fullmatch(label or "")
    if parts is None:
        return None
    fraction = unicodedata.numeric(parts[2]) if parts[2] else 0.0
    if parts[3]:
        fraction = int(parts[3]) / int(parts[4])
    number = float(parts[1].replace(",", ".")) + fraction
    return number, (parts[5] or "").lower() in ("c", "k")


def label_words(check: LabelCheck) -> str:
    """What a label that is off should say.

    Examples
    --------
    >>> label_words(LabelCheck("eu", 42.04, -4.04))
    'labelled 4.0 sizes smaller than its length: it is EU 42 by its length'
    """
    system = SYSTEMS[check.system]
    nearest = _nearest_sold(check.by_length, system)
    word = "larger" if check.off > 0 else "smaller"
    return (
        f"labelled {plain(abs(check.off), 1, RATIO_KEPT)} sizes {word} than its"
        f" {check.length_name}: it is {size_words(nearest, system)} by its length"
    )
