"""By how much measures of two lasts may differ: ``girth=2,length=1.5,width=1``."""

from __future__ import annotations

import math
from collections.abc import Mapping

from footfit.errors import BadOption

TOLERANCE_MM: Mapping[str, float] = {"girth": 2.0, "length": 1.5, "width": 1.0, "height": 1.5}
"""By kind of measure. Makers accept the first three of lasts as delivered; heights are footfit's
own, as lengths."""
MOST_MM = 50.0


def kind_of(measure: str) -> str:
    """The kind of a measure by its name.

    Examples
    --------
    >>> [kind_of(name) for name in ("ball_girth_least", "bottom_width_heel", "toe_spring_tip")]
    ['girth', 'width', 'height']
    """
    return next((kind for kind in ("girth", "length", "width") if kind in measure), "height")


def tolerances(text: str | None) -> dict[str, float]:
    """The tolerance of each kind in mm; what the text does not name keeps its own.

    Raises
    ------
    BadOption
        A part is not KIND=MM, a kind is named twice, or there is none.

    Examples
    --------
    >>> tolerances("girth=1,5; width=0.5")["girth"], tolerances(None)["length"]
    (1.5, 1.5)
    """
    if text is None:
        return dict(TOLERANCE_MM)
    kinds = ", ".join(f"{name}={mm:g}" for name, mm in TOLERANCE_MM.items())
    if not isinstance(text, str) or not _parts(text):
        raise BadOption(f"--tolerance takes a text such as {kinds}, not {text!r}")
    result: dict[str, float] = {}
    for given in _parts(text):
        kind, _, number = (each.strip() for each in given.partition("="))
        try:
            value = float(number.replace(",", "."))
        except ValueError:
            value = math.nan
        if kind.casefold() not in TOLERANCE_MM or not 0.0 <= value <= MOST_MM:
            words = f"--tolerance takes mm from 0 to {MOST_MM:g}, such as {kinds}"
            raise BadOption(f"{words}, not {given!r}")
        if kind.casefold() in result:
            raise BadOption(f"--tolerance names {kind} twice: give it one value")
        result[kind.casefold()] = value
    return {**TOLERANCE_MM, **result}


def _parts(text: str) -> list[str]:
    """The parts between commas or semicolons; a decimal comma belongs to its number."""
    parts: list[str] = []
    for piece in text.replace(";", ",").split(","):
        if parts and piece.strip().isdigit() and "=" in parts[-1] and "," not in parts[-1]:
            parts[-1] += f",{piece.strip()}"
        elif piece.strip():
            parts.append(piece.strip())
    return parts
