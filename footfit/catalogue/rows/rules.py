"""Rules for single stored values: a value outside of its rule cannot come from a scan.

A hash tells that a row is what was stored. It does not tell that what was stored makes sense:
these rules do.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from footfit.catalogue.rows.array_blobs import array_of
from footfit.geometry.numeric.arrays import Floats


@dataclass(frozen=True, slots=True)
class Limits:
    """Generous bounds: a value outside of them is wrong, a value inside may still be."""

    length_mm: tuple[float, float] = (50.0, 1000.0)
    flare_deg: float = 90.0
    heading_deg: float = 180.0
    orthonormal: float = 1e-6


LIMITS = Limits()


@dataclass(frozen=True, slots=True)
class Rule:
    """A test of one stored value; ``words`` say what the value must be."""

    words: str
    test: Callable[[Any], bool]

    def holds(self, value: object) -> bool:
        """Whether the value passes; one of another type or another length does not."""
        try:
            return bool(self.test(value))
        except (AttributeError, LookupError, TypeError, ValueError):
            return False


def number(low: float = -math.inf, high: float = math.inf) -> Rule:
    """A finite number from ``low`` to ``high``."""
    bounds = {"from": low, "to": high}
    words = [f" {word} {bound:g}" for word, bound in bounds.items() if math.isfinite(bound)]
    return Rule(
        f"a number{''.join(words)}",
        lambda value: (
            isinstance(value, int | float) and math.isfinite(value) and low <= value <= high
        ),
    )


def choice(*values: str | int) -> Rule:
    """One of the given values."""
    return Rule(f"one of {', '.join(map(str, values))}", lambda value: value in values)


def array(*shape: int) -> Rule:
    """The bytes of an array of that shape without an infinite number; NaN is allowed."""
    words = f"an array of shape {shape}" if shape else "an array"
    return Rule(words, lambda data: not np.isinf(array_of(data, *shape)).any())


def is_rotation(matrix: Floats) -> bool:
    """Whether a matrix (3, 3) is a rotation, within rounding."""
    error = np.abs(matrix @ matrix.T - np.eye(3)).max()
    return bool(error <= LIMITS.orthonormal and np.linalg.det(matrix) > 0)


def _is_sha256(value: object) -> bool:
    return isinstance(value, str) and len(value) == 64 and set(value) <= set("0123456789abcdef")


def _are_stations(data: bytes) -> bool:
    stations = array_of(data)
    inside = stations.min() >= 0 and stations.max() <= 1
    return bool(inside and (np.diff(stations) > 0).all())


def _are_moments(data: bytes) -> bool:
    moments = array_of(data, 3)
    return bool(np.isfinite(moments).all() and (moments >= 0).all())


TEXT = Rule("a text", lambda value: isinstance(value, str))
JSON = Rule("JSON", lambda value: isinstance(json.loads(value), dict | list))
WHOLE = Rule("a whole number", lambda value: isinstance(value, int))
BYTES = Rule("bytes", lambda value: isinstance(value, bytes))
ABOVE_ZERO = Rule("above zero", lambda value: number(0.0).holds(value) and value != 0)
NOT_BLANK = Rule("a text that is not blank", lambda value: bool(value.strip()))
SHA256 = Rule("a SHA-256 hash", _is_sha256)
POINT = Rule("a point", lambda data: bool(np.isfinite(array_of(data, 3)).all()))
ROTATION = Rule("a rotation", lambda data: is_rotation(array_of(data, 3, 3)))
MOMENTS = Rule("three moments that are not negative", _are_moments)
LENGTH = number(*LIMITS.length_mm)
FLARE_ANGLE = number(-LIMITS.flare_deg, LIMITS.flare_deg)
FLARE_CLASS = choice("outflare", "straight", "inflare")
UNITS_SOURCE = choice("declared", "detected", "known-length")
STATIONS = Rule("stations that increase from heel to toe", _are_stations)
