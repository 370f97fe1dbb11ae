"""Sections of a foot and the last around it by the same planes, and the sections' sizes.

Both are canonical right shapes in mm. The stations are places along the foot, counted from its
heel. The ball's plane is the upright one through the foot's own MT1 and MT5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.stations import STATIONS, Station
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.measure_value import UNSCANNED, MeasureValue
from footfit.geometry.mesh.outlines import Outline
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class SectionSettings:
    """Widths are taken up to ``band``, a share of the foot's length, over a section's lowest point:
    ankles stand out above it.
    """

    band: float = 0.15


SECTIONS = SectionSettings()
SIZES = ("width", "medial", "lateral", "height")
"""What is measured of a section; "medial" and "lateral" are the edges' places across."""
CUT = "at the {place} the section runs out of the {kind}'s top, or is open"


@dataclass(frozen=True, slots=True)
class SectionPair:
    """Foot and last, cut by one plane: their outlines as (across, up), + across is medial.

    ``foot_sizes`` and ``last_sizes`` are by name, in the order of ``SIZES``.
    """

    station: Station
    x_mm: float
    foot: Outline
    last: Outline
    foot_sizes: dict[str, MeasureValue]
    last_sizes: dict[str, MeasureValue]


def section_pairs(foot: Shape, last: Shape) -> tuple[SectionPair, ...]:
    """The sections of a foot and the last around it, at every station."""
    return tuple(_pair(foot, last, station) for station in STATIONS)


def _pair(foot: Shape, last: Shape, station: Station) -> SectionPair:
    origin, axes = station_plane(foot, station)
    band_mm = SECTIONS.band * foot.length_mm
    ours, theirs = foot.cut(origin, axes), last.cut(origin, axes)
    return SectionPair(
        station=station,
        x_mm=float(origin[0]),
        foot=ours,
        last=theirs,
        foot_sizes=_sizes(foot, ours, station, band_mm),
        last_sizes=_sizes(last, theirs, station, band_mm),
    )


def station_plane(foot: Shape, station: Station) -> tuple[Floats, Floats]:
    """A point (3,) of a station's plane, in the middle of the foot, and its two axes (2, 3)."""
    if station.oblique and foot.ball_plane is not None:
        return foot.ball_plane
    return np.array([foot.x_mm(station.share), 0.0, 0.0]), AXES[1:]


def _sizes(
    shape: Shape, section: Outline, station: Station, band_mm: float
) -> dict[str, MeasureValue]:
    """Widths from the band over the sole; the height only of a whole section. A tape follows other
    planes, so a section has no girth.
    """
    points = section.points
    if not len(points):
        missing = MeasureValue(None, f"the {shape.kind} does not reach so far")
        return dict.fromkeys(SIZES, missing)
    below_mm = float(points[:, 1].min()) + band_mm
    low = points[points[:, 1] <= below_mm, 0]
    medial, lateral = float(low.max()), float(low.min())
    height = MeasureValue(float(np.ptp(points[:, 1])))
    if shape.topped(section):
        height = MeasureValue(None, CUT.format(kind=shape.kind, place=station.name))
    elif shape.unscanned(section):
        height = MeasureValue(None, UNSCANNED)
    values = (MeasureValue(medial - lateral), MeasureValue(medial), MeasureValue(lateral))
    if shape.unscanned(section, upright=True, below_mm=below_mm):
        values = (MeasureValue(None, UNSCANNED),) * 3
    return dict(zip(SIZES, (*values, height), strict=True))
