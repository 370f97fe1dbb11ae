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


def printed(digits: int) -> float:
    """Half of the last decimal that a document prints: it is what printing takes from a number.

    Two numbers that are printed alike may differ by twice that.
    """
    return 0.500001 * 10.0**-digits
