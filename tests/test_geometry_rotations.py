"""Rotations are rotations, and the grid leaves no gap."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.numeric.rotations import (
    angle_deg,
    nearest_rotation,
    rotations_about,
    super_fibonacci,
)
from tests import distortions
from tests.bounds import EXACT, ROUNDING


def test_the_grid_holds_rotations_without_a_gap():
    grid = super_fibonacci(576)
    np.testing.assert_allclose(
        grid @ grid.transpose(0, 2, 1), np.tile(np.eye(3), (576, 1, 1)), atol=EXACT
    )
    assert (np.linalg.det(grid) > 0).all()
    rng = np.random.default_rng(3)
    farthest = max(
        np.degrees(np.arccos((np.einsum("kij,ij->k", grid, R).max() - 1) / 2))
        for R in (distortions.random_rotation(rng) for _ in range(300))
    )
    assert farthest < 35.0  # 576 balls of 35 deg cover SO(3) about 1.5 times


@settings(max_examples=40, deadline=None)
@given(
    axis=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda a: np.linalg.norm(a) > 0.1),
    angle=st.floats(1e-6, 3.1),
)
def test_turning_by_a_vector_turns_by_its_length(axis, angle):
    vector = np.array(axis) / np.linalg.norm(axis) * angle
    turn = rotations_about(vector[None])[0]
    assert abs(np.radians(angle_deg(np.eye(3), turn)) - angle) < ROUNDING
    np.testing.assert_allclose(turn @ vector, vector, atol=EXACT)


def test_the_nearest_rotation_of_a_scaled_one_is_itself():
    R = distortions.random_rotation(np.random.default_rng(1))
    np.testing.assert_allclose(nearest_rotation(3.7 * R), R, atol=EXACT)
