"""How far a measured value may be from the true one: its total standard deviation and its bias.

A value's ``sd`` is its repeatability. Its ``total_sd`` also holds the trueness of the measure, what
the shape leaves open, the step in which the file keeps its coordinates, and the scanner. All these
are standard deviations in mm, and independent of each other, so their squares are added.
"""

from __future__ import annotations

import math

from footfit.errors import BadOption
from footfit.geometry.measures.measure_table import MeasureDefinition
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.results import Measured, MeshInfo

SCANNER_SD_MM = {  # lengths, widths and heights, girths
    "laser": {"length": 1.0, "width": 1.0, "height": 1.0, "girth": 2.0},
    "handheld": {"length": 1.5, "width": 1.5, "height": 1.5, "girth": 2.5},
    "phone": {"length": 3.0, "width": 3.0, "height": 3.0, "girth": 5.0},
    "photos": {"length": 6.0, "width": 4.0, "height": 4.0, "girth": 8.0},
}
"""What is assumed of a kind of scanner; no source gives heights, which get what widths have."""
STEP_SHARE = {"length": 0.45, "width": 0.45, "height": 0.45, "girth": 0.65}
"""The standard deviation by the step of a file's coordinates, over the step (decision 0184)."""


def measured(
    entry: MeasureDefinition,
    taken: MeasureValue,
    kind: str,
    heel_mm: float | None,
    info: MeshInfo | None = None,
) -> Measured:
    """A value with its uncertainties, as a result.

    Parameters
    ----------
    entry : MeasureDefinition
    taken : MeasureValue
    kind : {"foot", "last"}
    heel_mm : float or None
        How high the heel of a last stands by its shape: the trueness depends on it.
    info : MeshInfo, optional
        What is known of the scan.
    """
    if taken.value is None:
        return Measured(None, reason=taken.reason)
    trueness = entry.trueness(kind)
    sd = entry.sd_of(kind) if taken.sd is None else taken.sd
    parts = (
        sd,
        trueness.sd_at(heel_mm),
        taken.convention_sd,
        taken.tilt_mm,
        scan_sd_mm(entry.name, info),
    )
    total_sd = math.hypot(*parts)
    return Measured(taken.value, sd, None, total_sd, trueness.bias)


def scan_sd_mm(name: str, info: MeshInfo | None) -> float:
    """What the file and the scanner add to a measure of that name.

    Examples
    --------
    >>> scan_sd_mm("ball_girth", None)
    0.0
    """
    if info is None:
        return 0.0
    quantity = quantity_of(name)
    if quantity == "angle":  # over the length of a seat, steps and scanners turn it by little
        return 0.0
    step_mm = STEP_SHARE[quantity] * info.resolution_mm
    return math.hypot(step_mm, SCANNER_SD_MM[info.scanner][quantity] if info.scanner else 0.0)


def quantity_of(name: str) -> str:
    """Whether a measure is a length, a width, a height, a girth or an angle.

    Examples
    --------
    >>> quantity_of("ball_girth_least"), quantity_of("toe_spring"), quantity_of("tape_length")
    ('girth', 'height', 'length')
    """
    for word, quantity in (("girth", "girth"), ("width", "width"), ("_deg", "angle")):
        if word in name:
            return quantity
    return "height" if "height" in name or "spring" in name else "length"


def check_scanner(scanner: str | None) -> None:
    """Refuse a kind of scanner that is not known.

    Raises
    ------
    BadOption
        It is none of ``SCANNER_SD_MM``.
    """
    if scanner is not None and scanner not in SCANNER_SD_MM:
        raise BadOption(f"unknown scanner {scanner!r}; give {', '.join(SCANNER_SD_MM)}")
