"""Sketches of flare profiles: short vectors whose distances are never more than D.

A search looks at the sketches of all profiles, and at the whole profiles only of those that may be
near. It loses none: a sketch's distance is a lower bound, whatever the profiles are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.flare.profile_distance import DISTANCE, inside
from footfit.geometry.numeric.arrays import Floats

Sketches = NDArray[np.float32]
"""n sketches, (n, SKETCH.width)."""


@dataclass(frozen=True, slots=True)
class SketchSettings:
    """How many cosines of each channel a sketch has, in CHANNELS' order, and what float32 can cost.

    Curves are smooth: a few cosines hold most of a channel's difference (docs/speed.md). A product
    of `width` terms in float32 is wrong by less than ``rounding`` times the sum of both squares:
    twice `width` roundings of 2^-24 are 6e-6.
    """

    waves: tuple[int, ...] = (12, 8, 8, 8, 8)
    rounding: float = 1e-5

    @property
    def width(self) -> int:
        """How many numbers a sketch has: cosines, the rest of each channel, and the square."""
        return sum(self.waves) + len(self.waves) + 1


SKETCH = SketchSettings()


def sketches(curves: Floats) -> Sketches:
    """The sketches (k, width) of profiles (k, channels, stations), at the stations that count.

    A sketch is the channel's first cosines and the length of what they leave, in units in which
    the squared distance of two profiles is D^2. Last comes the square of all, less its rounding.
    The sketch of a profile that lacks a channel is NaN: nothing bounds its distance.
    """
    numbers = _coordinates(curves).astype(np.float32)
    square = np.square(numbers.astype(np.float64)).sum(axis=1) * (1.0 - SKETCH.rounding)
    return np.column_stack([numbers, square.astype(np.float32)])


def least_squares(feet: Sequence[FlareProfile], many: Sketches) -> NDArray[np.float32] | None:
    """Lower bounds (k,) of D^2, of several feet its mean; NaN where nothing is known.

    None if a foot lacks a channel: the others then have its weight, and sketches say nothing.
    """
    own = []
    for foot in feet:
        curves = [foot.curvature.get(name) for name in CHANNELS]
        if any(curve is None or not np.isfinite(curve).all() for curve in curves):
            return None
        whole = np.array([curves], dtype=np.float64)
        own.append(_coordinates(whole[:, :, inside(foot.stations)])[0])
    square = np.mean([np.square(numbers).sum() for numbers in own])
    factors = np.append(-2.0 * np.mean(own, axis=0), 1.0).astype(np.float32)
    bounds: NDArray[np.float32] = many @ factors
    bounds += np.float32(square * (1.0 - SKETCH.rounding))
    return bounds


def _coordinates(curves: Floats) -> Floats:
    """Profiles (k, channels, stations) as points (k, width - 1) that are never further apart."""
    count = curves.shape[2]
    scale = np.sqrt(np.array(DISTANCE.weights) / count) / np.array(DISTANCE.sd)
    points = []
    for channel, waves in enumerate(SKETCH.waves):
        curve = scale[channel] * curves[:, channel]
        cosines = curve @ _cosines(count, waves)
        rest = np.square(curve).sum(axis=1) - np.square(cosines).sum(axis=1)
        points += [cosines, np.sqrt(np.maximum(rest, 0.0))[:, None]]
    return np.concatenate(points, axis=1)


def _cosines(count: int, waves: int) -> Floats:
    """The first cosines over so many stations, (count, waves): orthonormal columns."""
    angle = np.pi * np.outer(np.arange(count) + 0.5, np.arange(waves)) / count
    columns = np.cos(angle)
    return np.asarray(columns / np.sqrt(np.square(columns).sum(axis=0)))
