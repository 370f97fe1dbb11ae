"""The colours of a clearance: one scale of steps around 0 mm that the colour-blind tell apart.

On a surface the steps draw lines of equal clearance; a smooth scale does not. They also survive a
copier.
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
"""Red is tight, blue is space: no one takes one for the other, and both are pale at 0."""
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


def heat_colours(clearance_mm: Floats) -> Floats:
    """The colour (n, 3) of each clearance (n,), 0-1; `NOT_COMPARED` of a NaN.

    Examples
    --------
    >>> steps = heat_colours(np.array([-20.0, -0.1, 0.1, 30.0]))
    >>> bool(np.all(steps == [rgb(COLOURS[k]) for k in (0, 4, 5, 9)]))
    True
    """
    table = np.array([rgb(colour) for colour in (*COLOURS, NOT_COMPARED)])
    step = np.searchsorted(BREAKS_MM, clearance_mm, side="right")
    colours: Floats = table[np.where(np.isfinite(clearance_mm), step, len(COLOURS))]
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
