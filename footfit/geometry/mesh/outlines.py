"""Outlines: the segments of a plane section, joined to closed loops and smoothed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfit.geometry.mesh.sections import Planes, plane_sections
from footfit.geometry.mesh.surface import cross
from footfit.geometry.mesh.welding import welded_vertices
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.quantiles import median


@dataclass(frozen=True, slots=True)
class OutlineSettings:
    """All numbers of an outline; lengths over the shape's length.

    Attributes
    ----------
    pitch : float
        The distance between the points of a smooth loop, about.
    smoothing, reach : float
        The kernel's standard deviation, and how many of them it reaches.
    speck : float
        A loop shorter than this share of the longest loop is dropped.
    corners : bool
        Whether the shape's corners are kept, as by :func:`steady_loop`.
    noise_times : float
        What smoothing takes away is noise up to so many times the loop's own noise.
    facets : float
        What smoothing takes away below this is no noise: it is the facets of a clean mesh.
    """

    pitch: float = 0.007
    smoothing: float = 0.012
    reach: float = 4.0
    speck: float = 0.05
    corners: bool = False
    noise_times: float = 4.0
    facets: float = 0.0001


OUTLINES = OutlineSettings()
TAPE_OUTLINES = OutlineSettings(pitch=0.004, corners=True)
"""How a tape lies: over a last's feather edge, which the other outlines round off."""


@dataclass(frozen=True, slots=True)
class Outline:
    """A section: ``loops`` of smoothed, evenly spaced points (k, 2), across and up.

    ``gaps`` (g, 2, 2) are the ends of the straight pieces that close open loops. ``face`` (m,) are
    the faces that the plane cuts, each along a segment (m, 2, 2) of the length ``length_mm`` (m,).
    Of a last with a cut across its cone the loops have what is missing there; ``bridged_mm`` is how
    far that is from what is left, the geometric mean of the ways to both rims.
    """

    loops: tuple[Floats, ...]
    gaps: Floats
    face: Ints
    length_mm: Floats
    segments: Floats
    bridged_mm: float = 0.0

    def gap_mm(self, below_mm: float = np.inf) -> float:
        """The longest straight piece with an end below a height; 0 where there is none."""
        low = self.gaps[self.gaps[:, :, 1].min(axis=1) < below_mm]
        return float(np.linalg.norm(low[:, 1] - low[:, 0], axis=1).max(initial=0.0))

    @property
    def points(self) -> Floats:
        """The points of all loops, (k, 2)."""
        return np.concatenate(self.loops) if self.loops else np.empty((0, 2))


def outline(
    vertices: Floats,
    faces: Ints,
    origin: Floats,
    axes: Floats,
    length: float,
    settings: OutlineSettings = OUTLINES,
) -> Outline:
    """The section of a mesh by a plane, as smooth loops.

    Each loop is cut into even steps and smoothed by a kernel that leaves a parabola as it is. This
    halves 0.3 mm of noise and does not shrink the curve.

    Parameters
    ----------
    vertices : (n, 3)
    faces : (m, 3)
    origin : (3,)
        A point of the plane.
    axes : (2, 3)
        Unit vectors in the plane: across and up.
    length : float
        The shape's length, which the settings are multiplied by.
    """
    normal = cross(*axes)
    level = float(origin @ normal)
    values = vertices @ normal
    a, b, c = (values > level)[faces.T]
    cut = np.flatnonzero((a != b) | (a != c))
    planes = Planes(np.array([level]), origin[None, :], normal[None, :])
    segments = plane_sections(vertices, faces[cut], values, planes)
    loops, gaps = closed_loops(segments.points)
    lengths = [_steps(loop).sum() for loop in loops]
    steadied = steady_loop if settings.corners else smooth_loop
    kept = [
        steadied((loop - origin) @ axes.T, length, settings)
        for loop, long in zip(loops, lengths, strict=True)
        if long >= settings.speck * max(lengths)
    ]
    steps = np.linalg.norm(segments.points[:, 1] - segments.points[:, 0], axis=1)
    flat = (segments.points - origin) @ axes.T
    return Outline(tuple(kept), (gaps - origin) @ axes.T, cut[segments.face], steps, flat)


