"""A layout as one SVG: width and height in mm, and a viewBox in the same numbers."""

from __future__ import annotations

from xml.etree.ElementTree import Element, SubElement, tostring

from footfit.report.drawing.layout import Layout
from footfit.report.drawing.parts import BOUNDARY, Line, Words

FONT = "DejaVu Sans, Verdana, Arial, sans-serif"
BLACK, GREY = "#000000", "#5b6670"


def svg_bytes(layout: Layout) -> bytes:
    """The single paper of a layout on a roll as SVG."""
    width, height = (round(value, 3) for value in layout.size_mm)
    root = Element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "width": f"{_number(width)}mm",
            "height": f"{_number(height)}mm",
            "viewBox": f"0 0 {_number(width)} {_number(height)}",
            "font-family": FONT,
        },
    )
    SubElement(root, "title").text = layout.title
    for block in layout.sheet(layout.tiles[0]):
        for line in block.lines:
            _add_line(root, line, height)
        for words in block.words:
            _add_words(root, words, height)
    text: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def _number(value: float) -> str:
    return f"{value:.3f}".rstrip("0").rstrip(".").replace("-0", "0" if abs(value) < 5e-4 else "-0")


def _add_line(root: Element, line: Line, height: float) -> None:
    points = (f"{_number(x)},{_number(height - y)}" for x, y in line.points.tolist())
    style = {
        "points": " ".join(points),
        "fill": "none",
        "stroke": BLACK if line.layer == BOUNDARY else GREY,
        "stroke-width": _number(line.width_mm),
    }
    if line.name:
        style["class"] = line.name.replace(" ", "-")
    if line.layer == BOUNDARY:
        style["stroke-linejoin"] = "round"
    if line.dashed:
        style["stroke-dasharray"] = "2 1.2"
    SubElement(root, "polygon" if line.closed else "polyline", style)


def _add_words(root: Element, words: Words, height: float) -> None:
    x, y = _number(words.place[0]), _number(height - words.place[1])
    style = {"x": x, "y": y, "font-size": _number(words.size_mm)}
    if words.anchor != "start":
        style["text-anchor"] = words.anchor
    if words.bold:
        style["font-weight"] = "bold"
    if words.turned:
        style["transform"] = f"rotate(-90 {x} {y})"
    SubElement(root, "text", style).text = words.text
