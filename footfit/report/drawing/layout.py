"""A drawing laid out on paper: every line and word at its place, and the tiles that show them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from footfit.report.drawing.packing import PADDING_MM, Packing, Size, packing
from footfit.report.drawing.papers import MARGIN_MM, Paper, Tile, furniture
from footfit.report.drawing.parts import Block, joined
from footfit.report.drawing.title_block import tile_map, title_block, title_words
from footfit.report.drawing.view_blocks import view_block
from footfit.results import Drawing

TEXT, MAP = "text", "map"
MAP_ROUNDS = 3
"""How often the map of the papers is drawn anew, if it needs a paper that it does not show."""
LEAST_ROLL_MM = 260.0
"""How wide a drawing on a roll is at least: what stands on top of it needs so much."""


@dataclass(frozen=True, slots=True)
class Layout:
    """Blocks at their places, y negative below the drawing's upper left corner.

    ``shown`` has the tiles that a block needs, for each block. ``tiles`` are all papers, by row;
    ``size_mm`` is that of each paper.
    """

    blocks: tuple[Block, ...]
    shown: tuple[frozenset[Tile], ...]
    paper: Paper
    size_mm: tuple[float, float]
    title: str

    @property
    def tiles(self) -> tuple[Tile, ...]:
        """The papers that show something."""
        return tuple(sorted(frozenset().union(*self.shown)))

    @property
    def last_tile(self) -> Tile:
        """The lower right corner of the grid of papers."""
        rows, columns = zip(*((tile.row, tile.column) for tile in self.tiles), strict=True)
        return Tile(max(rows), max(columns))

    def sheet(self, tile: Tile) -> tuple[Block, Block]:
        """What a paper shows of the drawing, and its furniture, from its lower left corner."""
        width, height = self.size_mm
        left, top = tile.top_left_mm(self.paper)
        pairs = zip(self.blocks, self.shown, strict=True)
        body = joined(block for block, shown in pairs if tile in shown)
        tiles = self.tiles
        name = f"sheet {tiles.index(tile) + 1} of {len(tiles)}"
        place = tile.place_words(self.last_tile) if len(tiles) > 1 else ""
        furnished = furniture(width, height, name, place, self.title)
        return body.moved(MARGIN_MM - left, height - MARGIN_MM - top), furnished


def layout(drawing: Drawing, paper: Paper) -> Layout:
    """A drawing on paper: on as few papers as its views need.

    The side view lies, or stands with its toe up; some orders of the blocks are tried.
    """
    upright = {view.name: view_block(drawing, view) for view in drawing.views}
    upright[TEXT] = title_block(drawing)
    large = [name for name in ("bottom", "plan") if name in upright]
    small = [TEXT, *(name for name in upright if name not in (*large, "side", TEXT))]
    tried = []
    for side in (upright["side"], upright["side"].quarter_turned()):
        blocks = upright | {"side": side}
        for place in range(len(large), -1, -1):
            names = [*large[:place], "side", *large[place:], *small]
            tried.append((_packing(blocks, names, paper), blocks, names))
    best, blocks, names = min(tried, key=lambda each: each[0].cost)
    for _ in range(MAP_ROUNDS if len(best.tiles) > 1 else 0):
        tiles = best.tiles
        blocks = blocks | {MAP: tile_map(sorted(tiles), paper)}
        best = _packing(blocks, [*names, MAP], paper)
        if best.tiles == tiles:
            break
    return _laid_out(blocks, names, best, paper, title_words(drawing))


def _packing(blocks: Mapping[str, Block], names: Sequence[str], paper: Paper) -> Packing:
    return packing([_size(blocks[name]) for name in names], paper)


def _laid_out(
    blocks: Mapping[str, Block], names: Sequence[str], places: Packing, paper: Paper, title: str
) -> Layout:
    """The blocks at their places, in their own order: the bottom comes first."""
    rows = zip((*names, MAP), places.corners, places.shown, strict=False)
    known = {name: (corner, tiles) for name, corner, tiles in rows}
    placed, shown = [], []
    for name, block in blocks.items():
        (left, top), tiles = known[name]
        low, high = block.bounds
        right, up = left + PADDING_MM[0] - low[0], top - PADDING_MM[1] - high[1]
        placed.append(block.moved(float(right), float(up)))
        shown.append(tiles)
    size_mm = paper.width_mm, paper.height_mm
    if paper.is_roll:
        low, high = joined(placed).bounds
        edge_mm = 2.0 * MARGIN_MM + PADDING_MM[0]
        size_mm = max(float(high[0]) + edge_mm, LEAST_ROLL_MM), float(-low[1]) + edge_mm
    return Layout(tuple(placed), tuple(shown), paper, size_mm, title)


def _size(block: Block) -> Size:
    """How large a block is with its padding, and where its words are in it."""
    low, high = block.bounds
    width, height = high - low + np.multiply(2.0, PADDING_MM)
    start = np.array([low[0] - PADDING_MM[0], high[1] + PADDING_MM[1]])
    boxes = [
        (*(corners - start)[:, 0], *(start - corners)[:, 1])
        for words in block.words
        for corners in [words.corners]
    ]  # left, right, bottom, top
    return Size(float(width), float(height), np.array(boxes).reshape(-1, 4)[:, [0, 3, 1, 2]])
