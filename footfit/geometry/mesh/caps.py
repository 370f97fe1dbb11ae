"""A smooth cap for one hole: it meets the rim and continues the surface around it.

Over the unit disk, a map whose Laplacian is harmonic is fixed by its values p and its outward
derivative q on the circle, wave by wave: (a r^n + b r^(n + 2)) e^(i n t) with a + b = p and
n a + (n + 2) b = q. So a cap is two Fourier transforms; no system is solved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.mesh.surface import area_vectors, unit
from footfit.geometry.numeric.arrays import Floats, Ints, row_dots, row_lengths

Waves = NDArray[np.complex128]
_TURN = 2.0 * np.pi


@dataclass(frozen=True, slots=True)
class CapSettings:
    """Everything numeric of a cap.

    rim_samples, slope_samples, harmonics
        At how many places a rim and the surface's slope are read; how many waves a cap follows.
    band, faces_most
        How far around a rim the surface's slope is read, over the rim's extent; from how many
        faces at most.
    stretch_most
        The most that a slope is longer than in the plane of the flat cap.
    patch_cosine
        A rim with its surface further inward than this is the edge of a patch and not a hole.
    rings_most, ring_steps
        The most rings of triangles; each ring has so many more sides than the next inner one.
    """

    rim_samples: int = 256
    slope_samples: int = 32
    harmonics: int = 6
    band: float = 0.15
    faces_most: int = 20_000
    stretch_most: float = 3.0
    patch_cosine: float = -0.6
    rings_most: int = 12
    ring_steps: int = 6


CAPS = CapSettings()
_WAVE_NUMBERS = np.arange(-CAPS.harmonics, CAPS.harmonics + 1.0)
_ORDERS = np.abs(_WAVE_NUMBERS)


@dataclass(frozen=True, slots=True)
class Facets:
    """The faces' middles and area vectors, (m, 3) each."""

    middles: Floats
    vectors: Floats

    @classmethod
    def of(cls, vertices: Floats, faces: Ints) -> Facets:
        """The facets of a mesh."""
        return cls(vertices[faces].mean(axis=1), area_vectors(vertices, faces))

    def near(self, centre: Floats, reach: float, most: int) -> Facets:
        """Those within ``reach`` of a point, thinned to about ``most``."""
        away = self.middles - centre
        near = np.flatnonzero(row_dots(away, away) < reach**2)
        near = near[:: max(1, len(near) // most)]
        return Facets(self.middles[near], self.vectors[near])


def extent_of(rim: Floats) -> float:
    """Twice the distance of a rim's farthest point (k, 3) from the rim's middle."""
    return 2.0 * float(row_lengths(rim - rim.mean(axis=0)).max())


def farthest_of(rim: Floats) -> int:
    """The number of a rim's point (k, 3) that is farthest from its middle.

    A cap that starts there is the same in any order of vertices and, mirrored, in a mirror.
    """
    return int(row_lengths(rim - rim.mean(axis=0)).argmax())


def cap(rim: Floats, facets: Facets, ring: float) -> tuple[Floats, Ints] | None:
    """A cap for a rim; None if the rim is the outer edge of a patch.

    Parameters
    ----------
    rim : (k, 3)
        In the order in which the cap's triangles run it, against the surface's; from the
        farthest on.
    facets : Facets
        Of the surface around it.
    ring : float
        About the distance between the cap's rings of vertices.

    Returns
    -------
    points : (k, 3)
        The inner vertices.
    triangles : (t, 3)
        An index below the rim's length is a vertex of the rim, a higher one an inner vertex.
    """
    extent = extent_of(rim)
    turn, waves = _rim_waves(rim)
    near = facets.near(rim.mean(axis=0), (0.5 + 3.0 * CAPS.band) * extent, CAPS.faces_most)
    slope = _slope_waves(waves, near, CAPS.band * extent)
    if slope is None:
        return None
    b = 0.5 * (slope - _ORDERS[:, None] * waves)
    rings = int(np.clip(round(0.5 * extent / ring), 1, CAPS.rings_most))
    counts = [CAPS.ring_steps * k for k in range(rings - 1, 0, -1)]
    share = np.repeat(np.append(np.arange(rings - 1, 0, -1), 0) / rings, [*counts, 1])
    angles = np.concatenate([*(_even(count) for count in counts), np.zeros(1)])
    radial = (waves - b) * share[:, None, None] ** _ORDERS[:, None]
    radial = radial + b * share[:, None, None] ** (_ORDERS[:, None] + 2.0)
    spin = np.exp(1j * np.outer(angles, _WAVE_NUMBERS))
    points = np.einsum("kn,knc->kc", spin, radial).real
    return points, _triangles(turn, counts)


def _even(count: int) -> Floats:
    """Angles (count,) spread evenly over a turn, from 0 on."""
    return np.asarray(_TURN * np.arange(count) / count)


def _rim_waves(rim: Floats) -> tuple[Floats, Waves]:
    """Each rim vertex's share of a turn by the rim's length, (k,), and the rim's waves (w, 3)."""
    sides = np.linalg.norm(np.roll(rim, -1, axis=0) - rim, axis=1)
    run = _TURN * np.append(0.0, np.cumsum(sides)) / sides.sum()
    closed = np.vstack([rim, rim[:1]])
    angles = _even(CAPS.rim_samples)
    samples = np.column_stack([np.interp(angles, run, column) for column in closed.T])
    return run[:-1], _waves(samples)


def _waves(samples: Floats) -> Waves:
    """The first waves (w, 3) of evenly spaced samples (s, 3) around a turn."""
    back = np.exp(-1j * np.outer(_WAVE_NUMBERS, _even(len(samples))))
    return np.asarray(back @ samples / len(samples))


def _slope_waves(waves: Waves, near: Facets, reach: float) -> Waves | None:
    """The waves (w, 3) of the outward derivative at the rim, along the surface around it.

    A flat cap's derivative is laid into the tangent plane that the facets within ``reach`` have.
    """
    spin = np.exp(1j * np.outer(_even(CAPS.slope_samples), _WAVE_NUMBERS))
    place = (spin @ waves).real
    flat = (spin @ (_ORDERS[:, None] * waves)).real
    squares = ((place[:, None, :] - near.middles) ** 2).sum(axis=2)
    weight = np.exp(-squares / (0.5 * reach**2))
    area = weight * row_lengths(near.vectors)
    outside = area @ near.middles - area.sum(axis=1)[:, None] * place
    outward = place - waves[CAPS.harmonics].real
    if _mean_cosine(outside, outward) < CAPS.patch_cosine:
        return None
    normal = unit(weight @ near.vectors)
    along = flat - normal * row_dots(normal, flat)[:, None]
    longer = row_lengths(flat) / np.maximum(row_lengths(along), np.finfo(np.float64).tiny)
    return _waves(along * np.minimum(longer, CAPS.stretch_most)[:, None])


def _mean_cosine(rows: Floats, others: Floats) -> float:
    """The cosine between rows of (k, 3), averaged by the product of their lengths."""
    total = float((row_lengths(rows) * row_lengths(others)).sum())
    return float(np.einsum("ij,ij->", rows, others)) / total if total > 0.0 else -1.0


# ---------------------------------------------------------------- triangles


def _triangles(turn: Floats, counts: list[int]) -> Ints:
    """Triangles from the rim, at shares ``turn`` of a turn, over rings to the middle, (t, 3)."""
    starts = len(turn) + np.append(0, np.cumsum(counts)).astype(np.int64)
    angles = [turn, *(_even(count) for count in counts)]
    rings = [np.arange(len(turn))]
    rings += [start + np.arange(count) for start, count in zip(starts, counts, strict=False)]
    bands = [_band(rings[k], angles[k], rings[k + 1], angles[k + 1]) for k in range(len(counts))]
    last = rings[-1]
    fan = np.stack([last, np.roll(last, -1), np.full(len(last), starts[-1])], axis=1)
    return np.concatenate([*bands, fan])


def _band(outer: Ints, at: Floats, inner: Ints, within: Floats) -> Ints:
    """Triangles between two rings, their sides in the order of their middles' angles."""
    at, within = (0.5 * (a + np.append(a[1:], _TURN)) for a in (at, within))
    beside = np.searchsorted(within, at, side="left") % len(inner)
    opposite = np.searchsorted(at, within, side="right") % len(outer)
    inward = np.stack([outer, np.roll(outer, -1), inner[beside]], axis=1)
    outward = np.stack([outer[opposite], np.roll(inner, -1), inner], axis=1)
    return np.concatenate([inward, outward])
