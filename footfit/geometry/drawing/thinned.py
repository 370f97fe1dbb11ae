"""A polyline with as few corners as a chord error allows (Douglas and Peucker 1973)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from footfit.geometry.numeric.arrays import Floats

CHORD_MM = 0.02
"""How far a thinned outline may be from the outline itself: drawings may be off by .05 mm."""


def thinned_loop(loop: Floats, chord_mm: float = CHORD_MM) -> Floats:
    """Some corners (k, 2) of a closed polyline (n, 2); all others lie within ``chord_mm`` of it.

    The outermost corners to the four sides stay, so it is as wide and as high as before.

    Examples
    --------
    >>> square = np.array([[0.0, 0], [1, 0], [2, 0], [2, 2], [1, 2], [0, 2], [0, 1]])
    >>> thinned_loop(square).tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
    """
    ring = np.concatenate([loop, loop[:1]])
    ends = np.concatenate([np.argmin(loop, axis=0), np.argmax(loop, axis=0)]).tolist()
    kept = {0, *ends}
    pending = list(pairwise([*sorted(kept), len(loop)]))
    while pending:
        start, end = pending.pop()
        if end - start < 2:
            continue
        off = _distances(ring[start + 1 : end], ring[start], ring[end])
        farthest = int(np.argmax(off))
        if off[farthest] > chord_mm:
            middle = start + 1 + farthest
            kept.add(middle)
            pending += [(start, middle), (middle, end)]
    return np.asarray(loop[sorted(kept)])


def _distances(points: Floats, start: Floats, end: Floats) -> Floats:
    """How far points (n, 2) are from the straight piece between two others, (n,)."""
    along = end - start
    square = float(along @ along)
    share = np.clip((points - start) @ along / square, 0.0, 1.0) if square > 0.0 else 0.0
    return np.asarray(np.linalg.norm(points - start - np.multiply.outer(share, along), axis=-1))
