"""From an aligned mesh to its flare profile and its measures."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from footfit.errors import SideUndecided
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.flare_profile import flare_profile
from footfit.geometry.measures import measure_table
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.results import AlignedScan, Alignment, Measure, Measured, Notice, Profiled

FOOT_SD_DEG = 0.2
"""The least that is said of a foot: a smooth scan does not show what noise does to its toes."""
SOLELESS_SD_DEG = 2.0
"""Added where the frame is that of a rim: without its sole a foot's angle moved by up to 2.2."""
PLAUSIBLE_FLARE_DEG = {"foot": (-3.0, 33.0), "last": (-20.0, 35.0)}
"""Feet: the mean of 15 and five of the standard deviations of 3.5 deg between people; lasts: a
round range far beyond the trade's straight of 4 to 12, since no survey of lasts is known to us."""


def profiled(aligned: AlignedScan, definition: FlareDefinition | None = None) -> Profiled:
    """Profile and measure an aligned mesh; a left one as its mirror image.

    Parameters
    ----------
    aligned : AlignedScan
    definition : FlareDefinition, optional

    Returns
    -------
    Profiled

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    HalfScan
        The scan does not show enough of the bottom's length.
    """
    alignment = aligned.alignment
    check_side(alignment)
    vertices_mm, faces = aligned.prepared.vertices_mm, aligned.prepared.faces
    flare = flare_profile(vertices_mm, faces, definition, alignment.pose.kind)
    kind = alignment.pose.kind
    sd_deg = angle_sd_deg(flare.angle_sd_deg, kind, sole=alignment.pose.sole)
    flare = replace(flare, angle_sd_deg=sd_deg)
    found = believed(measured(vertices_mm, faces, kind), alignment.warnings)
    return Profiled(aligned, flare, found, flare_suspects(flare.angle_deg, kind))


def check_side(alignment: Alignment) -> None:
    """Refuse a shape whose side is undecided: its medial side would be the wrong one.

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    """
    if alignment.side.side is None:
        words = "the shape does not show which side it is: give --side left or --side right"
        raise SideUndecided(words, alignment.info.path)


def angle_sd_deg(scatter_sd_deg: float, kind: str, *, sole: bool) -> float:
    """What is said of a flare angle's standard deviation, given what the mid-points scatter by.

    Examples
    --------
    >>> angle_sd_deg(0.06, "last", sole=True), angle_sd_deg(0.06, "foot", sole=True)
    (0.06, 0.2)
    """
    sd_deg = max(scatter_sd_deg, FOOT_SD_DEG) if kind == "foot" else scatter_sd_deg
    return sd_deg if sole else float(np.hypot(sd_deg, SOLELESS_SD_DEG))


def flare_suspects(angle_deg: float, kind: str) -> tuple[Notice, ...]:
    """A warning for a flare that hardly any foot, or last, has: the value stays.

    Examples
    --------
    >>> flare_suspects(15.0, "foot")
    ()
    >>> print(flare_suspects(61.2, "last")[0].message)
    flare +61.2 deg is hardly a last's (-20 to +35): is it whole?
    """
    least, most = PLAUSIBLE_FLARE_DEG[kind]
    if least <= angle_deg <= most:
        return ()
    ask = "does the scan show the whole foot, standing?" if kind == "foot" else "is it whole?"
    words = f"flare {angle_deg:+.1f} deg is hardly a {kind}'s ({least:+.0f} to {most:+.0f}): {ask}"
    return (Notice("suspect_flare", words),)


END_MEASURES = frozenset({"length", "functional_length", "tape_length", "ball_length"})
"""What is counted from the pternion or to the toes."""


def believed(rows: tuple[Measure, ...], warnings: Iterable[Notice]) -> tuple[Measure, ...]:
    """The measures without those that are another's where an end is open: nothing, with the reason,
    instead of a number that is short by what was not scanned.
    """
    reason = next((notice.message for notice in warnings if notice.code == "open_end"), None)
    if reason is None:
        return rows
    unknown = Measured(None, reason=reason)
    return tuple(replace(r, measured=unknown) if r.name in END_MEASURES else r for r in rows)


def measured(vertices_mm: Floats, faces: Ints, kind: str = "foot") -> tuple[Measure, ...]:
    """Every measure of the table that a kind of shape has, on a canonical right shape.

    Parameters
    ----------
    vertices_mm : (n, 3)
    faces : (m, 3)
    kind : {"foot", "last"}

    Returns
    -------
    tuple of Measure
        In the table's order; one that cannot be taken has a reason instead of a value.
    """
    shape = Shape(vertices_mm, faces, kind)
    return tuple(_row(entry, shape) for entry in measure_table.of_kind(kind))


def _row(entry: measure_table.MeasureDefinition, shape: Shape) -> Measure:
    reading = entry.value_of(shape)
    sd = None if reading.value is None else entry.sd
    return Measure(entry.name, Measured(reading.value, sd, reading.reason), entry.definition_id)
