"""Sections of a last at stations along its bottom, upright as the last stands, and their sizes.

A station is a share of the arc of the bottom, so a higher heel does not move it. The plane holds
the direction across (Y) and the direction that is up when the tread lies level. A foot, or a last
whose bottom is open, has its stations along its length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.fit.paired_sections import SECTIONS
from footfit.geometry.fit.stations import STATIONS, Station
from footfit.geometry.measures.landmarks import AXES, Shape
from footfit.geometry.measures.measure_value import MeasureValue
from footfit.geometry.measures.tape import hull_girth
from footfit.geometry.mesh.outlines import TAPE_OUTLINES, Outline
from footfit.geometry.mesh.surface import cross
from footfit.geometry.numeric.arrays import Floats

ARC_SIZES = ("width", "height", "girth")
"""What is measured of a section, in mm."""
SAME_PLACE = 0.002
"""Half a millimetre along the bottom: there a named station stands for another one."""


@dataclass(frozen=True, slots=True)
class ArcSection:
    """One section of a right shape.

    Attributes
    ----------
    station : Station
        Its ``name`` is empty for a place without a name.
    share : float
        Where it is along the bottom's arc, 0 heel and 1 toe.
    origin, axes : (3,), (2, 3)
        A point of the plane at the height of the bottom, and unit vectors in it: across and up.
    outline : Outline
        In the plane's axes, + across is medial.
    sizes : dict of str to MeasureValue
        ``width`` is taken up to .15 of the length over the lowest point, because a cone stands out
        above. ``height`` is that of the whole section, up to a last's top. ``girth``, the perimeter
        of the convex hull, is that of a section that does not run over the top.
    """

    station: Station
    share: float
    origin: Floats
    axes: Floats
    outline: Outline
    sizes: dict[str, MeasureValue]


def named_arc_sections(shape: Shape) -> tuple[ArcSection, ...]:
    """The sections at the named stations, from heel to toe."""
    return tuple(arc_section(shape, station) for station in STATIONS)


def arc_sections(shape: Shape, count: int) -> tuple[ArcSection, ...]:
    """``count`` sections in equal steps between the ends of the bottom, and the named ones."""
    even = [Station("", (index + 1) / (count + 1)) for index in range(count)]
    named = named_arc_sections(shape)
    taken = np.array([section.share for section in named])
    free = (station for station in even if np.abs(taken - station.share).min() > SAME_PLACE)
    made = (*named, *(arc_section(shape, station) for station in free))
    return tuple(sorted(made, key=lambda section: section.share))


def arc_section(shape: Shape, station: Station) -> ArcSection:
    """The section at one station; the ball's plane goes through both joints."""
    origin, axes, share = _plane(shape, station)
    outline = shape.cut(origin, axes, TAPE_OUTLINES)
    return ArcSection(station, share, origin, axes, outline, _sizes(shape, outline, station))


def _plane(shape: Shape, station: Station) -> tuple[Floats, Floats, float]:
    """A point of the plane, its axes, and where it is along the arc."""
    up = shape.upright
    if station.oblique and shape.joints is not None:
        outer, inner = shape.joints
        way = (inner - outer) - ((inner - outer) @ up) * up
        middle = 0.5 * (outer + inner)
        share = shape.share_of(middle)
        origin = middle + ((_under(shape, share) - middle) @ up) * up
        return origin, np.stack([way / np.linalg.norm(way), up]), share
    return _under(shape, station.share), np.stack([AXES[1], up]), station.share


def _under(shape: Shape, share: float) -> Floats:
    """The place (3,) on the middle of the bottom at a share of its arc."""
    arc = shape.bottom_arc
    if arc is None:
        return np.array([shape.x_mm(share), 0.0, 0.0])
    x, z = arc.line.at(np.array([share * arc.length_mm]))
    standing = np.array([x[0], 0.0, z[0]]) - arc.stands[:3, 3]
    return np.asarray(standing @ arc.stands[:3, :3])


def _sizes(shape: Shape, outline: Outline, station: Station) -> dict[str, MeasureValue]:
    points = outline.points
    if not len(points):
        missing = MeasureValue(None, f"the {shape.kind} has no surface there")
        return dict.fromkeys(ARC_SIZES, missing)
    band_mm = SECTIONS.band * shape.length_mm
    low = points[points[:, 1] <= points[:, 1].min() + band_mm, 0]
    width, height = float(np.ptp(low)), float(np.ptp(points[:, 1]))
    values = [MeasureValue(width), MeasureValue(height), MeasureValue(hull_girth(points))]
    place = station.name or f"station {station.share:.2f}"
    if shape.opened(outline):
        values[1:] = [MeasureValue(None, f"at the {place} the section is open")] * 2
    elif shape.topped(outline):
        values[2] = MeasureValue(None, f"at the {place} the section runs over the top")
    return dict(zip(ARC_SIZES, values, strict=True))


def places_in_space(section: ArcSection, loop: Floats) -> Floats:
    """The points (k, 3) of a loop (k, 2) of the section, in the frame of the shape."""
    return np.asarray(section.origin + loop @ section.axes)


def plane_normal(axes: Floats) -> Floats:
    """The unit normal (3,) of a plane, towards the toe.

    Examples
    --------
    >>> plane_normal(np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])).tolist()
    [1.0, 0.0, 0.0]
    """
    return cross(*axes)
