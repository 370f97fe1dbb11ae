"""How far a measured value may be from the true one: its total standard deviation and its bias.

A value's ``sd`` is its repeatability. Its ``total_sd`` also holds the trueness of the measure, what
the shape leaves open, the step in which the file keeps its coordinates, and the scanner. All these
are standard deviations in mm, and independent of each other, so their squares are added.
"""

from __future__ import annotations

import math
from typing import NamedTuple

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


class Trueness(NamedTuple):
    """How far a measure is from its definition on shapes whose truth is known, in mm.

    ``sd`` is the root mean square of the errors, with the ``bias`` in it but without what is
    repeatability; ``bias`` is their mean. See ``benchmarks/trueness.py``.
    """

    sd: float
    bias: float


TRUENESS: dict[str, dict[str, Trueness]] = {
    "last": {
        "length": Trueness(0.35, -0.27),
        "functional_length": Trueness(0.38, -0.30),
        "ball_length": Trueness(0.75, 0.24),
        "ball_width": Trueness(0.42, -0.34),
        "ball_width_orthogonal": Trueness(0.27, -0.32),
        "ball_girth": Trueness(0.94, -0.71),
        "waist_girth": Trueness(0.25, -0.25),
        "instep_girth": Trueness(0.40, -0.43),
        "long_heel_girth": Trueness(0.61, -0.43),
        "short_heel_girth": Trueness(4.11, -1.34),
        "ball_girth_least": Trueness(0.90, -0.17),
        "waist_girth_least": Trueness(0.79, 0.30),
        "instep_girth_least": Trueness(0.22, 0.07),
        "heel_girth_instep": Trueness(1.77, 0.20),
        "heel_width": Trueness(0.00, -0.06),
        "arch_height": Trueness(0.39, 0.10),
        "instep_height": Trueness(0.33, 0.06),
        "toe_height": Trueness(0.53, 0.27),
        "toe_spring": Trueness(0.00, -0.56),
        "heel_height": Trueness(0.00, -0.24),
        "bottom_width_ball": Trueness(1.77, 1.28),
        "bottom_width_heel": Trueness(0.35, -0.32),
        "tape_length": Trueness(0.85, -0.64),
        "stick_length": Trueness(0.35, -0.17),
        "toe_spring_tip": Trueness(0.30, 0.46),
        "tread_from": Trueness(0.00, 1.03),
        "tread_to": Trueness(0.00, -0.48),
        "seat_angle_deg": Trueness(0.00, 0.01),
    },
    "foot": {
        "length": Trueness(0.21, -0.26),
        "functional_length": Trueness(0.22, -0.24),
        "ball_length": Trueness(0.78, 0.80),
        "ball_width": Trueness(0.27, -0.16),
        "ball_width_orthogonal": Trueness(0.28, -0.31),
        "ball_girth": Trueness(0.75, -0.57),
        "waist_girth": Trueness(0.04, -0.22),
        "instep_girth": Trueness(0.24, -0.29),
        "long_heel_girth": Trueness(0.40, -0.05),
        "short_heel_girth": Trueness(0.00, -0.35),
        "ball_girth_least": Trueness(0.53, -0.15),
        "waist_girth_least": Trueness(0.00, 0.07),
        "instep_girth_least": Trueness(0.00, 0.02),
        "heel_girth_instep": Trueness(0.48, 0.45),
        "heel_width": Trueness(0.00, -0.11),
        "arch_height": Trueness(0.62, -0.49),
        "instep_height": Trueness(0.67, -0.60),
        "toe_height": Trueness(0.00, -0.15),
        "toe_spring": Trueness(0.00, -0.18),
    },
}
"""By kind and measure; the table of docs/measures.md shows the families it comes from."""


def measured(
    entry: MeasureDefinition, taken: MeasureValue, kind: str, info: MeshInfo | None = None
) -> Measured:
    """A value with its uncertainties, as a result.

    Parameters
    ----------
    entry : MeasureDefinition
    taken : MeasureValue
    kind : {"foot", "last"}
    info : MeshInfo, optional
        What is known of the scan.
    """
    if taken.value is None:
        return Measured(None, reason=taken.reason)
    trueness = TRUENESS[kind].get(entry.name)
    if trueness is None:
        return Measured(taken.value, entry.sd)
    parts = (entry.sd, trueness.sd, taken.convention_sd, scan_sd_mm(entry.name, info))
    total_sd = math.hypot(*parts)
    return Measured(taken.value, entry.sd, None, total_sd, trueness.bias)


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
