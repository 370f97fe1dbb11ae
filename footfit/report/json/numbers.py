"""Numbers as JSON carries them: rounded, finite, without a negative zero."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from footfit.report.json.lines import Json

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from footfit.results import Measured

MILLIMETRE_DIGITS = 3
DEGREE_DIGITS = 3
RATIO_DIGITS = 6


def rounded(value: float | None, digits: int) -> float | None:
    """``value`` to ``digits`` decimals; None for None, NaN and the infinities.

    Examples
    --------
    >>> rounded(1.23456, 3), rounded(-0.0001, 3), rounded(float("nan"), 3)
    (1.235, 0.0, None)
    """
    if value is None or not math.isfinite(value):
        return None
    return round(float(value), digits) + 0.0


def millimetres(value: float | None) -> float | None:
    """A length in mm, to 0.001."""
    return rounded(value, MILLIMETRE_DIGITS)


def degrees(value: float | None) -> float | None:
    """An angle in degrees, to 0.001."""
    return rounded(value, DEGREE_DIGITS)


def ratio(value: float | None) -> float | None:
    """A number without a unit, to 0.000001."""
    return rounded(value, RATIO_DIGITS)


def nested(values: ArrayLike, digits: int) -> list[object]:
    """An array as nested lists of numbers, each as `rounded` gives it.

    Examples
    --------
    >>> nested([[1.00049, -0.0001], [float("inf"), 2.0]], 3)
    [[1.0, 0.0], [None, 2.0]]
    """
    array = np.asarray(values, dtype=np.float64)
    if array.ndim > 1:
        return [nested(row, digits) for row in array]
    return [rounded(value, digits) for value in array.tolist()]


def measured_value(measured: Measured) -> Json:
    """A measured value as ``{"value", "sd", "reason"}``; a reason only where value is null.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> measured_value(Measured(262.31049, 0.4))
    {'value': 262.31, 'sd': 0.4, 'reason': None}
    """
    value = millimetres(measured.value)
    reason = None if value is not None else measured.reason or "not measured"
    return {"value": value, "sd": millimetres(measured.sd), "reason": reason}
