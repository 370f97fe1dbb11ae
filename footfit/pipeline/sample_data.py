"""The sample lasts and feet that come with footfit."""

from __future__ import annotations

from pathlib import Path

from footfit.errors import UnreadableFile

PACKAGE = Path(__file__).resolve().parents[1]
PLACES = (PACKAGE / "_sample_data", PACKAGE.parent / "sample_data")
"""Where it lies in an installed footfit, and in a source tree."""


def sample_folder() -> Path:
    """The folder of the sample data.

    Raises
    ------
    UnreadableFile
        It is not there.
    """
    for place in PLACES:
        if (place / "lasts.csv").is_file():
            return place
    raise UnreadableFile("the sample data is missing; install footfit again", str(PLACES[0]))
