"""Drawings read back by other programs: the pixels of a PDF, the numbers of an SVG and a DXF.

Nothing of footfit is imported. A length is read as a person with a ruler would read it: between the
middles of two lines.
"""

from __future__ import annotations

import io
import re
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pypdfium2
from scipy import ndimage

DOTS = 10
"""A pixel is .1 mm; where a grey line lies within it is known to some hundredths."""
MARGIN, OVERLAP = 10, 10
LINE_MM = 0.25
WORDS = "print at 100 %, do not fit to page"
SPACE = "{http://www.w3.org/2000/svg}"


@dataclass(frozen=True)
class Page:
    """One page: its number and how many there are, its row and column and how many there are of
    them, its text, and how dark each pixel is (0 to 1).
    """

    number: tuple[int, int]
    place: tuple[int, int]
    grid: tuple[int, int]
    text: str
    dark: np.ndarray
    size_mm: tuple[float, float]
    title_mm: tuple[float, float] | None


def pages(data: bytes, title: str = "") -> list[Page]:
    """The pages of a PDF; ``title`` is looked for on each, from the upper left corner in mm."""
    found = []
    document = pypdfium2.PdfDocument(data)
    for page in document:
        width, height = (size * 25.4 / 72.0 for size in page.get_size())
        text = page.get_textpage()
        words = text.get_text_bounded()
        number = tuple(map(int, re.search(r"\bsheet (\d+) of (\d+)\b", words).groups()))
        lies = re.search(r"\brow (\d+) of (\d+), column (\d+) of (\d+)\b", words)
        row, rows, column, columns = map(int, lies.groups()) if lies else (1, 1, 1, 1)
        scale = (1.0 - 1e-6) * DOTS * 25.4 / 72.0  # so that 2970.00002 pixels are not made 2971
        image = page.render(scale=scale, grayscale=True).to_numpy()
        at = text.search(title).get_next() if title else None
        place = None
        if at is not None:
            left, bottom, _, top = text.get_charbox(at[0])
            place = left * 25.4 / 72.0, height - 0.5 * (bottom + top) * 25.4 / 72.0
        dark = 1.0 - image.reshape(image.shape[:2]).astype(np.float64) / 255.0
        where = (row - 1, column - 1), (rows, columns)
        found.append(Page(number, *where, words, dark, (width, height), place))
    return found


def lines_mm(profile: np.ndarray, least: float = 0.3) -> list[float]:
    """The middles of the lines that a profile of darkness crosses, in mm from its start."""
    spots, count = ndimage.label(profile > 0.1 * least)
    middles = []
    for spot in range(1, count + 1):
        at = np.flatnonzero(spots == spot)
        if profile[at].sum() > least:
            middles.append((at + 0.5) @ profile[at] / profile[at].sum() / DOTS)
    return middles


def bars_mm(page: Page) -> tuple[float, float]:
    """The lengths of the bar across and of the bar up, between the middles of their ticks."""
    ticks_above = page.dark[round(7.5 * DOTS) : round(8.1 * DOTS), : 111 * DOTS].mean(axis=0)
    ticks_beside = page.dark[-111 * DOTS :, round(7.5 * DOTS) : round(8.1 * DOTS)].mean(axis=1)
    across, up = lines_mm(ticks_above), lines_mm(ticks_beside)
    return across[-1] - across[0], up[-1] - up[0]


def stitched(sheets: list[Page]) -> np.ndarray:
    """The papers laid together by their names: where they overlap the darker pixel counts."""
    height, width = sheets[0].dark.shape
    window = height - 2 * MARGIN * DOTS, width - 2 * MARGIN * DOTS
    pitch = window[0] - OVERLAP * DOTS, window[1] - OVERLAP * DOTS
    rows, columns = (1 + max(sheet.place[axis] for sheet in sheets) for axis in (0, 1))
    whole = np.zeros((rows * pitch[0] + OVERLAP * DOTS, columns * pitch[1] + OVERLAP * DOTS))
    for sheet in sheets:
        row, column = sheet.place
        inner = sheet.dark[MARGIN * DOTS : -MARGIN * DOTS, MARGIN * DOTS : -MARGIN * DOTS]
        there = np.s_[
            row * pitch[0] : row * pitch[0] + window[0],
            column * pitch[1] : column * pitch[1] + window[1],
        ]
        whole[there] = np.maximum(whole[there], inner)
    return whole


