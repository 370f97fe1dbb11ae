"""The colours of room: one scale around 0 in mm, in steps, that the colour-blind tell apart.

Steps draw lines of equal room on a surface, which a smooth scale does not, and survive a copier.
"""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats

BREAKS_MM = (-8.0, -6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0, 8.0)
"""Where the colour changes; under the first and over the last all is one colour."""
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
"""Red is tight, blue is room: no one takes one for the other, and both are pale at 0."""
NOT_COMPARED = "#c9ced2"
"""Grey: over the shoe's topline, or nothing of the last is there."""


def rgb(colour: str) -> Floats:
    """A colour as three numbers, 0-1.

    Examples
    --------
    >>> rgb("#ff0033").tolist()
    [1.0, 0.0, 0.2]
    """
    return np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0


def step_of(room_mm: Floats) -> Floats:
    """The place in ``COLOURS`` of each room (n,); NaN stays NaN.

    Examples
    --------
    >>> step_of(np.array([-20.0, -0.1, 0.1, 30.0])).tolist()
    [0.0, 4.0, 5.0, 9.0]
    """
    steps = np.searchsorted(BREAKS_MM, np.nan_to_num(room_mm), side="right").astype(np.float64)
    return np.where(np.isfinite(room_mm), steps, np.nan)


def heat_colours(room_mm: Floats) -> Floats:
    """The colour (n, 3) of each room (n,), 0-1."""
    table = np.array([rgb(colour) for colour in (*COLOURS, NOT_COMPARED)])
    step = np.nan_to_num(step_of(room_mm), nan=len(COLOURS)).astype(np.int64)
    colours: Floats = table[step]
    return colours


def step_words(step: int) -> str:
    """A colour's range in mm.

    Examples
    --------
    >>> step_words(0), step_words(4), step_words(9)
    ('under -8', '-2 to 0', 'over +8')
    """
    if step == 0:
        return f"under {BREAKS_MM[0]:+.0f}"
    if step == len(BREAKS_MM):
        return f"over {BREAKS_MM[-1]:+.0f}"
    low, high = (f"{value:+.0f}" if value else "0" for value in BREAKS_MM[step - 1 : step + 1])
    return f"{low} to {high}"
