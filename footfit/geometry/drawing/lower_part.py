"""The part of a surface below a height, with the faces that reach over it cut there."""

from __future__ import annotations

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints


def below(vertices: Floats, faces: Ints, height: float) -> tuple[Floats, Ints]:
    """What of a surface lies lower than a height: vertices (k, 3) and faces (j, 3).

    Unused vertices stay. A face with one low corner is cut to a smaller one, and a face with two
    to two faces.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [2, 0, 0], [0, 0, 2]])
    >>> vertices, faces = below(corners, np.array([[0, 1, 2]]), 1.0)
    >>> vertices[faces].round(9).tolist()[0]
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
    """
    low = (vertices[:, 2] < height)[faces]
    count = low.sum(axis=1)
    added, pieces = [vertices], [faces[count == 3]]
    size = len(vertices)
    for lows in (1, 2):
        cut, of = faces[count == lows], low[count == lows]
        lone = np.argmax(of if lows == 1 else ~of, axis=1)
        a, b, c = (cut[np.arange(len(cut)), (lone + turn) % 3] for turn in (0, 1, 2))
        added += [_crossings(vertices, a, b, height), _crossings(vertices, a, c, height)]
        ab, ac = size + np.arange(len(cut)), size + len(cut) + np.arange(len(cut))
        size += 2 * len(cut)
        corners = [(a, ab, ac)] if lows == 1 else [(ab, b, c), (ab, c, ac)]
        pieces += [np.column_stack(each) for each in corners]
    return np.concatenate(added), np.concatenate(pieces)


def _crossings(vertices: Floats, start: Ints, end: Ints, height: float) -> Floats:
    """Where edges (n,) cross the height, (n, 3)."""
    share = (height - vertices[start, 2]) / (vertices[end, 2] - vertices[start, 2])
    return np.asarray(vertices[start] + share[:, None] * (vertices[end] - vertices[start]))
