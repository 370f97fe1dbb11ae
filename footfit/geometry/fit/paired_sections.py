"""Sections of a docked foot and its last by the same planes, at named stations, and their sizes.

Both are canonical right shapes in mm. The stations are places along the foot, counted from its
heel; the ball's plane is the upright one through the foot's own MT1 and MT5.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outlines import Outline
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class Station:
    """A named place along the foot, over its length; ``oblique`` through MT1 and MT5 instead."""

    name: str
    share: float
    oblique: bool = False


STATIONS = (
    Station("heel", 1.0 / 6.0),
    Station("arch", 0.38),
    Station("instep", 0.50),
    Station("waist", 0.58),
    Station("ball", 0.68, oblique=True),
    Station("toes", 0.88),
)


@dataclass(frozen=True, slots=True)
class OverlaySettings:
    """``band`` over a section's lowest point, over the foot's length, is where widths are taken:
    over it ankles stand out.
    """

    band: float = 0.15


OVERLAY = OverlaySettings()
CUT = "at the {place} the section runs out of the {who}'s top, or is open"


@dataclass(frozen=True, slots=True)
class SectionSizes:
    """What is measured of one section; ``medial`` and ``lateral`` are the edges' places across."""

    width: MeasureValue
    medial: MeasureValue
    lateral: MeasureValue
    height: MeasureValue
    girth: MeasureValue


@dataclass(frozen=True, slots=True)
class SectionPair:
    """Foot and last cut by one plane: their outlines as (across, up), + across is medial."""

    station: Station
    x_mm: float
    foot: Outline
    last: Outline
    foot_sizes: SectionSizes
    last_sizes: SectionSizes


def section_pairs(
    foot: Shape, last: Shape, settings: OverlaySettings = OVERLAY
) -> tuple[SectionPair, ...]:
    """The sections of a docked foot and its last at every station."""
    return tuple(_pair(foot, last, station, settings) for station in STATIONS)


def _pair(foot: Shape, last: Shape, station: Station, settings: OverlaySettings) -> SectionPair:
    origin, axes = _plane(foot, station)
    cuts = [shape.cut(origin, axes) for shape in (foot, last)]
    band_mm = settings.band * foot.length_mm
    sizes = [
        _sizes(shape, cut, station, band_mm) for shape, cut in zip((foot, last), cuts, strict=True)
    ]
    return SectionPair(station, float(origin[0]), cuts[0], cuts[1], sizes[0], sizes[1])


def _plane(foot: Shape, station: Station) -> tuple[Floats, Floats]:
    """A point (3,) of a station's plane, in the middle of the foot, and its two axes (2, 3)."""
    if station.oblique and foot.ball_plane is not None:
        return foot.ball_plane
    return np.array([foot.x_mm(station.share), 0.0, 0.0]), AXES[1:]


def _sizes(shape: Shape, cut: Outline, station: Station, band_mm: float) -> SectionSizes:
    """Widths from the band over the sole; height and girth where the section is whole."""
    who, points = shape.kind, cut.points
    if not len(points):
        return SectionSizes(*[MeasureValue(None, f"the {who} does not reach so far")] * 5)
    low = points[points[:, 1] <= points[:, 1].min() + band_mm, 0]
    medial, lateral = float(low.max()), float(low.min())
    return SectionSizes(
        width=MeasureValue(medial - lateral),
        medial=MeasureValue(medial),
        lateral=MeasureValue(lateral),
        height=_whole(shape, cut, station, lambda: float(np.ptp(points[:, 1]))),
        girth=_whole(shape, cut, station, lambda: hull_girth(points)),
    )


def _whole(shape: Shape, cut: Outline, station: Station, size: Callable[[], float]) -> MeasureValue:
    """A size that only a section has that does not run out of the leg or over a last's top."""
    if shape.topped(cut):
        return MeasureValue(None, CUT.format(who=shape.kind, place=station.name))
    return MeasureValue(size())
