"""Greedy covers: which lasts serve most feet together, and which of them could go.

Sets of feet are rows of bits, eight feet a byte, as `judging.Judged.served` has them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from footfit.geometry.numeric.arrays import Bools, Bytes, Ints

BITS = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1).sum(axis=1, dtype=np.uint8)
"""How many bits a byte has."""
GREEDY_SHARE = 1.0 - 1.0 / np.e
"""A greedy cover serves at least this share of what the best one of as many sets serves
[nemhauser1978]."""


@dataclass(frozen=True, slots=True)
class Cover:
    """The rows that a greedy cover takes, in order, and how many feet each of them adds.

    ``most`` (k,) is how many feet no choice of as many rows could serve more than.
    """

    rows: Ints
    gains: Ints
    most: Ints


def counts(bits: Bytes) -> Ints:
    """How many feet each row (n, b) has."""
    return np.asarray(BITS[bits].sum(axis=-1, dtype=np.int64))


def greedy_cover(bits: Bytes, wanted: Bytes, most: int | None = None) -> Cover:
    """The rows of ``bits`` (n, b) that serve most of the ``wanted`` feet (b,), one after another.

    Among equal gains the first row is taken. A row without a gain is not taken.

    Examples
    --------
    >>> sets = np.packbits([[1, 1, 0, 0], [0, 1, 1, 1], [0, 0, 0, 1]], axis=1)
    >>> cover = greedy_cover(sets, np.packbits([1, 1, 1, 1]))
    >>> cover.rows.tolist(), cover.gains.tolist(), cover.most.tolist()
    ([1, 0], [3, 1], [3, 4])
    """
    left = wanted.copy()
    reach = int(counts(wanted & np.bitwise_or.reduce(bits, axis=0, initial=0)))
    rows: list[int] = []
    gains: list[int] = []
    tops: list[Ints] = []
    while most is None or len(rows) < most:
        gain = counts(bits & left) if len(bits) else np.zeros(1, dtype=np.int64)
        best = int(gain.argmax())
        if not gain[best]:
            break
        tops.append(np.cumsum(np.sort(gain)[::-1]))
        rows.append(best)
        gains.append(int(gain[best]))
        left &= ~bits[best]
    bounds = np.minimum(_bounds(gains, tops), reach)
    bounds = np.minimum.accumulate(bounds[::-1])[::-1]  # fewer rows serve no more than more rows
    return Cover(np.array(rows, dtype=np.int64), np.array(gains, dtype=np.int64), bounds)


def _bounds(gains: list[int], tops: list[Ints]) -> Ints:
    """How many feet no k rows can serve more than, for each k.

    The best k rows serve at most what a cover serves and the k largest gains beyond it.
    """
    served = np.concatenate([[0], np.cumsum(gains)])[:-1]
    return np.array(
        [
            min(int(served[i] + tops[i][min(k, len(tops[i])) - 1]) for i in range(k))
            for k in range(1, len(gains) + 1)
        ],
        dtype=np.int64,
    )


def served_once(bits: Bytes, feet: int) -> Bools:
    """Which feet (feet,) exactly one row (n, b) serves."""
    once = np.zeros(bits.shape[1], dtype=np.uint8)
    more = np.zeros_like(once)
    for row in bits:
        more |= once & row
        once |= row
    return np.unpackbits(once & ~more)[:feet].astype(bool)


def served_by_any(bits: Bytes, feet: int) -> Bools:
    """Which feet (feet,) any row (n, b) serves."""
    return np.unpackbits(np.bitwise_or.reduce(bits, axis=0))[:feet].astype(bool)


def spare_rows(bits: Bytes) -> Bools:
    """Which rows (n,) could all go while every foot that is served stays served.

    The rows that serve least go first; among equal ones the last.
    """
    servers = np.zeros(bits.shape[1] * 8, dtype=np.int64)
    for row in bits:
        servers += np.unpackbits(row)
    spare = np.zeros(len(bits), dtype=bool)
    served = counts(bits) if len(bits) else np.zeros(0, dtype=np.int64)
    for place in np.lexsort((-np.arange(len(bits)), served)):
        own = np.flatnonzero(np.unpackbits(bits[place]))
        if (servers[own] > 1).all():
            spare[place] = True
            servers[own] -= 1
    return spare
