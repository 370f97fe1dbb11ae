"""The distance of two flare profiles, in units of the difference of two scans of one shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.numeric.arrays import Floats, Ints


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


def inside(stations: Floats) -> slice:
    """The stations of a profile that count."""
    low, high = (
        np.searchsorted(stations, DISTANCE.stations[0], side="left"),
        np.searchsorted(stations, DISTANCE.stations[1], side="right"),
    )
    return slice(int(low), int(high))


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
    require_same_stations(count, [len(other.stations) for other in many])
    curves = stacked(many, count)
    parts = distance_parts(profile, [curves[:, channel] for channel in range(len(CHANNELS))])
    return ProfileDistances(
        total_distance(parts), {name: parts[:, i] for i, name in enumerate(CHANNELS)}
    )


def require_same_stations(count: int, counts: Sequence[int] | Ints) -> None:
    """Raise ValueError unless all profiles have so many stations."""
    if (np.asarray(counts) != count).any():
        raise ValueError("profiles of different definitions cannot be compared: upgrade the older")


def distance_parts(profile: FlareProfile, curves: Sequence[Floats]) -> Floats:
    """What each channel adds to D^2, (k, channels), NaN where it is not known.

    ``curves`` are the channels of k profiles in their order, (k, stations) each. The channels that
    both profiles have share the weight of the others.
    """
    part = inside(profile.stations)
    return parts_of_inside(profile, [curve[:, part] for curve in curves])


def parts_of_inside(profile: FlareProfile, curves: Sequence[Floats]) -> Floats:
    """As `distance_parts`, of curves that have only the stations that count."""
    part = inside(profile.stations)
    squared = np.empty((len(curves[0]), len(CHANNELS)))
    for channel, name in enumerate(CHANNELS):
        here = profile.curvature.get(name)
        if here is None:
            squared[:, channel] = np.nan
            continue
        difference = curves[channel] - here[part]
        squared[:, channel] = np.square(difference, out=difference).mean(axis=1)
    squared /= np.square(DISTANCE.sd)
    weights = np.where(np.isfinite(squared), np.array(DISTANCE.weights), 0.0)
    carried = weights.sum(axis=1, keepdims=True)
    return np.asarray(
        squared * np.array(DISTANCE.weights) / np.where(carried > 0.0, carried, np.nan)
    )


def total_distance(parts: Floats) -> Floats:
    """D (k,) of its parts; NaN where no channel is known."""
    known = np.isfinite(parts)
    total = np.sqrt(np.where(known, parts, 0.0).sum(axis=1))
    return np.where(known.any(axis=1), total, np.nan)


def stacked(profiles: Sequence[FlareProfile], stations: int) -> Floats:
    """Their channels, (k, channels, stations); NaN where one is missing."""
    missing = np.full(stations, np.nan)
    rows = [[p.curvature.get(name) for name in CHANNELS] for p in profiles]
    curves = [[missing if c is None else c for c in row] for row in rows]
    return np.array(curves, dtype=np.float64).reshape(len(profiles), len(CHANNELS), stations)