def closed_loops(points: Floats) -> tuple[list[Floats], Floats]:
    """The loops of segments (m, 2, 3), joined where their ends are equal.

    All open pieces together become the last loop.

    Returns
    -------
    loops : list of (k, 3)
        Each closed: its last point is followed by its first.
    gaps : (g, 2, 3)
        The ends of the straight pieces that close the last loop.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> open_square = np.stack([corners[:3], corners[1:]], axis=1)
    >>> loops, gaps = closed_loops(open_square)
    >>> len(loops), len(loops[0]), gaps.tolist()
    (1, 4, [[[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]])
    """
    if len(points) == 0:
        return [], np.empty((0, 2, 3))
    ends = np.arange(2 * len(points)).reshape(-1, 2)
    place, node, _ = welded_vertices(points.reshape(-1, 3), ends)
    chains = _chains(node[node[:, 0] != node[:, 1]])
    closed = [place[chain[:-1]] for chain in chains if chain[0] == chain[-1]]
    pieces = [place[chain] for chain in chains if chain[0] != chain[-1]]
    if not pieces:
        return closed, np.empty((0, 2, 3))
    joined, gaps = _joined(pieces)
    return [*closed, joined], gaps


def _chains(node: Ints) -> list[list[int]]:
    """Walks (node rows) over segments (m, 2), each segment once; first those from open ends."""
    ends = node.ravel()
    partner = _partners(ends)
    row, onward = ends.tolist(), partner.tolist()
    walked = [False] * len(row)
    chains = []
    for start in (*np.flatnonzero(partner < 0).tolist(), *range(0, len(row), 2)):
        here = start
        if walked[here]:
            continue
        chain = [row[here]]
        while here >= 0 and not walked[here]:
            walked[here] = walked[here ^ 1] = True
            chain.append(row[here ^ 1])
            here = onward[here ^ 1]
        chains.append(chain)
    return chains


def _partners(ends: Ints) -> Ints:
    """For each end (k,) of a segment, an end of another segment in the same node; -1 without one.

    The ends 2 i and 2 i + 1 belong to the same segment. Where more than two ends meet, as on an
    edge of four faces, they are paired in order.
    """
    order = np.argsort(ends, kind="stable")
    ordered = ends[order]
    begins = np.flatnonzero(np.diff(ordered, prepend=-1))
    rank = np.arange(len(ends)) - np.repeat(begins, np.diff(begins, append=len(ends)))
    even = np.flatnonzero(rank % 2 == 0)
    has_next = (even + 1 < len(ends)) & (
        ordered[np.minimum(even + 1, len(ends) - 1)] == ordered[even]
    )
    first, second = order[even[has_next]], order[even[has_next] + 1]
    partner = np.full(len(ends), -1, dtype=np.int64)
    partner[first], partner[second] = second, first
    return partner


def _joined(pieces: list[Floats]) -> tuple[Floats, Floats]:
    """A loop of all open pieces, joined at their nearest ends, and the ends of its joints."""
    loop, rest, gaps = pieces[0], pieces[1:], []
    while rest:
        reached = [
            (float(np.linalg.norm(piece[side] - loop[-1])), index, side)
            for index, piece in enumerate(rest)
            for side in (0, -1)
        ]
        _, index, side = min(reached)
        piece = rest.pop(index)
        gaps.append((loop[-1], piece[side]))
        loop = np.concatenate([loop, piece if side == 0 else piece[::-1]])
    return loop, np.array([*gaps, (loop[-1], loop[0])])


def _steps(loop: Floats) -> Floats:
    return np.asarray(np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1))


def smooth_loop(loop: Floats, length: float, settings: OutlineSettings = OUTLINES) -> Floats:
    """A closed polyline (n, 2) as evenly spaced points (k, 2), smoothed along its arc.

    It runs counter-clockwise from the point farthest across, for any order of the mesh's faces.
    """
    even = even_loop(ordered_loop(loop), length, settings)
    return convolved(even.points, parabola_keeping_kernel(even.spread, settings.reach))


