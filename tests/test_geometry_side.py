"""The side's score is odd under mirroring and knows lasts whose side is planted."""

from __future__ import annotations

import numpy as np
import pytest

from footfit.geometry.mesh.samples import quadrature
from footfit.geometry.pose.frame import canonical_frame
from footfit.geometry.pose.side import SIDE, confidence, side_score
from tests.bounds import ROUNDING
from tools.lasts import LastSpec, last_mesh


def canonical_points(spec):
    vertices, faces = last_mesh(spec)
    sample = quadrature(vertices, faces, 0.03 * spec.length_mm)
    frame = canonical_frame(sample, spec.length_mm)
    return sample.points @ frame.rotation.T + frame.shift, frame.length


@pytest.mark.parametrize("flare_deg", [4.0, 8.0, 14.0])
@pytest.mark.parametrize("heel_height_mm", [0.0, 25.0, 60.0])
def test_inflared_lasts_are_right_and_their_mirror_images_left(flare_deg, heel_height_mm):
    spec = LastSpec(flare_deg=flare_deg, heel_height_mm=heel_height_mm, rings=60, segments=48)
    points, length = canonical_points(spec)
    here = side_score(points, length)
    there = side_score(points * [1.0, -1.0, 1.0], length)
    assert here > 2.4  # measured 4.1
    assert there == pytest.approx(-here, abs=ROUNDING)


def test_a_symmetric_shape_is_undecided():
    rng = np.random.default_rng(0)
    half = rng.random((4000, 3)) * [260.0, 45.0, 60.0]
    points = np.concatenate([half, half * [1.0, -1.0, 1.0]])
    score = side_score(points, 260.0)
    assert abs(score) < ROUNDING
    assert confidence(score) == "undecided"


def test_the_words_follow_the_score():
    words = [confidence(score) for score in (-4.0, -1.0, 0.2, 1.0, 2.5)]
    assert words == ["sure", "low", "undecided", "low", "sure"]


@pytest.mark.parametrize(("each", "counts"), [(7, False), (8, True)])
def test_a_station_counts_from_eight_points_on(each, counts):
    station = np.repeat(np.arange(SIDE.stations) + 0.5, each) / SIDE.stations
    across = np.tile(np.linspace(-0.15, 0.15, each), SIDE.stations)
    points = np.stack([station, across + 0.3 * station**2, 0.0 * station], axis=1) * 260.0
    points[0, 0] = 0.0
    assert (side_score(points, 260.0) > 0.0) is counts


def test_too_few_stations_say_nothing():
    assert side_score(np.zeros((30, 3)), 260.0) == 0.0
