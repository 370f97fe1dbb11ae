"""The distance of two flare profiles, in units of the difference of two scans of one shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class DistanceSettings:
    """Which stations count, and each channel's weight and repeatability, in CHANNELS' order.

    ``sd`` is the root mean square by which a channel differs between two scans of one shape
    (dimensionless): the table of docs/flare.md, made by benchmarks/flare.py. The weights sum to 1.
    With them the plan counts a little more between lasts than the bottom curves together, and these
    more than the surface. By repeatability alone, heel heights would outweigh the plan.
    """

    stations: tuple[float, float] = (0.08, 0.80)
    weights: tuple[float, ...] = (0.70, 0.07, 0.07, 0.07, 0.09)
    sd: tuple[float, ...] = (0.035, 0.035, 0.040, 0.045, 0.040)


DISTANCE = DistanceSettings()


@dataclass(frozen=True, slots=True)
class ProfileDistances:
    """Distances of one profile to k others: ``total`` (k,) is D, ``parts`` (k,) sum to D^2.

    A part is NaN if either profile lacks the channel; the other channels then get its weight.
    """

    total: Floats
    parts: dict[str, Floats]


def profile_distances(profile: FlareProfile, many: Sequence[FlareProfile]) -> ProfileDistances:
    """The distance D of one profile to each of many.

    D^2 = sum over the channels of w_c times the mean over stations of (difference)^2 / sd_c^2.
    Two scans of one shape are about 1 apart. D is free of scale: it cannot tell sizes apart.

    Parameters
    ----------
    profile : FlareProfile
    many : sequence of k FlareProfile
        With the same stations as ``profile``.

    Returns
    -------
    ProfileDistances

    Raises
    ------
    ValueError
        A profile has other stations: it follows another definition.
    """
    count = len(profile.stations)
    if any(len(other.stations) != count for other in many):
        raise ValueError("profiles of different definitions cannot be compared: upgrade the older")
    low, high = DISTANCE.stations
    inside = (profile.stations >= low) & (profile.stations <= high)
    here = _stacked([profile])[0][:, inside]
    there = _stacked(many).reshape(len(many), len(CHANNELS), count)[:, :, inside]
    squared = ((there - here) ** 2).mean(axis=2) / np.square(DISTANCE.sd)
    weights = np.where(np.isfinite(squared), np.array(DISTANCE.weights), 0.0)
    carried = weights.sum(axis=1, keepdims=True)
    parts = squared * np.array(DISTANCE.weights) / np.where(carried > 0.0, carried, np.nan)
    total = np.sqrt(np.where(weights > 0.0, parts, 0.0).sum(axis=1))
    total = np.where(carried[:, 0] > 0.0, total, np.nan)
    return ProfileDistances(total, {name: parts[:, i] for i, name in enumerate(CHANNELS)})


def _stacked(profiles: Sequence[FlareProfile]) -> Floats:
    """Their channels, (k, channels, stations); NaN where one is missing."""
    if not profiles:
        return np.empty(0)
    missing = np.full(len(profiles[0].stations), np.nan)
    rows = [[p.curvature.get(name) for name in CHANNELS] for p in profiles]
    return np.array([[missing if c is None else c for c in row] for row in rows], dtype=np.float64)
