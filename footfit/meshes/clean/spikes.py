"""Spikes: single vertices that a scanner threw far off the surface around them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Floats, Ints, distinct


@dataclass(frozen=True, slots=True)
class SpikeSettings:
    """When a vertex stands out too far to be surface.

    Attributes
    ----------
    height : float
        A spike is at least this high over the middle of its neighbours, of the diagonal.
    slenderness : float
        And this many times the largest distance of a neighbour from that middle.
    """

    height: float = 0.02
    slenderness: float = 3.0


SPIKES = SpikeSettings()


def pressed_spikes(vertices: Floats, faces: Ints) -> tuple[Floats, int]:
    """The vertices with each spike's tip moved to the middle of its neighbours, and how many.

    The faces stay as they are, so that a closed surface stays closed. Two kinds of tips stay: tips
    that are neighbours of each other, and tips on a rim, because a sheet may end in a slender
    corner.

    Parameters
    ----------
    vertices : (n, 3) float64
        In any unit.
    faces : (m, 3) int64
        Welded.

    Examples
    --------
    One point of a sheet of 20 by 20 points stands 9 high:

    >>> x, y = np.meshgrid(np.arange(20.0), np.arange(20.0))
    >>> sheet = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    >>> corner = (np.arange(19)[:, None] * 20 + np.arange(19)).ravel()
    >>> faces = np.concatenate([corner[:, None] + [0, 1, 21], corner[:, None] + [0, 21, 20]])
    >>> sheet[210, 2] = 9.0
    >>> flat, count = pressed_spikes(sheet, faces)
    >>> count, float(flat[210, 2])
    (1, 0.0)
    """
    if not len(faces):
        return vertices, 0
    columns = [np.ascontiguousarray(column)[faces.T] for column in vertices.T]
    reach = [float(np.ptp(column)) for column in columns]
    least = SPIKES.height * float(np.linalg.norm(reach))
    tips = _with_long_edges_only(columns, faces, len(vertices), least)
    if not tips.any():
        return vertices, 0
    pairs = np.concatenate([faces[:, [i, j]] for i in range(3) for j in range(3) if i != j])
    ends = pairs[tips[pairs[:, 0]]]
    tip, neighbour = np.divmod(distinct(ends[:, 0] * len(vertices) + ends[:, 1]), len(vertices))
    count = np.bincount(tip, minlength=len(vertices))
    inner = (count >= 3) & (count == np.bincount(faces.ravel(), minlength=len(vertices)))
    sums = [np.bincount(tip, vertices[neighbour, i], len(vertices)) for i in range(3)]
    middles = np.stack(sums, axis=1) / np.maximum(count, 1)[:, None]
    away = np.linalg.norm(vertices[neighbour] - middles[tip], axis=1)
    spread = np.zeros(len(vertices))
    np.maximum.at(spread, tip, away)
    height = np.linalg.norm(vertices - middles, axis=1)
    spike = tips & inner & (height > least) & (height > SPIKES.slenderness * spread)
    return np.where(spike[:, None], middles, vertices), int(spike.sum())


def _with_long_edges_only(
    columns: Sequence[Floats], faces: Ints, n_vertices: int, least: float
) -> Bools:
    """The vertices (n,) all of whose edges are longer than ``least``.

    ``columns`` are the corners' coordinates, (3, m) each: NumPy is slow along an axis of three.
    """
    tips = np.zeros(n_vertices, dtype=bool)
    ahead = [1, 2, 0]
    x, y, z = (np.square(column[ahead] - column) for column in columns)
    short = x + y + z <= least**2
    if short.all():  # a fine mesh, as most are
        return tips
    tips[faces] = True
    tips[faces.T[short]] = False
    tips[faces.T[ahead][short]] = False
    return tips
