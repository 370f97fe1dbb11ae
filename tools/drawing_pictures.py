"""The sheets of a drawing beside each other, for docs/custom-lasts.md."""

from __future__ import annotations

import io
from pathlib import Path

import footfit

SAMPLES = Path(__file__).resolve().parents[1] / "sample_data"
DOTS_PER_INCH = 60
GAP = 12
TABLE = "#c9d0d6"
COLOURS = 16


def drawing_pictures() -> dict[str, bytes]:
    """All sheets of one last in a row."""
    import pypdfium2
    from PIL import Image

    document = pypdfium2.PdfDocument(footfit.draw_last(SAMPLES / "lasts" / "derby-38.stl"))
    sheets = [page.render(scale=DOTS_PER_INCH / 72.0).to_pil() for page in document]
    width = sum(sheet.width + GAP for sheet in sheets) + GAP
    row = Image.new("RGB", (width, sheets[0].height + 2 * GAP), TABLE)
    left = GAP
    for sheet in sheets:
        row.paste(sheet.convert("RGB"), (left, GAP))
        left += sheet.width + GAP
    target = io.BytesIO()
    row.quantize(COLOURS, dither=Image.Dither.NONE).save(target, "png", optimize=True)
    return {"drawing.png": target.getvalue()}
