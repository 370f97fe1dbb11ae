"""A layout as DXF R2000 in mm: closed polylines on the layers of shoe CAD, without blocks."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from footfit.report.drawing.layout import Layout
from footfit.report.drawing.parts import BOUNDARY, INTERNAL, NOTE, Line, Words

if TYPE_CHECKING:
    from ezdxf.layouts.layout import Modelspace

CAPITAL = 0.72
"""How high a capital letter is, over the size of the font: a DXF text is as high."""
UNIT_WORDS = "units: mm, scale 1:1"


def dxf_bytes(layout: Layout) -> bytes:
    """The single paper of a layout on a roll as DXF."""
    from ezdxf import units
    from ezdxf.filemanagement import new

    with _no_dates():
        document = new("R2000", units=units.MM)
        for layer in (BOUNDARY, INTERNAL, NOTE):
            document.layers.add(str(layer))
        space = document.modelspace()
        for block in layout.sheet(layout.tiles[0]):
            for line in block.lines:
                _add_line(space, line)
            for words in block.words:
                _add_words(space, words)
        _add_words(space, Words(UNIT_WORDS, (10.0, 4.0)))
        target = io.StringIO()
        document.write(target)
        return document.encode(target.getvalue())


@contextmanager
def _no_dates() -> Iterator[None]:
    """Write the same dates, ids and version on every run."""
    from ezdxf._options import options

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def _add_line(space: Modelspace, line: Line) -> None:
    points = line.points.round(4).tolist()
    space.add_lwpolyline(points, close=line.closed, dxfattribs={"layer": str(line.layer)})


def _add_words(space: Modelspace, words: Words) -> None:
    from ezdxf.enums import TextEntityAlignment

    side = {"start": "LEFT", "middle": "CENTER", "end": "RIGHT"}[words.anchor]
    text = space.add_text(
        words.text,
        height=CAPITAL * words.size_mm,
        rotation=90.0 if words.turned else 0.0,
        dxfattribs={"layer": str(NOTE)},
    )
    text.set_placement(words.place, align=TextEntityAlignment[side])
