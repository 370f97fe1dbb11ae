"""What a drawing is made of: lines, words, and blocks of both. All in mm, x right and y up."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from footfit.geometry.numeric.arrays import Floats

Anchor = Literal["start", "middle", "end"]
Point = tuple[float, float]

BOUNDARY, INTERNAL, NOTE = 1, 8, 15
"""Layers of AAMA and ASTM D6673: the outline of a piece, lines inside it, annotation."""
EDGE_MM, FINE_MM = 0.25, 0.13
"""How wide an outline is, whose middle is the edge, and how wide all other lines are."""
LETTER, BOLD_LETTER = 0.62, 0.70
"""About how wide a letter is, over the size of the font."""


@dataclass(frozen=True, slots=True)
class Line:
    """A polyline (n, 2) on a layer; ``closed`` joins its last point to its first."""

    points: Floats
    layer: int = INTERNAL
    name: str = ""
    closed: bool = False
    width_mm: float = FINE_MM
    dashed: bool = False


@dataclass(frozen=True, slots=True)
class Words:
    """One line of text; ``size_mm`` is that of the font. ``turned`` text reads upward."""

    text: str
    place: Point
    size_mm: float = 2.5
    anchor: Anchor = "start"
    turned: bool = False
    bold: bool = False

    @property
    def corners(self) -> Floats:
        """Two opposite corners (2, 2) of what the words cover, about."""
        long = len(self.text) * self.size_mm * (BOLD_LETTER if self.bold else LETTER)
        start = {"start": 0.0, "middle": -0.5, "end": -1.0}[self.anchor] * long
        low, high = -0.25 * self.size_mm, 0.80 * self.size_mm
        box = [(start, low), (start + long, high)]
        if self.turned:
            box = [(-high, start), (-low, start + long)]
        return np.array(box) + self.place


@dataclass(frozen=True, slots=True)
class Block:
    """Lines and words that stay together."""

    lines: tuple[Line, ...] = ()
    words: tuple[Words, ...] = ()

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """The lower left and the upper right corner, (2,) each."""
        pieces = [line.points for line in self.lines] + [words.corners for words in self.words]
        points = np.concatenate(pieces)
        return points.min(axis=0), points.max(axis=0)

    def moved(self, right_mm: float, up_mm: float) -> Block:
        """The block at another place."""
        by = np.array([right_mm, up_mm])
        lines = tuple(replace(line, points=line.points + by) for line in self.lines)
        words = tuple(
            replace(each, place=(each.place[0] + right_mm, each.place[1] + up_mm))
            for each in self.words
        )
        return Block(lines, words)

    def quarter_turned(self) -> Block:
        """The block turned by 90 degrees, from the right to up; its words were not turned yet."""
        turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
        lines = tuple(replace(line, points=line.points @ turn) for line in self.lines)
        words = tuple(
            replace(each, place=(-each.place[1], each.place[0]), turned=True) for each in self.words
        )
        return Block(lines, words)


def joined(blocks: Iterable[Block]) -> Block:
    """Several blocks as one."""
    all_blocks = list(blocks)
    lines = tuple(line for block in all_blocks for line in block.lines)
    return Block(lines, tuple(words for block in all_blocks for words in block.words))


def straight(start: Point, end: Point, name: str = "", *, dashed: bool = False) -> Line:
    """A straight line inside a piece."""
    return Line(np.array([start, end]), name=name, dashed=dashed)


def paragraph(
    lines: Iterable[str],
    top: Point,
    size_mm: float = 2.5,
    *,
    anchor: Anchor = "start",
    bold: bool = False,
) -> tuple[Words, ...]:
    """Lines of text below each other, from a place at their upper edge down."""
    x, y = top
    step = 1.45 * size_mm
    return tuple(
        Words(text, (x, y - size_mm - row * step), size_mm, anchor, bold=bold)
        for row, text in enumerate(lines)
    )
