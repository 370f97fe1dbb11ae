"""Where blocks go on a drawing: on few papers, and across few borders between papers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.numeric.arrays import Floats
from footfit.report.drawing.papers import UNDER_CROSS_MM, Paper, Tile, crosses_in, tiles_of

PADDING_MM = (2.0, 0.25)
"""Beside each block, and over and under it: it keeps blocks from the edges of papers."""
BELOW_MM = 4.0
"""How far a block is kept from the one below it."""
MOST_COLUMNS = 4
NO_WORDS = np.empty((0, 4))


@dataclass(frozen=True, slots=True)
class Packing:
    """The upper left corner of each block, (n, 2), y negative below the top; its tiles.

    ``height_mm`` is how long a roll must be; ``crossed`` counts the crosses that lie on words.
    """

    corners: Floats
    shown: tuple[frozenset[Tile], ...]
    height_mm: float
    crossed: int = 0

    @property
    def tiles(self) -> frozenset[Tile]:
        """All tiles that show something."""
        return frozenset().union(*self.shown)

    @property
    def cost(self) -> tuple[float, ...]:
        """Fewer papers are better, then fewer crosses on words, then fewer borders through blocks;
        on a roll, a shorter one.
        """
        return len(self.tiles), self.crossed, sum(map(len, self.shown)), self.height_mm


class Size(NamedTuple):
    """How large a block is, with its padding, and where its words are: boxes (n, 4) of left, top,
    right and bottom from its upper left corner, y down. No cross should cover them.
    """

    width: float
    height: float
    words: Floats = NO_WORDS


def packing(sizes: Sequence[Size], paper: Paper) -> Packing:
    """Places for blocks of some sizes, the first first.

    Each block goes to the corner where it needs the fewest new papers and crosses the fewest
    borders. The best of several numbers of columns is taken.
    """
    counts = (1,) if paper.is_roll else range(1, MOST_COLUMNS + 1)
    pitch, window = paper.pitch_mm[0], paper.window_mm[0]
    widths = [pitch * (count - 1) + window for count in counts]
    widest = max(size.width for size in sizes)
    fits = [width for width in widths if width >= widest] or [max(*widths, widest)]
    return min((_packing_within(sizes, paper, width) for width in fits), key=lambda each: each.cost)


def _packing_within(sizes: Sequence[Size], paper: Paper, width_mm: float) -> Packing:
    boxes = np.empty((0, 4))  # left, top, right, bottom; y down
    shown: list[frozenset[Tile]] = []
    crossed = 0
    for size in sizes:
        used = frozenset[Tile]().union(*shown)
        keyed = []
        for left, top in _free_places(boxes, size, width_mm, paper):
            box = left, top, left + size.width, top + size.height
            tiles = tiles_of(left, -top, box[2], -box[3], paper)
            words = size.words + np.array([left, top, left, top])
            covered = crosses_in(words, tiles, paper)
            keyed.append((len(tiles - used), len(tiles), covered, box[3], left, box, tiles))
        _, _, covered, *_, box, tiles = min(keyed, key=lambda key: key[:-2])
        boxes = np.vstack([boxes, box])
        shown.append(tiles)
        crossed += covered
    height_mm = float(boxes[:, 3].max()) if paper.is_roll else 0.0
    return Packing(boxes[:, :2] * (1.0, -1.0), tuple(shown), height_mm, crossed)


def _free_places(
    boxes: Floats, size: Size, width_mm: float, paper: Paper
) -> list[tuple[float, float]]:
    """Places beside and below the other boxes, and at the corners of papers, that are free."""
    rows = range(1 + int(boxes[:, 3].max(initial=0.0) // paper.pitch_mm[1]) + 1)
    lefts = {0.0, *(boxes[:, 2]).tolist()}
    tops = {0.0, *(boxes[:, 3] + BELOW_MM).tolist()}
    if not paper.is_roll:
        columns = [column * paper.pitch_mm[0] for column in range(MOST_COLUMNS)]
        lefts |= {at + beside for at in columns for beside in (0.0, UNDER_CROSS_MM)}
        tops |= {row * paper.pitch_mm[1] for row in rows}
        tops |= {row * paper.pitch_mm[1] + UNDER_CROSS_MM for row in rows}
    free = []
    for left in sorted(lefts):
        if left + size.width > width_mm + 1e-9:
            continue
        for top in sorted(tops):
            apart = (
                (boxes[:, 0] >= left + size.width - 1e-9)
                | (boxes[:, 2] <= left + 1e-9)
                | (boxes[:, 1] >= top + size.height + BELOW_MM - 1e-9)
                | (boxes[:, 3] <= top - BELOW_MM + 1e-9)
            )
            if apart.all():
                free.append((left, top))
    return free
