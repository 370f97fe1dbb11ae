"""Angles against their closed forms, and against what arccos loses."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.numeric.angles import angle_between, turning_angle
from tests.bounds import EXACT
from tests.strategies import rotations

turns = st.floats(-np.pi + 1e-9, np.pi)
lengths = st.floats(1e-3, 1e3)


@given(turns, turns, lengths, lengths)
@settings(max_examples=60, deadline=None)
def test_turning_angle_is_the_difference_of_directions(start, turn, long, wide):
    def leg(angle, length):
        return length * np.array([np.cos(angle), np.sin(angle)])

    found = turning_angle(leg(start, long), leg(start + turn, wide))
    assert abs(np.angle(np.exp(1j * (found - turn)))) < EXACT


@given(rotations(), st.floats(0.0, np.pi), lengths)
@settings(max_examples=60, deadline=None)
def test_angle_between_survives_rotation_and_length(rotation, angle, length):
    a = rotation @ np.array([1.0, 0.0, 0.0])
    b = rotation @ np.array([np.cos(angle), np.sin(angle), 0.0]) * length
    assert abs(angle_between(a, b) - angle) < EXACT


def test_an_angle_near_pi_keeps_the_digits_that_arccos_loses():
    bend = 1e-9
    a, b = np.array([1.0, 0.0, 0.0]), np.array([-np.cos(bend), np.sin(bend), 0.0])
    assert abs((np.pi - angle_between(a, b)) - bend) < 1e-15
    assert abs((np.pi - np.arccos(a @ b)) - bend) > 0.5 * bend


def test_angles_broadcast_and_turning_is_odd():
    a, b = np.array([[1.0, 0.0], [0.0, 1.0]]), np.array([1.0, 1.0])
    np.testing.assert_allclose(turning_angle(a, b), [np.pi / 4, -np.pi / 4])
    np.testing.assert_allclose(turning_angle(b, a), -turning_angle(a, b))
