"""III.B: concentrated curvature of polygonal curves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.numeric.polylines import arc_length, concentrated_curvature, curvature_density
from tests.bounds import EXACT, ROUNDING
from tests.strategies import rotations, scales, seeds


def _star_polygon(seed: int, corners: int) -> np.ndarray:
    """A simple polygon, counter-clockwise: sorted angles with gaps under pi, random radii."""
    rng = np.random.default_rng(seed)
    angle = (np.arange(corners) + rng.uniform(0.0, 0.8, corners)) * 2 * np.pi / corners
    reach = rng.uniform(0.5, 2.0, corners)
    return reach[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


@given(seeds, st.integers(4, 40))
@settings(max_examples=60, deadline=None)
def test_a_simple_closed_curve_turns_by_two_pi(seed, corners):
    polygon = _star_polygon(seed, corners)
    assert abs(concentrated_curvature(polygon, closed=True).sum() - 2 * np.pi) < ROUNDING
    assert abs(concentrated_curvature(polygon[::-1], closed=True).sum() + 2 * np.pi) < ROUNDING


@given(seeds, st.floats(0.1, 100.0))
@settings(max_examples=40, deadline=None)
def test_the_density_on_uneven_points_of_a_circle_is_one_over_its_radius(seed, radius):
    rng = np.random.default_rng(seed)
    angle = np.cumsum(rng.uniform(0.01, 0.05, 60))
    circle = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    density = curvature_density(circle)[1:-1]
    np.testing.assert_allclose(density * radius, 1.0, atol=0.05**2 / 12)


def test_eq_12_the_arc_in_the_corner_turns_by_pi_minus_gamma_whatever_its_radius():
    gamma = np.radians(100.0)
    corner = np.array([[1.0, 0.0], [0.0, 0.0], [np.cos(gamma), np.sin(gamma)]])
    for radius in (0.01, 0.3):
        reach = radius / np.tan(gamma / 2)  # from p to where the circle touches a leg
        arc = 2.0 * np.arctan2(reach, radius) * radius
        assert abs(arc / radius - abs(concentrated_curvature(corner)[1])) < EXACT
    assert abs(concentrated_curvature(corner)[1]) == pytest.approx(np.pi - gamma, abs=1e-14)


def test_ends_are_nan_and_signs_follow_the_turn():
    left = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]])
    curvature = concentrated_curvature(left)
    assert np.isnan(curvature[[0, -1]]).all()
    assert curvature[1] == pytest.approx(np.pi / 4)
    assert concentrated_curvature(left * [1, -1])[1] == pytest.approx(-np.pi / 4)


@given(rotations(), scales(), seeds)
@settings(max_examples=40, deadline=None)
def test_laws_in_space(rotation, scale, seed):
    points = np.cumsum(np.random.default_rng(seed).normal(size=(12, 3)), axis=0)
    moved = scale * points @ rotation.T
    np.testing.assert_allclose(
        concentrated_curvature(moved)[1:-1], concentrated_curvature(points)[1:-1], atol=ROUNDING
    )
    np.testing.assert_allclose(
        curvature_density(moved)[1:-1] * scale, curvature_density(points)[1:-1], rtol=1e-9
    )
    np.testing.assert_allclose(arc_length(moved), scale * arc_length(points), rtol=EXACT)


def test_the_plane_is_the_space_without_height():
    points = _star_polygon(3, 9)
    flat = np.column_stack([points, np.zeros(9)])
    np.testing.assert_allclose(
        np.abs(concentrated_curvature(points, True)), concentrated_curvature(flat, True), atol=1e-14
    )


def test_too_short_is_said_and_repeated_points_do_not_divide_by_zero():
    with pytest.raises(ValueError, match="3 points"):
        concentrated_curvature(np.zeros((2, 2)))
    assert np.isnan(curvature_density(np.zeros((4, 2)))).all()
