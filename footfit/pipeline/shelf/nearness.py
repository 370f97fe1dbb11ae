"""How near lasts are to a shape by its flare, and by its measures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from footfit.geometry.flare.definition import CHANNELS, FlareProfile
from footfit.geometry.flare.profile_distance import (
    ProfileDistances,
    distance_parts,
    parts_of_inside,
    require_same_stations,
    total_distance,
)
from footfit.geometry.numeric.arrays import Floats, distinct
from footfit.results import Profiled
from footfit.results.columns.last_columns import LastColumns
from footfit.results.columns.vocabulary import NO_WORD

LENGTH_SD_MM = 0.5
"""Repeatability of an aligned length between two scans of one shape (docs/alignment.md)."""
INDEPENDENT = 6.0
"""How many independent measures a shape's measures are worth in a search by shape."""


def flare_distances(profile: FlareProfile, lasts: LastColumns) -> ProfileDistances:
    """The profile distances of n lasts, which have their flare profiles.

    Raises
    ------
    ValueError
        A last has other stations: it follows another definition.
    """
    assert lasts.flare is not None
    assert lasts.flare.plan is not None
    assert lasts.flare.bottom is not None
    require_same_stations(len(profile.stations), lasts.stations)
    bottom = lasts.flare.bottom
    curves = [lasts.flare.plan, *(bottom[:, channel] for channel in range(bottom.shape[1]))]
    parts = distance_parts(profile, curves)
    return ProfileDistances(
        total_distance(parts), {name: parts[:, i] for i, name in enumerate(CHANNELS)}
    )


def feet_distance(feet: Sequence[Profiled], lasts: LastColumns) -> Floats:
    """The profile distance of n lasts; two feet count by their root mean square."""
    each = [flare_distances(foot.flare, lasts).total for foot in feet]
    return np.asarray(np.sqrt(np.mean(np.square(each), axis=0)))


def curves_distance(feet: Sequence[Profiled], curves: Floats) -> Floats:
    """As `feet_distance`, of profiles (n, channels, stations) at the stations that count."""
    channels = [curves[:, channel] for channel in range(curves.shape[1])]
    each = [total_distance(parts_of_inside(foot.flare, channels)) for foot in feet]
    return np.asarray(np.sqrt(np.mean(np.square(each), axis=0)))


def shape_distance(feet: Sequence[Profiled], longer: int, lasts: LastColumns) -> Floats:
    """How far n lasts are from a shape by flare and by size."""
    profile = feet_distance(feet, lasts)
    nearness: Floats = np.sqrt(np.square(profile) + size_squares(feet[longer], lasts))
    return nearness


def size_squares(mesh: Profiled, lasts: LastColumns) -> Floats:
    """How far each last's measures are from the mesh's, (n,), in squared standard deviations.

    It is the square of the extents' difference plus the mean square of the other measures'
    differences, times INDEPENDENT: the measures of one shape are not independent of each other, so
    their number does not matter.
    """
    total, count = np.zeros((2, len(lasts)))
    assert lasts.measures is not None
    own = {measure.name: measure for measure in mesh.measures if measure.name != "length"}
    for name in lasts.measures.names:
        ours = own.get(name)
        if ours is None or ours.measured.value is None or not ours.measured.sd:
            continue
        theirs = lasts.measure(name)
        shared = ~np.isnan(theirs.value) & (theirs.sd != 0.0)
        for word in distinct(theirs.word).tolist():
            if word == NO_WORD or lasts.words.measures.values[word][0] != ours.definition:
                shared &= theirs.word != word
        spread = ours.measured.sd**2 + np.square(theirs.sd)
        square = np.square(theirs.value - ours.measured.value) / spread
        total += np.where(shared, square, 0.0)
        count += shared
    mean = total / np.maximum(count, 1.0)
    longer_mm = lasts.extent_mm - mesh.aligned.alignment.extent_mm
    return np.asarray(np.square(longer_mm) / (2.0 * LENGTH_SD_MM**2) + INDEPENDENT * mean)