def steady_loop(loop: Floats, length: float, settings: OutlineSettings = TAPE_OUTLINES) -> Floats:
    """A closed polyline (n, 2) with the same number of points, smoothed except at its corners.

    Smoothing rounds a corner off by some tenths of a millimetre, and a tape would read that much
    less. What smoothing takes away at a place is kept if its mean square there is several times
    that of the whole loop's noise: then it is shape. So a clean section stays as it is.
    """
    loop = ordered_loop(loop)
    even = even_loop(loop, length, settings)
    smooth = convolved(even.points, parabola_keeping_kernel(even.spread, settings.reach))
    off = even.points - smooth
    square = np.square(off).sum(axis=1)
    around = convolved(square[:, None], bell(even.spread, settings.reach))[:, 0]
    noise = median(square) / MEDIAN_SQUARE - (settings.facets * length) ** 2
    is_noise = np.minimum(1.0, settings.noise_times * max(0.0, noise) / np.maximum(around, 1e-12))
    off *= is_noise[:, None]
    moved = [np.interp(even.arc, even.at, column, period=even.length) for column in off.T]
    return np.asarray(loop - np.column_stack(moved), dtype=np.float64)


MEDIAN_SQUARE = np.log(2.0)
"""The median of a squared length over its mean, if both its parts are noise: that of chi-square."""


def ordered_loop(loop: Floats) -> Floats:
    """A closed polyline (n, 2), counter-clockwise from the point farthest across."""
    after = np.roll(loop, -1, axis=0)
    if loop[:, 0] @ after[:, 1] < loop[:, 1] @ after[:, 0]:
        loop = loop[::-1]
    return np.roll(loop, -int(np.argmax(loop[:, 0])), axis=0)


class EvenLoop(NamedTuple):
    """A closed polyline in even steps: ``points`` (k, 2) at ``at`` (k,) along its arc.

    ``arc`` (n,) is where the polyline's own points lie, and ``length`` that of the whole arc.
    ``spread`` is the smoothing's standard deviation in steps.
    """

    points: Floats
    at: Floats
    arc: Floats
    length: float
    spread: float


def even_loop(loop: Floats, length: float, settings: OutlineSettings) -> EvenLoop:
    """A closed polyline (n, 2) in even steps; ``length`` is the shape's."""
    arc = np.concatenate([[0.0], np.cumsum(_steps(loop))])
    around = float(arc[-1])
    count = max(16, round(around / (settings.pitch * length)))
    ring = np.concatenate([loop, loop[:1]])
    at = np.linspace(0.0, around, count, endpoint=False)
    points = np.column_stack([np.interp(at, arc, ring[:, k]) for k in (0, 1)])
    spread = min(settings.smoothing * length * count / around, count / (2 * settings.reach))
    return EvenLoop(points, at, arc[:-1], around, spread)


def convolved(points: Floats, kernel: Floats) -> Floats:
    """The rows (k, c) of a closed loop, smoothed by a kernel."""
    pad = len(kernel) // 2
    wrapped = np.concatenate([points[-pad:], points, points[:pad]]) if pad else points
    return np.column_stack([np.convolve(column, kernel, "valid") for column in wrapped.T])


def bell(spread: float, reach: float) -> Floats:
    """A kernel (k,) with sum 1: a bell of standard deviation ``spread``, in steps."""
    half = int(reach * spread)
    weight = np.exp(-0.5 * np.square(np.arange(-half, half + 1) / max(spread, 1e-9)))
    return np.asarray(weight / weight.sum())


def parabola_keeping_kernel(spread: float, reach: float) -> Floats:
    """A smoothing kernel (k,) with sum 1 and second moment 0, which leaves a parabola as it is.

    It is a bell of standard deviation ``spread``, in steps, times a parabola. It reaches ``reach``
    standard deviations.

    Examples
    --------
    >>> kernel = parabola_keeping_kernel(3.0, 4.0)
    >>> at = np.arange(len(kernel)) - len(kernel) // 2
    >>> round(float(kernel.sum()), 12), abs(round(float(kernel @ at**2), 9))
    (1.0, 0.0)
    """
    weight = bell(spread, reach)
    half = len(weight) // 2
    if half < 2:
        return np.array([1.0])
    at = np.arange(-half, half + 1, dtype=np.float64)
    second, fourth = (float(weight @ at**power) for power in (2, 4))
    return np.asarray(weight * (fourth - second * np.square(at)) / (fourth - second * second))
