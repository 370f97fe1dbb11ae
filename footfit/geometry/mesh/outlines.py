"""Outlines: the segments of a plane section, joined to closed loops and smoothed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.mesh.sections import Planes, plane_sections
from footfit.geometry.mesh.welding import welded_vertices
from footfit.geometry.numeric.arrays import Floats, Ints


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
    """

    pitch: float = 0.007
    smoothing: float = 0.012
    reach: float = 4.0
    speck: float = 0.05


OUTLINES = OutlineSettings()


@dataclass(frozen=True, slots=True)
class Outline:
    """A section: ``loops`` of smoothed, evenly spaced points (k, 2), across and up.

    ``gaps`` (g, 2, 2) are the ends of the straight pieces that close open loops. ``face`` (m,) are
    the faces that the plane cuts, each over the length ``length_mm`` (m,).
    """

    loops: tuple[Floats, ...]
    gaps: Floats
    face: Ints
    length_mm: Floats

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
    normal = np.cross(axes[0], axes[1])
    level = float(origin @ normal)
    values = vertices @ normal
    a, b, c = (values > level)[faces.T]
    cut = np.flatnonzero((a != b) | (a != c))
    planes = Planes(np.array([level]), origin[None, :], normal[None, :])
    segments = plane_sections(vertices, faces[cut], values, planes)
    loops, gaps = closed_loops(segments.points)
    lengths = [_steps(loop).sum() for loop in loops]
    kept = [
        smooth_loop((loop - origin) @ axes.T, length, settings)
        for loop, long in zip(loops, lengths, strict=True)
        if long >= settings.speck * max(lengths)
    ]
    steps = np.linalg.norm(segments.points[:, 1] - segments.points[:, 0], axis=1)
    return Outline(tuple(kept), (gaps - origin) @ axes.T, cut[segments.face], steps)


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
    after = np.roll(loop, -1, axis=0)
    if loop[:, 0] @ after[:, 1] < loop[:, 1] @ after[:, 0]:
        loop = loop[::-1]
    loop = np.roll(loop, -int(np.argmax(loop[:, 0])), axis=0)
    steps = _steps(loop)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(16, round(arc[-1] / (settings.pitch * length)))
    ring = np.concatenate([loop, loop[:1]])
    at = np.arange(count) * (arc[-1] / count)
    even = np.column_stack([np.interp(at, arc, ring[:, k]) for k in (0, 1)])
    spread = min(settings.smoothing * length * count / arc[-1], count / (2 * settings.reach))
    kernel = parabola_keeping_kernel(spread, settings.reach)
    pad = len(kernel) // 2
    wrapped = np.concatenate([even[-pad:], even, even[:pad]]) if pad else even
    return np.column_stack([np.convolve(wrapped[:, k], kernel, "valid") for k in (0, 1)])


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
    half = int(reach * spread)
    at = np.arange(-half, half + 1, dtype=np.float64)
    bell = np.exp(-0.5 * np.square(at / max(spread, 1e-9)))
    zeroth, second, fourth = (float(bell @ at**power) for power in (0, 2, 4))
    if half < 2:
        return np.array([1.0])
    determinant = zeroth * fourth - second * second
    return np.asarray(bell * (fourth - second * np.square(at)) / determinant)
