"""Flare: from an aligned scan to its flare profile and its measures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition, FlareProfile
from footfit.geometry.flare.flare_profile import bottom_profile
from footfit.geometry.measures.landmarks import Shape
from footfit.pipeline.scan.measure import check_side, scan_measures
from footfit.results import AlignedScan, Notice, Profiled

FOOT_SD_DEG = 0.2
"""The least standard deviation of a foot: a smooth scan does not show what noise does to toes."""
SOLELESS_SD_DEG = 2.0
"""Added if the frame is that of a rim: without its sole a foot's angle moved by up to 2.2 deg."""
PLAUSIBLE_FLARE_DEG = {"foot": (-3.0, 33.0), "last": (-20.0, 35.0)}
"""Feet: the mean of 15 deg and five of the standard deviations of 3.5 deg between people. Lasts: a
round range far beyond the trade's straight of 4 to 12 deg, since we know no survey of lasts."""


def profiled_scan(aligned: AlignedScan) -> Profiled:
    """Profile and measure an aligned scan; a left one as its mirror image.

    Raises
    ------
    SideUndecided
        Neither the user nor the shape says which side it is.
    HalfScan
        The scan does not show enough of the bottom's length.
    """
    check_side(aligned.alignment)
    prepared = aligned.prepared
    kind = prepared.pose.kind
    flare = shape_flare(prepared.shape)
    sd_deg = angle_sd_deg(flare.angle_sd_deg, kind, sole=prepared.pose.sole)
    flare = replace(flare, angle_sd_deg=sd_deg)
    return Profiled(aligned, flare, scan_measures(prepared), unusual_flare(flare.angle_deg, kind))


def shape_flare(shape: Shape) -> FlareProfile:
    """The flare profile of a canonical right shape; a last is read as it stands on its heel.

    A last whose stance cannot be read is profiled as it rests.

    Raises
    ------
    HalfScan
        The shape does not show enough of the bottom's length.
    """
    return bottom_profile(shape.flat_bottom, shape.vertices_mm, shape.kind, FlareDefinition())


def angle_sd_deg(scatter_sd_deg: float, kind: str, *, sole: bool) -> float:
    """The standard deviation of a flare angle, by what the mid-points scatter.

    Examples
    --------
    >>> angle_sd_deg(0.06, "last", sole=True), angle_sd_deg(0.06, "foot", sole=True)
    (0.06, 0.2)
    """
    sd_deg = max(scatter_sd_deg, FOOT_SD_DEG) if kind == "foot" else scatter_sd_deg
    return sd_deg if sole else float(np.hypot(sd_deg, SOLELESS_SD_DEG))


def unusual_flare(angle_deg: float, kind: str) -> tuple[Notice, ...]:
    """A warning for a flare that hardly any foot, or last, has: the value stays.

    Examples
    --------
    >>> unusual_flare(15.0, "foot")
    ()
    >>> print(unusual_flare(61.2, "last")[0].message)
    flare +61.2 deg is hardly a last's (-20 to +35): is it whole?
    """
    least, most = PLAUSIBLE_FLARE_DEG[kind]
    if least <= angle_deg <= most:
        return ()
    ask = "does the scan show the whole foot, standing?" if kind == "foot" else "is it whole?"
    words = f"flare {angle_deg:+.1f} deg is hardly a {kind}'s ({least:+.0f} to {most:+.0f}): {ask}"
    return (Notice("suspect_flare", words),)
