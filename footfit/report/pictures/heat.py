"""The colours of a clearance: one scale of steps around 0 mm that the colour-blind tell apart.

On a surface the steps draw lines of equal clearance; a smooth scale does not. They also survive a
copier.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats

STEP_MM = 2.0
"""How far apart the colours are, except where two nearly equal lasts are compared."""
COLOURS = (
    "#67001f",
    "#b2182b",
    "#d6604d",
    "#f4a582",
    "#fddbc7",
    "#d1e5f0",
    "#92c5de",
    "#4393c3",
    "#2166ac",
    "#053061",
)
"""Red is tight, blue is space: no one takes one for the other, and both are pale at 0."""
NEUTRAL = "#f4f1e3"
"""Where two surfaces are compared: cream, in the middle of the scale, is no difference."""
NOT_COMPARED = "#c9ced2"
"""Grey: above the shoe's topline, or where the last has no surface."""
SHADE = 0.42
"""How much of a colour the shade may take: little, so that it is still the legend's."""


def rgb(colour: str) -> Floats:
    """A colour as three numbers, 0-1.

    Examples
    --------
    >>> rgb("#ff0033").tolist()
    [1.0, 0.0, 0.2]
    """
    return np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0


def scale_colours(*, neutral: bool = False) -> tuple[str, ...]:
    """The colours from tight to loose; a ``neutral`` scale has one more, for no difference."""
    half = len(COLOURS) // 2
    return (*COLOURS[:half], NEUTRAL, *COLOURS[half:]) if neutral else COLOURS


def breaks_mm(step_mm: float = STEP_MM, *, neutral: bool = False) -> tuple[float, ...]:
    """Where the colour changes; under the first and over the last all is one colour.

    Examples
    --------
    >>> breaks_mm()
    (-8.0, -6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0, 8.0)
    >>> breaks_mm(1.0, neutral=True)
    (-4.5, -3.5, -2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 3.5, 4.5)
    """
    half = len(COLOURS) // 2
    if neutral:
        return tuple(step_mm * (place + 0.5) for place in range(-half, half))
    return tuple(step_mm * place for place in range(1 - half, half))


def heat_colours(
    clearance_mm: Floats, step_mm: float = STEP_MM, *, neutral: bool = False
) -> Floats:
    """The colour (n, 3) of each clearance (n,), 0-1; `NOT_COMPARED` of a NaN.

    Examples
    --------
    >>> steps = heat_colours(np.array([-20.0, -0.1, 0.1, 30.0]))
    >>> bool(np.all(steps == [rgb(COLOURS[k]) for k in (0, 4, 5, 9)]))
    True
    """
    table = np.array([rgb(c) for c in (*scale_colours(neutral=neutral), NOT_COMPARED)])
    step = np.searchsorted(breaks_mm(step_mm, neutral=neutral), clearance_mm, side="right")
    colours: Floats = table[np.where(np.isfinite(clearance_mm), step, len(table) - 1)]
    return colours


def break_words(value_mm: float) -> str:
    """A place where the colour changes, in mm.

    Examples
    --------
    >>> break_words(-8.0), break_words(0.0), break_words(0.75)
    ('-8', '0', '+.75')
    """
    return f"{value_mm:+.3g}".replace("0.", ".") if value_mm else "0"


def step_words(step: int, step_mm: float = STEP_MM, *, neutral: bool = False) -> str:
    """A colour's range in mm.

    Examples
    --------
    >>> step_words(0), step_words(4), step_words(9), step_words(6, 0.25)
    ('under -8', '-2 to 0', 'over +8', '+.25 to +.5')
    """
    breaks = [break_words(value) for value in breaks_mm(step_mm, neutral=neutral)]
    if step == 0:
        return f"under {breaks[0]}"
    if step == len(breaks):
        return f"over {breaks[-1]}"
    return f"{breaks[step - 1]} to {breaks[step]}"
