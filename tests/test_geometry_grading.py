"""The law of a run, and the break that a wrong last or a wrong step makes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footfit.geometry.grading.run_laws import Steps, likely_law, median_rate

SIZES = np.arange(38.0, 47.0)


@given(st.floats(1.0, 10.0), st.integers(0, 7), st.floats(-5.0, 5.0))
def test_a_wrong_step_is_off_by_what_it_is_wrong(by: float, at: int, wrong: float) -> None:
    value = 200.0 + by * (SIZES - SIZES[0])
    value[at + 1 :] += wrong
    steps = Steps(SIZES, value)
    off = steps.increment_mm - steps.expected_mm("arithmetic", median_rate([steps]))
    expected = np.zeros(len(off))
    expected[at] = wrong
    np.testing.assert_allclose(off, expected, atol=1e-9)


@pytest.mark.parametrize("ratio", [1.015, 1.03])
def test_a_run_of_ratios_is_geometric_and_has_no_break(ratio: float) -> None:
    steps = Steps(SIZES, 240.0 * ratio ** (SIZES - SIZES[0]))
    assert likely_law([steps]) == "geometric"
    expected = steps.expected_mm("geometric", steps.per_step("geometric"))
    np.testing.assert_allclose(steps.increment_mm, expected, rtol=1e-9)


def test_half_sizes_count_half() -> None:
    place = np.array([38.0, 38.5, 39.0, 40.0])
    steps = Steps(place, 240.0 + 5.0 * (place - 38.0))
    assert steps.per_step("arithmetic") == pytest.approx(5.0)
    np.testing.assert_allclose(steps.expected_mm("arithmetic", 5.0), [2.5, 2.5, 5.0])
