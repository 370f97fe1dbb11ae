"""Distinct values, medians and quantiles: as NumPy's, without what NumPy loads for them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footfit.geometry.numeric.arrays import distinct
from footfit.geometry.numeric.quantiles import median, quantile


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 90), share=st.floats(0.0, 1.0))
def test_they_are_those_of_numpy_to_the_last_bit(seed: int, count: int, share: float) -> None:
    rng = np.random.default_rng(seed)
    values = rng.normal(size=count) * 10.0 ** rng.uniform(-3.0, 3.0)
    values = values[rng.integers(0, count, size=count)]  # some of them are equal
    assert quantile(values, share) == np.quantile(values, share)
    assert median(values) == np.median(values)
    assert distinct(values).tolist() == np.unique(values).tolist()


@pytest.mark.parametrize("shape", [(0,), (1,), (4, 3)])
def test_distinct_values_of_any_shape(shape: tuple[int, ...]) -> None:
    values = np.random.default_rng(3).integers(0, 5, size=shape)
    assert distinct(values).tolist() == np.unique(values).tolist()
