"""Shapes drawn in true size: the views and measures of a last or a foot, and their files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Unpack

from footfit.api.inputs import ReadingKeywords, Shape, known_keywords
from footfit.api.scans import aligned_shape
from footfit.errors import BadOption

if TYPE_CHECKING:
    from footfit.results import Drawing

DRAWING_KINDS = ("pdf", "svg", "dxf")
PaperChoice = Literal["a4", "a3", "letter", "roll"]
"""What a PDF is printed on; a roll is one sheet, as an SVG and a DXF are."""


@known_keywords(ReadingKeywords)
def drawing(shape: Shape, *, foot: bool = False, **reading: Unpack[ReadingKeywords]) -> Drawing:
    """The views of a last, or of a ``foot``, in true size: bottom, plan, side, sections.

    Raises
    ------
    OtherKind
        By its shape it is a foot where a last is asked for, or the other way round.
    InputError, GeometryRefused
        As `measure`.
    """
    from footfit.pipeline.last_making.shape_drawing import drawing_of

    return drawing_of(aligned_shape(shape, reading), foot=foot)


def drawing_file(drawing: Drawing, kind: str = "pdf", paper: PaperChoice | None = None) -> bytes:
    """A drawing as the bytes of a "pdf", "svg" or "dxf", the same bytes on every run.

    ``paper`` is what a PDF is printed on, "a4" by default; an SVG and a DXF are one sheet.

    Raises
    ------
    BadOption
        Another kind of file, or a paper for a file that is one sheet.
    """
    from footfit.pipeline.export import require_kind
    from footfit.report.drawing.dxf import dxf_bytes
    from footfit.report.drawing.layout import layout
    from footfit.report.drawing.papers import PAPERS
    from footfit.report.drawing.pdf import pdf_bytes
    from footfit.report.drawing.svg import svg_bytes

    require_kind(kind, DRAWING_KINDS)
    if kind == "pdf":
        if paper is not None and paper not in PAPERS:
            raise BadOption(f"there is no paper {paper!r}; give {', '.join(PAPERS)}")
        return pdf_bytes(layout(drawing, PAPERS[paper or "a4"]))
    if paper not in (None, "roll"):
        raise BadOption(f"an {kind.upper()} is one sheet: leave out --paper, or write a .pdf")
    write = svg_bytes if kind == "svg" else dxf_bytes
    return write(layout(drawing, PAPERS["roll"]))


@known_keywords(ReadingKeywords)
def draw_last(
    shape: Shape,
    file_kind: str = "pdf",
    *,
    foot: bool = False,
    paper: PaperChoice | None = None,
    **reading: Unpack[ReadingKeywords],
) -> bytes:
    """A last, or a ``foot``, drawn in true size (1:1), as the bytes of a file.

    Parameters
    ----------
    shape : path, bytes, (vertices, faces), Scan, AlignedScan or Profiled
        `Catalogue.shape` gives a last of the catalogue.
    file_kind : {"pdf", "svg", "dxf"}
    foot : bool
        Draw a foot.
    paper : {"a4", "a3", "letter", "roll"}, optional
        What a PDF is printed on; without it A4.
    **reading
        See `ReadingKeywords`.

    Raises
    ------
    OtherKind, BadOption
        As `drawing` and `drawing_file`.
    InputError, GeometryRefused
        As `measure`.
    """
    return drawing_file(drawing(shape, foot=foot, **reading), file_kind, paper)
