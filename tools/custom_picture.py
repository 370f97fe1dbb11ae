"""The picture of docs/custom-lasts.md: a custom last, coloured by how far its surface moved."""

from __future__ import annotations

from pathlib import Path

import footfit

SAMPLES = Path(__file__).resolve().parents[1] / "sample_data"


def custom_picture() -> bytes:
    """The custom last of the worked example as a PNG."""
    foot, base = SAMPLES / "feet" / "mh008_R.stl", SAMPLES / "lasts" / "derby-43.stl"
    (custom,) = footfit.customise(str(foot), str(base), name="mh008")
    return footfit.picture(custom, "png")


if __name__ == "__main__":
    target = Path(__file__).resolve().parents[1] / "docs" / "pictures" / "custom_last.png"
    target.write_bytes(custom_picture())
