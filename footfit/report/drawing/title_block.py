"""What is written on a drawing once: what it shows, how to print it, every measure."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

import numpy as np

from footfit.geometry.measures.heights import HEIGHTS
from footfit.number_words import plain
from footfit.report.drawing.measure_words import LENGTH_WORDS, measure_words
from footfit.report.drawing.papers import PRINT_WORDS, Paper, Tile
from footfit.report.drawing.parts import Anchor, Block, Line, Words, joined, paragraph, straight
from footfit.report.wording.text import OF_RIM, SPREADS, file_name, visible
from footfit.results import Drawing
from footfit.version import __version__

COLUMNS_MM = (0.0, 60.0, 69.0, 82.0, 84.0)
"""Where the columns of the table of measures are: name, value, spread, total, unit."""
DEFINITION_MM, DEFINITION_LETTERS_MM = 28.0, 1.7
"""Where the definition of a measure stands, in small letters."""
ROW_MM = 3.7
LETTERS, TITLE_LETTERS = 56, 26
"""Of a line of text."""
ACCEPT_WORDS = "both bars must measure 99.5 to 100.5 mm, on every sheet"
FEATHER_WORDS = (
    "Facets of 2 to 3 mm move the feather edge of the bottom by up to .15 mm, irregular ones by up"
    " to .5 mm."
)
MAP_MM = 12.0
"""How high a paper is on the map of the papers."""


def title_words(drawing: Drawing) -> str:
    """The last or the file, its side and its size, in one line."""
    alignment = drawing.alignment
    labels = drawing.labels
    parts = (
        str(labels.get("size_system") or "").upper(),
        labels.get("size"),
        labels.get("width_label"),
    )
    size = " ".join(str(part) for part in parts if part)
    name = str(labels.get("name") or file_name(alignment.info.path))
    words = (name, f"{alignment.side.side} {alignment.pose.kind}", size)
    return visible(", ".join(part for part in words if part))


def title_block(drawing: Drawing) -> Block:
    """The block of text: what is drawn, how to print it, and the table of measures."""
    title = textwrap.wrap(title_words(drawing), TITLE_LETTERS)
    head = paragraph(title, (0.0, 0.0), 5.0, bold=True)
    notes = [line for text in _notes(drawing) for line in textwrap.wrap(text, LETTERS)]
    below = -1.75 - 7.25 * len(title)
    text = paragraph(notes, (0.0, below), 2.4)
    table = _table(drawing, below - 1.45 * 2.4 * len(notes) - 3.0)
    return joined([Block(words=head + text), table])


def _notes(drawing: Drawing) -> Iterable[str]:
    """What should be known of the drawing, one paragraph each."""
    style = drawing.labels.get("style")
    if style:
        yield f"style {visible(str(style))}"
    yield f"True size, 1:1, in mm. {PRINT_WORDS.capitalize()}: {ACCEPT_WORDS}."
    yield "The edge is the middle of the line. Outlines are drawn to .05 mm."
    alignment = drawing.alignment
    if alignment.pose.kind == "last" and "bottom" not in drawing.missing:
        yield FEATHER_WORDS
    yield f"SHA-256 of the mesh file: {alignment.info.sha256}"
    copies = (notice.message for notice in alignment.warnings if notice.code == "stored_copy")
    yield from (f"{words[:1].upper()}{words[1:]}." for words in copies)
    yield from _pair(drawing)
    if alignment.pose.kind == "last":
        yield LENGTH_WORDS
    if drawing.tolerance_mm:
        rows = drawing.tolerance_mm.items()
        kinds = ", ".join(f"{kind} {value:g}" for kind, value in rows)
        yield f"Tolerance of a last as delivered, mm: {kinds}."
    if drawing.missing:
        yield f"Not drawn, because the scan is open there: {', '.join(drawing.missing)}."
    if drawing.has_rim:
        yield f"{OF_RIM[:1].upper()}{OF_RIM[1:]}."
    yield f"{SPREADS} footfit {__version__}"


def _pair(drawing: Drawing) -> Iterable[str]:
    """Heel height and toe spring, which belong together."""
    stance = drawing.alignment.stance
    names = ("heel_height", "toe_spring_tip", "stick_length", "length")
    heel, spring, stick, long = (_value(drawing, name) for name in names)
    if stance is None or heel is None or spring is None or stick is None or long is None:
        return
    touching_mm = HEIGHTS.toe_spring * long / (1.0 - stance.spring_per_heel)
    less = stick / touching_mm - 1.0
    yield (
        f"Heel height {plain(heel)} mm and toe spring at the tip {plain(spring)} mm are a pair, by"
        f" the {stance.decided_by}: 1 mm more of heel is {plain(less, 2)} mm less of spring there."
    )


def _value(drawing: Drawing, name: str) -> float | None:
    measure = drawing.value_of(name)
    return None if measure is None else measure.measured.value


def _table(drawing: Drawing, top: float) -> Block:
    """Every measure by name and definition, with both uncertainties, or why there is none."""
    heads = zip(COLUMNS_MM, ("measure", "value", "±", "total ±", ""), strict=True)
    words = [_cell(text, column, top - ROW_MM, bold=True) for column, text in heads]
    y = top - ROW_MM - 1.2
    rule = straight((0.0, y), (COLUMNS_MM[-1] + 6.0, y))
    for measure in drawing.measures:
        y -= ROW_MM
        words.append(_cell(measure_words(measure.name, drawing.alignment.pose.kind), 0.0, y))
        words.append(Words(measure.definition, (DEFINITION_MM, y), DEFINITION_LETTERS_MM))
        measured = measure.measured
        if measured.value is None:
            reason = textwrap.shorten(measured.reason or "not measured", 40, placeholder=" ...")
            words.append(_cell(reason, COLUMNS_MM[1] - 8.0, y, start=True))
            continue
        values = (measured.value, measured.sd, measured.total_sd)
        texts = ["" if value is None else plain(value) for value in values]
        cells = zip(COLUMNS_MM[1:], [*texts, measure.unit], strict=True)
        words += [_cell(text, column, y) for column, text in cells]
    return Block((rule,), tuple(each for each in words if each.text))


def _cell(text: str, column: float, y: float, *, bold: bool = False, start: bool = False) -> Words:
    """A cell of the table: the name and the unit begin at their column, numbers end there."""
    anchor: Anchor = "start" if start or column in (COLUMNS_MM[0], COLUMNS_MM[-1]) else "end"
    return Words(text, (column, y), 2.4, anchor, bold=bold)


def tile_map(tiles: Iterable[Tile], paper: Paper) -> Block:
    """How the papers lie beside each other, with their numbers."""
    blocks = [
        Block(words=paragraph(["lay the crosses of the sheets over each other:"], (0.0, 0.0), 2.4))
    ]
    height = MAP_MM
    width = height * paper.window_mm[0] / paper.window_mm[1]
    for number, tile in enumerate(tiles, start=1):
        left, top = tile.column * width, -5.0 - tile.row * height
        corners = [(0.0, 0.0), (width, 0.0), (width, -height), (0.0, -height)]
        box = Line(np.add(corners, (left, top)), closed=True)
        middle = (left + 0.5 * width, top - 0.5 * height - 0.9)
        blocks.append(Block((box,), (Words(str(number), middle, 2.4, "middle"),)))
    return joined(blocks)
