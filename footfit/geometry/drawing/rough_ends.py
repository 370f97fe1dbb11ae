"""Roughness that irregular facets leave on a closed outline, taken off without its corners."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from footfit.geometry.mesh.outlines import (
    MEDIAN_SQUARE,
    TAPE_OUTLINES,
    EvenLoop,
    bell,
    convolved,
    even_loop,
    parabola_keeping_kernel,
)
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class RoughnessSettings:
    """What is roughness, and what is taken off; lengths over that of the shape.

    Attributes
    ----------
    fine, smoothing : float
        The spread of the kernel that shows roughness, and of the one that takes it off.
    around : float
        Roughness is the median along so much of the outline, which a single corner does not
        change; it counts as far around.
    clean : float
        A clean mesh has up to so much.
    bump_times, dent_times : float
        What stands out, or in, is taken off up to so many times the mean square of roughness.
        Facets lie inside a round edge, so dents are theirs.
    bump, bump_noise : float
        What stands out is lowered by ``bump`` at most, or by ``bump_noise`` times the roughness if
        that is more. So a corner keeps its place.
    """

    fine: float = 0.006
    smoothing: float = 0.016
    around: float = 0.12
    clean: float = 0.00005
    bump_times: float = 64.0
    dent_times: float = 512.0
    bump: float = 0.0007
    bump_noise: float = 2.0


ROUGHNESS = RoughnessSettings()
ANY_ROUGHNESS = replace(ROUGHNESS, clean=0.0)
"""For the outline of a mesh that is known to be rough."""


def roughness(loop: Floats, length: float, settings: RoughnessSettings = ROUGHNESS) -> Floats:
    """How rough an outline (n, 2) is around each of its points, (n,), over the ``length``.

    0 where it is as smooth as that of a clean mesh.
    """
    even = even_loop(loop, length, TAPE_OUTLINES)
    step = even.length / len(even.points)
    square = np.square(_off(even, settings.fine * length / step)).sum(axis=1)
    reach = int(0.5 * settings.around * length / step)
    median = _windows(np.median(_windows(square, reach), axis=1), reach).max(axis=1) / MEDIAN_SQUARE
    rough = np.sqrt(np.maximum(median - (settings.clean * length) ** 2, 0.0)) / length
    return np.asarray(np.interp(even.arc, even.at, rough, period=even.length))


def without_roughness(
    loop: Floats, length: float, rough: Floats, settings: RoughnessSettings = ROUGHNESS
) -> Floats:
    """A closed outline (n, 2) with as many points, smoothed where it is rough all along.

    ``length`` is that of the shape, and ``rough`` (n,) the `roughness` around each point. Where
    that is 0 the outline stays as it is.
    """
    even = even_loop(loop, length, TAPE_OUTLINES)
    step = even.length / len(even.points)
    rough = np.interp(even.at, even.arc, length * rough, period=even.length)
    away = _off(even, settings.smoothing * length / step)
    square = np.square(away).sum(axis=1)
    spread = bell(settings.smoothing * length / step, TAPE_OUTLINES.reach)
    near = np.maximum(convolved(square[:, None], spread)[:, 0], 1e-12)
    along = np.roll(even.points, -1, axis=0) - np.roll(even.points, 1, axis=0)
    outward = away[:, 0] * along[:, 1] > away[:, 1] * along[:, 0]
    times = np.where(outward, settings.bump_times, settings.dent_times)
    share = np.minimum(1.0, times * np.square(rough) / near)
    most = np.maximum(settings.bump * length, settings.bump_noise * rough)
    long = np.maximum(share * np.sqrt(square), 1e-12)
    share *= np.where(outward, np.minimum(1.0, most / long), 1.0)
    taken = away * share[:, None]
    moved = [np.interp(even.arc, even.at, column, period=even.length) for column in taken.T]
    return np.asarray(loop - np.column_stack(moved))


def _off(even: EvenLoop, spread: float) -> Floats:
    """How far an even loop's points lie off it once it is smoothed, (k, 2)."""
    return even.points - convolved(
        even.points, parabola_keeping_kernel(spread, TAPE_OUTLINES.reach)
    )


def _windows(values: Floats, reach: int) -> Floats:
    """What lies around each of a closed loop's values (k,), ``reach`` steps both ways, (k, w)."""
    half = min(reach, (len(values) - 1) // 2)
    wrapped = np.concatenate([values[-half:], values, values[:half]]) if half else values
    return np.lib.stride_tricks.sliding_window_view(wrapped, 2 * half + 1)
