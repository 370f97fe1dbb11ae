"""The part of a shape that its bottom is read from: over the length, level, low faces only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfit.errors import HalfScan
from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.mesh.sections import Segments, lowest, sections_across, soles
from footfit.geometry.mesh.surface import area_vectors
from footfit.geometry.mesh.welding import without_unused_vertices
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.numeric.quantiles import median

# Faces that these leave out change no value, as a test checks; the rest is in the definition.
_NEIGHBOURHOOD = 0.10  # a normal section reaches less than this forward and backward along x
_LIFT = 0.02  # the lowest of a normal section lies higher than its neighbours across X by less


@dataclass(frozen=True, slots=True)
class BottomShape:
    """The faces that a band may touch, over the length, with the rearmost point at x = 0.

    ``tips`` (t, 3, 3) are the triangles where the line may leave the shape, without the leg.
    ``origin_mm`` and ``length_mm`` lead back to millimetres.
    """

    vertices: Floats
    faces: Ints
    tips: Floats
    origin_mm: float
    length_mm: float


def low_length(vertices: Floats, height: float, rounds: int = 3) -> tuple[float, float]:
    """The rearmost x and the extent along x of the points lower than ``height`` times that extent.

    Examples
    --------
    >>> low_length(np.array([[0.0, 0, 0], [10, 0, 0], [-3, 0, 9]]), 0.3)
    (0.0, 10.0)
    """
    start, length = float(vertices[:, 0].min()), float(np.ptp(vertices[:, 0]))
    for _ in range(rounds):
        low = vertices[vertices[:, 2] < height * length, 0]
        if len(low) == 0:
            break
        start, length = float(low.min()), float(np.ptp(low))
    return start, length


def bottom_shape(vertices_mm: Floats, faces: Ints, definition: FlareDefinition) -> BottomShape:
    """A canonical right mesh over its length, with only the faces that a band may touch.

    Raises
    ------
    HalfScan
        The mesh has no length.
    """
    origin, length = low_length(vertices_mm, definition.length_height, definition.length_rounds)
    if length <= 0.0:
        raise HalfScan("the scan has no length along its own axis: scan the whole foot again")
    vertices = (vertices_mm - np.array([origin, 0.0, 0.0])) / length
    x = section_places(definition)
    across = sections_across(vertices, faces, x)
    windows = [(x >= low) & (x <= high) for low, high in (definition.seat, definition.tread)]
    cut = (windows[0] | windows[1])[across.plane]
    stands = Segments(across.planes, across.plane[cut], across.face[cut], across.points[cut])
    down = area_vectors(vertices, faces[stands.face])
    level = _levelling(down, stands, windows, definition)
    vertices, across = vertices @ level, _rolled(across, level)
    ceiling = _highest_near(lowest(across.points[:, :, 2], across), x) + definition.band_height
    low = vertices[:, 2] <= np.interp(vertices[:, 0], x, ceiling) + _LIFT
    a, b, c = faces.T
    keep = low[a] | low[b] | low[c]
    for start, end in ((a, b), (b, c), (c, a)):
        keep |= np.abs(vertices[end, 0] - vertices[start, 0]) > _NEIGHBOURHOOD
    tip = np.abs(vertices[:, 0] - 0.5) > 0.5 - _NEIGHBOURHOOD
    tip &= vertices[:, 2] < definition.length_height
    tips = vertices[faces[tip[faces].any(axis=1)]]
    vertices, faces, _ = without_unused_vertices(vertices, faces[keep])
    return BottomShape(vertices, faces, tips, origin, length)


def _levelling(
    down: Floats, across: Segments, windows: Sequence[Bools], definition: FlareDefinition
) -> Floats:
    """The rotation about X, (3, 3) to multiply rows with, that levels seat and tread across.

    The plane of a whole sole rolls with the arch, by a degree or two on a heeled last. But where a
    shape stands, under the seat and the tread, it is level. A roll moves the places at which the
    slopes are read, so the roll is found by secant steps. Sections across X roll without a new cut.
    ``down`` (m, 3) are the area vectors of the segments' faces; ``windows`` say which sections
    (planes,) are under the seat and which under the tread.
    """
    roll, before = 0.0, None
    for _ in range(definition.level_rounds):
        rotation = _rolling(roll)
        slope = _stance(down @ rotation, _rolled(across, rotation), windows, definition)
        if slope is None:
            return np.eye(3)  # no sole to stand on: the frame's own level
        rest = float(np.arctan(slope))
        if abs(rest) < definition.level_settled:
            break
        gain = 1.0 if before is None else (before[1] - rest) / (roll - before[0])
        before = (roll, rest)
        roll += rest / float(np.clip(gain, *definition.level_gain))
    return _rolling(roll)


def _rolling(roll: float) -> Floats:
    """The rotation (3, 3) that takes a rise of ``roll`` towards medial out of rows."""
    cosine, sine = np.cos(roll), np.sin(roll)
    return np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])


def _rolled(segments: Segments, rotation: Floats) -> Segments:
    return replace(segments, points=segments.points @ rotation)


def _stance(
    down: Floats, across: Segments, windows: Sequence[Bools], definition: FlareDefinition
) -> float | None:
    """The mean slope across of seat and tread, or None if one of them has no bottom."""
    slope = _cross_slopes(down[:, 2] < 0.0, across, definition)
    medians = []
    for window in windows:
        known = slope[window & np.isfinite(slope)]
        if len(known) == 0 or len(known) < definition.found_least * window.sum():
            return None
        medians.append(median(known))
    return float(np.mean(medians))


def _cross_slopes(down: Bools, across: Segments, definition: FlareDefinition) -> Floats:
    """The slope of each section's bottom from the lateral to the medial side, (planes,)."""
    first, _, last = definition.bottom_places  # from the medial edge
    sole = soles(across, definition.band_height, (1.0 - first, 1.0 - last), down)
    medial, lateral = sole.depth
    return np.asarray((medial - lateral) / ((last - first) * (sole.medial - sole.lateral)))


def section_places(definition: FlareDefinition) -> Floats:
    """Where along x the sections are, (sections,)."""
    return np.linspace(definition.sections_from, definition.sections_to, definition.sections)


def _highest_near(floor: Floats, x: Floats) -> Floats:
    """The highest floor of the sections within reach of each: no face of a band is left out."""
    reach = int(np.ceil(_NEIGHBOURHOOD / (x[1] - x[0])))
    known = np.where(np.isfinite(floor), floor, -np.inf)
    padded = np.pad(known, reach, constant_values=-np.inf)
    highest = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1)
    return np.where(np.isfinite(highest), highest, 1.0)
