"""Papers, and how a drawing that is larger than one is cut into tiles."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.report.drawing.parts import EDGE_MM, Block, Line, Words, straight

PaperName = Literal["a4", "a3", "letter", "roll"]
MARGIN_MM = OVERLAP_MM = 10.0
BAR_MM = 100.0
BAR_FROM_EDGE_MM = 8.5  # printers reach to some 4.3 mm of the paper's edge
TICK_MM = 1.2
CROSS_MM = 3.0
UNDER_CROSS_MM = 0.5 * OVERLAP_MM + CROSS_MM
"""From the upper edge of a paper's window to the lower end of its upper crosses."""
MOST_LETTERS = 70
"""Of the title that stands over the bar."""
PRINT_WORDS = "print at 100 %, do not fit to page"


@dataclass(frozen=True, slots=True)
class Paper:
    """A paper in mm. A roll is as long as the drawing, and has one tile."""

    width_mm: float
    height_mm: float

    @property
    def is_roll(self) -> bool:
        """Whether the drawing decides how long it is."""
        return math.isinf(self.height_mm)

    @property
    def window_mm(self) -> tuple[float, float]:
        """How much of a drawing one paper shows."""
        return self.width_mm - 2.0 * MARGIN_MM, self.height_mm - 2.0 * MARGIN_MM

    @property
    def pitch_mm(self) -> tuple[float, float]:
        """From tile to tile: neighbours share an overlap."""
        width, height = self.window_mm
        return width - OVERLAP_MM, height - OVERLAP_MM


PAPERS: dict[PaperName, Paper] = {
    "a4": Paper(210.0, 297.0),
    "a3": Paper(297.0, 420.0),
    "letter": Paper(215.9, 279.4),
    "roll": Paper(610.0, math.inf),
}


@dataclass(frozen=True, slots=True, order=True)
class Tile:
    """One paper of a drawing, by its row from the top and its column from the left."""

    row: int
    column: int

    def place_words(self, last: Tile) -> str:
        """Where it lies among tiles whose lower right corner is ``last``.

        Examples
        --------
        >>> Tile(1, 2).place_words(Tile(1, 3))
        'row 2 of 2, column 3 of 4'
        """
        row, column = f"row {self.row + 1} of {last.row + 1}", f"column {self.column + 1}"
        return f"{row}, {column} of {last.column + 1}"

    def top_left_mm(self, paper: Paper) -> tuple[float, float]:
        """The upper left corner of the tile's window on the drawing."""
        if paper.is_roll:
            return 0.0, 0.0
        return self.column * paper.pitch_mm[0], -self.row * paper.pitch_mm[1]


def tiles_of(left: float, top: float, right: float, bottom: float, paper: Paper) -> frozenset[Tile]:
    """The fewest tiles in a rectangle of them that show a box; y is negative below the top.

    Examples
    --------
    >>> sorted(tiles_of(0.0, 0.0, 195.0, -277.0, PAPERS["a4"]))
    [Tile(row=0, column=0), Tile(row=0, column=1)]
    """
    if paper.is_roll:
        return frozenset({Tile(0, 0)})
    spans = []
    for start, end, window, pitch in zip(
        (left, -top), (right, -bottom), paper.window_mm, paper.pitch_mm, strict=True
    ):
        first = math.floor(start / pitch + 1e-9)
        spans.append(range(first, max(first, math.ceil((end - window) / pitch - 1e-9)) + 1))
    return frozenset(Tile(row, column) for column in spans[0] for row in spans[1])


def furniture(width_mm: float, height_mm: float, name: str, place: str, title: str) -> Block:
    """What stands on every paper: bars in both directions, the words, its name, where it lies among
    the others, its crosses.

    In the coordinates of the paper, from its lower left corner.
    """
    top, side = height_mm - BAR_FROM_EDGE_MM, BAR_FROM_EDGE_MM
    across = _bar("bar across")
    bars = (
        across.moved(MARGIN_MM, top).lines
        + _bar("bar up").quarter_turned().moved(side, MARGIN_MM).lines
    )
    words = (
        Words(f"100 mm   {PRINT_WORDS}", (MARGIN_MM + BAR_MM + 2.5, top), 2.4),
        Words("100 mm", (side + 0.9, MARGIN_MM + BAR_MM + 2.5), 2.4, turned=True),
        Words(
            title if len(title) <= MOST_LETTERS else f"{title[:MOST_LETTERS]} ...",
            (MARGIN_MM, top + 1.9),
            2.2,
        ),
        Words(name, (width_mm - MARGIN_MM, top - 0.8), 3.2, "end", bold=True),
        Words(place, (width_mm - MARGIN_MM, top + 2.4), 2.2, "end"),
    )
    shown = tuple(each for each in words if each.text)
    return Block(bars + crosses(width_mm, height_mm), shown)


def _bar(name: str) -> Block:
    """A bar from 0 to the right; the middles of its ticks are its ends."""
    bar = Line(np.array([[0.0, 0.0], [BAR_MM, 0.0]]), name=name, width_mm=EDGE_MM)
    ticks = (straight((x, -TICK_MM), (x, TICK_MM)) for x in (0.0, BAR_MM))
    return Block((bar, *ticks))


def crosses(width_mm: float, height_mm: float) -> tuple[Line, ...]:
    """A cross in each corner, in the middle of the overlap: neighbours have the same one."""
    inset = MARGIN_MM + 0.5 * OVERLAP_MM
    return tuple(
        line
        for x in (inset, width_mm - inset)
        for y in (inset, height_mm - inset)
        for line in (
            straight((x - CROSS_MM, y), (x + CROSS_MM, y)),
            straight((x, y - CROSS_MM), (x, y + CROSS_MM)),
        )
    )


def crosses_in(boxes: Floats, tiles: Iterable[Tile], paper: Paper) -> int:
    """How many crosses of some tiles boxes (n, 4) of left, top, right, bottom touch; y down.

    Examples
    --------
    >>> crosses_in(np.array([[0.0, 0.0, 90.0, 50.0]]), {Tile(0, 0)}, PAPERS["a4"])
    1
    >>> crosses_in(np.array([[0.0, UNDER_CROSS_MM, 90.0, 50.0]]), {Tile(0, 0)}, PAPERS["a4"])
    0
    """
    if paper.is_roll:
        return 0
    inset = 0.5 * OVERLAP_MM
    corners = [
        (x + left, y - top)
        for left, top in (tile.top_left_mm(paper) for tile in tiles)
        for x in (inset, paper.window_mm[0] - inset)
        for y in (inset, paper.window_mm[1] - inset)
    ]
    at = np.array(corners).reshape(-1, 1, 2)
    inside = np.all((boxes[:, :2] < at + CROSS_MM) & (at - CROSS_MM < boxes[:, 2:]), axis=2)
    return int(np.count_nonzero(np.any(inside, axis=1)))
