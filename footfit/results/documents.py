"""Results as JSON: which keys a document has, and how a number is rounded. docs/json.md lists all.

Every result has ``to_dict()``: the document of its command, or its part of one. A number is rounded
by the unit that its key names: mm, mm2 and degrees to 0.001, cm2 to 0.1, the rest to 0.000001.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any

from footfit.version import __version__

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

Json = dict[str, Any]

MILLIMETRE_DIGITS = 3
RATIO_DIGITS = 6
_UNIT_DIGITS = {"mm": MILLIMETRE_DIGITS, "mm2": MILLIMETRE_DIGITS, "deg": 3, "cm2": 1}


def document(command: str, keys: Mapping[str, object], version: int = 1) -> Json:
    """``keys`` as `part` gives them, under the command's schema and this version."""
    header = {"schema": f"footfit.{command}/{version}", "footfit_version": __version__}
    return header | part(keys)


def part(keys: Mapping[str, object]) -> Json:
    """``keys`` with their values as JSON can carry them.

    Floats are rounded by their key's unit, and None where they are not finite; arrays and tuples
    become lists, results their ``to_dict()``. A dict stays as it is: it is a part already.

    Examples
    --------
    >>> part({"length_mm": 252.12345, "score": -0.0000001, "shift_mm": (1.0, float("nan"))})
    {'length_mm': 252.123, 'score': 0.0, 'shift_mm': [1.0, None]}
    """
    return {key: _plain(value, digits_of(key)) for key, value in keys.items()}


def fields(result: Any, *without: str) -> dict[str, object]:
    """The fields of a result by name, but for those in ``without``."""
    names = (field.name for field in dataclasses.fields(result))
    return {name: getattr(result, name) for name in names if name not in without}


def rows(columns: Sequence[str], values: Sequence[Sequence[object]]) -> list[Json]:
    """The rows of a table as dicts, their values as `part` gives them."""
    return [part(dict(zip(columns, row, strict=True))) for row in values]


def digits_of(key: str) -> int:
    """How many decimals a number has under this key.

    Examples
    --------
    >>> digits_of("length_mm"), digits_of("area_cm2"), digits_of("k1_per_mm")
    (3, 1, 6)
    """
    quantity, _, unit = key.rpartition("_")
    return RATIO_DIGITS if quantity.endswith("_per") else _UNIT_DIGITS.get(unit, RATIO_DIGITS)


def rounded(value: float | None, digits: int = MILLIMETRE_DIGITS) -> float | None:
    """``value`` to ``digits`` decimals; None for None, NaN and the infinities.

    Examples
    --------
    >>> rounded(1.23456, 3), rounded(-0.0001, 3), rounded(float("nan"), 3)
    (1.235, 0.0, None)
    """
    if value is None or not math.isfinite(value):
        return None
    return round(float(value), digits) + 0.0


def exact(parameters: Mapping[str, object]) -> Json:
    """A definition's parameters as JSON can carry them: unrounded, and finite or null.

    Examples
    --------
    >>> exact({"sd": 0.1, "limit": float("inf"), "windows": ((0.08, 0.3),)})
    {'sd': 0.1, 'limit': None, 'windows': [[0.08, 0.3]]}
    """
    return {key: _exact(value) for key, value in parameters.items()}


def _exact(value: Any) -> object:
    if hasattr(value, "tolist"):  # an array, or a number of NumPy's
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_exact(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _plain(value: Any, digits: int) -> object:
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_plain(item, digits) for item in value]
    return rounded(value, digits) if isinstance(value, float) else value