def outline_mm(sheets: list[Page]) -> tuple[float, float]:
    """The width and the height of the outline around the title that was looked for, in mm.

    The outline is the smallest thing of connected lines whose box holds the title.
    """
    whole = stitched(sheets)
    sheet = next(sheet for sheet in sheets if sheet.title_mm is not None)
    row, column = sheet.place
    height, width = sheet.dark.shape
    x = (sheet.title_mm[0] - MARGIN) * DOTS + column * (width - (2 * MARGIN + OVERLAP) * DOTS)
    y = (sheet.title_mm[1] - MARGIN) * DOTS + row * (height - (2 * MARGIN + OVERLAP) * DOTS)
    named, _ = ndimage.label(whole > 0.2, np.ones((3, 3)))
    around = [
        (box, number)
        for number, box in enumerate(ndimage.find_objects(named), start=1)
        if box[0].start < y < box[0].stop and box[1].start < x < box[1].stop
        if box[0].stop - box[0].start > 100 * DOTS
    ]
    box, number = min(around, key=lambda pair: pair[0][0].stop - pair[0][0].start)
    grown = tuple(slice(max(side.start - 2, 0), side.stop + 2) for side in box)
    dark = np.where(ndimage.binary_dilation(named[grown] == number, iterations=2), whole[grown], 0)
    return _extent_mm(dark.max(axis=0)), _extent_mm(dark.max(axis=1))


def _extent_mm(profile: np.ndarray) -> float:
    """From the middle of the first line to that of the last: their outer halves are taken off."""
    half = profile > 0.5
    first, last = int(np.argmax(half)), len(half) - 1 - int(np.argmax(half[::-1]))
    ends = []
    for at, step in ((first, -1), (last, 1)):
        inner, outer = profile[at], profile[at + step]
        ends.append(at + 0.5 + step * (inner - 0.5) / max(inner - outer, 1e-9))
    return (ends[1] - ends[0]) / DOTS - LINE_MM


@dataclass(frozen=True)
class Vectors:
    """An SVG or a DXF in mm: closed outlines and open lines (n, 2), y up, and the words."""

    outlines: list[np.ndarray]
    lines: list[np.ndarray]
    words: list[str]
    about: Any

    @property
    def bars_mm(self) -> list[tuple[float, float]]:
        """The spans of the lines that are bars: straight, level or upright, 100 mm about."""
        spans = [tuple(np.ptp(line, axis=0)) for line in self.lines if len(line) == 2]
        return [span for span in spans if min(span) == 0.0 and 90.0 < max(span) < 110.0]


def svg(data: bytes) -> Vectors:
    """An SVG as an XML parser reads it; ``about`` is its root."""
    root = ElementTree.fromstring(data)

    def points(element: ElementTree.Element) -> np.ndarray:
        rows = [pair.split(",") for pair in element.get("points").split()]
        return np.array(rows, dtype=float) * (1.0, -1.0)

    outlines = {"polygon": [], "polyline": []}
    for kind, found in outlines.items():
        found.extend(points(element) for element in root.iter(SPACE + kind))
    words = [element.text for element in root.iter(SPACE + "text")]
    return Vectors(outlines["polygon"], outlines["polyline"], words, root)


def dxf(data: bytes) -> Vectors:
    """A DXF as another program's reader gives it; ``about`` is its document."""
    document = ezdxf.read(io.StringIO(data.decode("cp1252")))
    assert not document.audit().errors
    space = document.modelspace()
    closed, lines = [], []
    for line in space.query("LWPOLYLINE"):
        (closed if line.closed else lines).append(np.array([p[:2] for p in line.get_points()]))
    words = [text.dxf.text for text in space.query("TEXT")]
    return Vectors(closed, lines, words, document)
