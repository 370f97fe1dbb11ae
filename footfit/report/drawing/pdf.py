"""A layout as PDF: a page for each paper, in true size, the same bytes on every run."""

from __future__ import annotations

import io
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from footfit.report.drawing.layout import Layout
from footfit.report.drawing.papers import MARGIN_MM, Tile
from footfit.report.drawing.parts import BOUNDARY, Block, Line, Words
from footfit.report.pictures.figures import house_style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS_PER_MM = 72.0 / 25.4
BLACK, GREY = "#000000", "#5b6670"
NO_DATES = dict.fromkeys(("CreationDate", "Creator", "Producer"))
DASH_MM = (2.0, 1.2)


def pdf_bytes(layout: Layout) -> bytes:
    """All papers of a layout as one PDF."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_pdf import PdfPages

    target = io.BytesIO()
    settings = {"pdf.fonttype": 42, "path.simplify": False}
    with house_style(), rc_context(settings), PdfPages(target, metadata=NO_DATES) as pages:
        for tile in layout.tiles:
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", "Glyph")  # a letter that the font does not have
                pages.savefig(_page(layout, tile))
    return target.getvalue()


def _page(layout: Layout, tile: Tile) -> Figure:
    """One paper: its part of the drawing inside the margins, and its furniture."""
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle
    from matplotlib.transforms import Affine2D

    width, height = layout.size_mm
    figure = Figure(figsize=(width / 25.4, height / 25.4))
    to_points = Affine2D().scale(1.0 / 25.4) + figure.dpi_scale_trans
    window = Rectangle(
        (MARGIN_MM, MARGIN_MM),
        width - 2.0 * MARGIN_MM,
        height - 2.0 * MARGIN_MM,
        transform=to_points,
    )
    body, furniture = layout.sheet(tile)
    for block, clip in ((body, window), (furniture, None)):
        for artist in _artists(block, to_points, (width, height)):
            figure.add_artist(artist, clip=False)
            if clip is not None:
                artist.set_clip_path(clip)
    return figure


def _artists(block: Block, to_points: Any, size_mm: tuple[float, float]) -> list[Any]:
    """The lines and words of a block that touch the paper."""
    lines = (line for line in block.lines if _touches(line.points, size_mm))
    words = (words for words in block.words if _touches(words.corners, size_mm))
    return [*(_path(line, to_points) for line in lines), *(_text(w, to_points) for w in words)]


def _touches(points: Any, size_mm: tuple[float, float]) -> bool:
    low, high = points.min(axis=0), points.max(axis=0)
    return bool((high > 0.0).all() and (low < np.array(size_mm)).all())


def _path(line: Line, to_points: Any) -> Any:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    points = np.concatenate([line.points, line.points[:1]]) if line.closed else line.points
    path = Path(points, closed=line.closed)
    path.should_simplify = False
    return PathPatch(
        path,
        fill=False,
        transform=to_points,
        edgecolor=BLACK if line.layer == BOUNDARY else GREY,
        linewidth=line.width_mm * POINTS_PER_MM,
        capstyle="butt",
        joinstyle="round" if line.layer == BOUNDARY else "miter",
        linestyle=(0, [part * POINTS_PER_MM for part in DASH_MM]) if line.dashed else "solid",
    )


def _text(words: Words, to_points: Any) -> Any:
    from matplotlib.text import Text

    return Text(
        *words.place,
        words.text,
        transform=to_points,
        fontsize=words.size_mm * POINTS_PER_MM,
        fontweight="bold" if words.bold else "normal",
        color=BLACK,
        ha={"start": "left", "middle": "center", "end": "right"}[words.anchor],
        va="baseline",
        rotation=90.0 if words.turned else 0.0,
        rotation_mode="anchor",
    )
