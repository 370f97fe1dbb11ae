"""What a bound is for where it is not a measured one; a bare ``pytest.approx`` is for rounding too.

Every other bound stands beside its comparison, says what it allows, and is at most twice what was
measured.
"""

EXACT = 1e-12
"""Equal to the last digits of float64, for values of about 1."""

ROUNDING = 1e-9
"""Equal but for rounding, for values up to some hundred mm or degrees."""

POSED = 1e-8
"""Equal but for rounding that the pose search has passed on, in mm: 3.6e-9 is the most seen."""
