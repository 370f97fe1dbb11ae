"""The sections of one shape that are kept of it, so that later questions read no mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.errors import HalfScan
from footfit.geometry.fit.stations import STATIONS, NamedSection
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.mesh.sections import extremes_below, lowest, sections_across
from footfit.geometry.numeric.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class NamedSectionSettings:
    """What is kept; lengths over the length of the shape, or of its bottom laid flat.

    Attributes
    ----------
    points : int
        Of each section, evenly along its outline: off the outline by 0.1 mm at most.
    toe_height : float
        The toes' outline is the widest of what lies lower than this over the bottom: a toe box is
        as high.
    held_up : float
        If the underside of the toes lies higher than this, they are held up, and so is that height.
    toes_from, toes_to, toe_stations
        Where along the flat bottom its edges are kept.
    """

    points: int = 120
    toe_height: float = 0.08
    held_up: float = 0.02
    toes_from: float = 0.60
    toes_to: float = 0.998
    toe_stations: int = 80


NAMED_SECTIONS = NamedSectionSettings()


def named_sections(
    shape: Shape, settings: NamedSectionSettings = NAMED_SECTIONS
) -> dict[str, NamedSection]:
    """The sections at the named stations: where :func:`section_pairs` cuts, on the shape itself.

    A station where the section is open is left out. A section that runs over the top cut of a last
    or a leg is kept with it.
    """
    from footfit.geometry.fit.paired_sections import station_plane

    kept = {}
    for station in STATIONS:
        origin, axes = station_plane(shape, station)
        section = shape.cut(origin, axes)
        if shape.opened(section):
            continue
        plane = np.eye(4)
        plane[:3, :3] = np.column_stack([*axes, np.cross(*axes)])
        plane[:3, 3] = origin
        longest = max(section.loops, key=len)
        kept[station.name] = NamedSection(plane, _evenly(longest, settings.points))
    return kept


def toes_outline_mm(shape: Shape, settings: NamedSectionSettings = NAMED_SECTIONS) -> Floats | None:
    """The outline of the toes at toe height; of a last on its bottom laid flat as for the flare.

    Returns
    -------
    (n, 3) or None
        Along the flat bottom from its rearmost point, and the lateral and the medial edge there,
        in mm. None if the bottom is not shown.
    """
    try:
        vertices, faces, length_mm = _flat(shape)
    except HalfScan:
        return None
    x = np.linspace(settings.toes_from, settings.toes_to, settings.toe_stations)
    segments = sections_across(vertices, faces, x)
    across, height = segments.points[:, :, 1], segments.points[:, :, 2]
    held_up = np.fmax(lowest(height, segments) - settings.held_up, 0.0)
    lateral, medial = extremes_below(across, height, settings.toe_height + held_up, segments)
    known = np.isfinite(lateral) & np.isfinite(medial)
    if not known.any():
        return None
    return np.asarray(np.column_stack([x, lateral, medial])[known] * length_mm)


def _flat(shape: Shape) -> tuple[Floats, Ints, float]:
    """Vertices over the length, with the bottom flat, the faces that matter, and the length in mm.

    A foot lies flat in its canonical frame, so its low faces are taken as they are: to level it as
    for the flare moves an edge by 0.2 mm and takes five times as long.
    """
    if shape.kind == "last":
        bottom = shape.flat_bottom.shape
        return bottom.vertices, bottom.faces, bottom.length_mm
    length_mm = shape.length_mm
    vertices = (shape.vertices_mm - np.array([shape.x_mm(0.0), 0.0, 0.0])) / length_mm
    front = (vertices[:, 0] > NAMED_SECTIONS.toes_from)[shape.low].any(axis=1)
    return vertices, shape.low[front], length_mm


def _evenly(loop: Floats, count: int) -> Floats:
    """A closed loop (k, 2) as ``count`` points at equal steps."""
    closed = np.concatenate([loop, loop[:1]])
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    at = np.linspace(0.0, arc[-1], count, endpoint=False)
    return np.column_stack([np.interp(at, arc, closed[:, axis]) for axis in (0, 1)])
