"""The fitter's page and the customer's sheet as a browser shows them, for README."""

from __future__ import annotations

import io
import tempfile
from datetime import date
from pathlib import Path

import footfit
from tests import browsing

SAMPLES = Path(__file__).resolve().parents[1] / "sample_data"
PAIR = [str(SAMPLES / "feet" / name) for name in ("mh007_L.stl", "mh007_R.stl")]
DAY = date(2026, 11, 28)
SIZES = {"page.png": (1080, 1005), "sheet.png": (820, 1090)}
SHOWN_WIDTH = 820
COLOURS = 256
"""Of a picture's palette: a page has few colours, and the file is then a third."""


def page_pictures() -> dict[str, bytes]:
    """The upper part of a pair's page, and its sheet; none without a browser."""
    if browsing.BROWSER is None:
        print(f"{browsing.MISSING}: {' and '.join(SIZES)} stay as they are")
        return {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = folder / "lasts.footfit"
        footfit.open_catalogue(path).ingest(manifest=SAMPLES / "lasts.csv")
        match = footfit.match([*PAIR], path)
        pages = {
            "page.png": footfit.page(match, path, title="A shop", customer="A customer"),
            "sheet.png": footfit.sheet(match, title="A shop", customer="A customer", day=DAY),
        }
        return {name: _picture(page, folder, name) for name, page in pages.items()}


def _picture(page: str, folder: Path, name: str) -> bytes:
    """A page in a browser, from its top, as a small PNG."""
    from PIL import Image

    browsing.browse(page, folder / f"{name} shown", size=SIZES[name])
    image = Image.open(folder / f"{name} shown" / "page.png").convert("RGB")
    height = round(image.height * SHOWN_WIDTH / image.width)
    image = image.resize((SHOWN_WIDTH, height), Image.Resampling.LANCZOS)
    target = io.BytesIO()
    image.quantize(COLOURS, dither=Image.Dither.NONE).save(target, "png", optimize=True)
    return target.getvalue()
