"""Feet in groups: by size, width, flare, or any column of their table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.sizes import SYSTEMS, SizeSystem, size_words
from footfit.geometry.fit.width_fitting import LETTERS, RULES
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.pipeline.population.tables import FootTable

FLARE_BIN_DEG = 4.0
MOST_VALUES = 20
"""A column of numbers that has more different ones is put into bins."""
BINS = 8
UNKNOWN = "not known"


@dataclass(frozen=True, slots=True)
class FootGroups:
    """The groups of n feet by one thing: their ``names`` in order, and the group (n,) of each."""

    by: str
    names: tuple[str, ...]
    group: Ints


def nearest_sizes(length_mm: Floats, system: SizeSystem) -> Floats:
    """The nearest size that is sold, on the adults' scale, (n,); see `sizes.foot_size`."""
    exact = (length_mm - system.zero_mm) / system.step_mm
    return np.asarray(np.floor(exact / system.grid + 0.5 + 1e-9) * system.grid)


def letter_places(girth_mm: Floats, length_mm: Floats, system: str) -> Floats:
    """How many letters from A the ball girth of feet is at their size, (n,), as whole numbers."""
    rule = RULES[system]
    size = nearest_sizes(length_mm, SYSTEMS[system])
    at_size = rule.girth_mm + rule.per_size_mm * (size - rule.size)
    steps = LETTERS.index(rule.letter) + (girth_mm - at_size) / rule.per_letter_mm
    return np.asarray(np.round(steps))


def letter_words(place: float) -> str:
    """A width by its place among the letters.

    Examples
    --------
    >>> [letter_words(place) for place in (-2.0, 0.0, 6.0, 9.0)]
    ['under A', 'A', 'G', 'over H']
    """
    if place < 0:
        return f"under {LETTERS[0]}"
    return LETTERS[int(place)] if place < len(LETTERS) else f"over {LETTERS[-1]}"


def letter_system(system: str) -> str:
    """The size system whose letters go with a size system."""
    return system if system in RULES else "eu"


def usual_groups(feet: FootTable, system: str) -> list[FootGroups]:
    """The feet by size, by width, and by flare if it is known."""
    sizes = nearest_sizes(feet.length_mm, SYSTEMS[system])
    letters = letter_system(system)
    girth_mm = feet.shapes.value_of("ball_girth")
    places = np.clip(letter_places(girth_mm, feet.length_mm, letters), -1, len(LETTERS))
    groups = [
        _groups("size", sizes, [size_words(size, SYSTEMS[system]) for size in _values(sizes)]),
        _groups("width", places, [letter_words(place) for place in _values(places)]),
    ]
    flare = np.floor(feet.shapes.flare_deg / FLARE_BIN_DEG)
    if np.isfinite(flare).any():
        groups.append(_groups("flare", flare, _bin_names(_values(flare), FLARE_BIN_DEG, " deg")))
    return groups


def column_groups(name: str, texts: Sequence[str]) -> FootGroups:
    """The feet by a column: each text is a group; many different numbers are put into bins."""
    try:
        numbers = np.array([text.replace(",", ".") or "nan" for text in texts], dtype=np.float64)
    except ValueError:
        numbers = np.full(len(texts), np.nan)
    different = _values(numbers)
    if np.isfinite(numbers).any() and len(different) > MOST_VALUES:
        width = _round_width(float(np.ptp(different)) / BINS)
        bins = np.floor(numbers / width)
        return _groups(name, bins, _bin_names(_values(bins), width, ""))
    if len(different) and np.isfinite(numbers).sum() == sum(map(bool, texts)):
        return _groups(name, numbers, [f"{value:g}" for value in different])
    names = sorted(set(filter(None, texts)))
    place = {text: float(at) for at, text in enumerate(names)}
    return _groups(name, np.array([place.get(text, np.nan) for text in texts]), names)


def _values(numbers: Floats) -> Floats:
    """The different numbers in order, without NaN."""
    return np.unique(numbers[np.isfinite(numbers)])


def _groups(by: str, numbers: Floats, names: Sequence[str]) -> FootGroups:
    """The groups of numbers; those that are not known are a group of their own, the last one."""
    known = np.isfinite(numbers)
    group = np.full(len(numbers), len(names))
    group[known] = np.searchsorted(_values(numbers), numbers[known])
    return FootGroups(by, tuple(names) if known.all() else (*names, UNKNOWN), group)


def _bin_names(bins: Floats, width: float, unit: str) -> list[str]:
    shown = [[f"{end * width:{'+' if unit else ''}g}" for end in (low, low + 1.0)] for low in bins]
    return [f"{low} to {high}{unit}" for low, high in shown]


def _round_width(width: float) -> float:
    """The next round number: 1, 2 or 5 with zeros.

    Examples
    --------
    >>> [round(_round_width(width), 6) for width in (0.3, 1.2, 37.0, 51.0)]
    [0.5, 2.0, 50.0, 100.0]
    """
    power = 10.0 ** np.floor(np.log10(max(width, 1e-9)))
    return float(next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= width))
