"""Arrays as the catalogue keeps them: little-endian float64, row by row, without a header."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from functools import lru_cache
from typing import Any

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.numeric.arrays import Floats

_LITTLE = np.dtype("<f8")


def blob(array: Floats) -> bytes:
    """The bytes of an array.

    Examples
    --------
    >>> blob(np.array([1.0])).hex()
    '000000000000f03f'
    """
    return (array if array.dtype == _LITTLE else np.asarray(array, dtype=_LITTLE)).tobytes()


def array_of(data: bytes, *shape: int) -> Floats:
    """The array of some bytes, read-only, with the given shape; (n,) if none is given.

    Examples
    --------
    >>> array_of(blob(np.eye(2)), 2, 2).tolist()
    [[1.0, 0.0], [0.0, 1.0]]
    """
    flat = np.frombuffer(data, dtype="<f8").astype(np.float64, copy=False)
    return flat.reshape(shape) if shape else flat


@lru_cache(maxsize=64)
def definition_text(definition: FlareDefinition) -> str:
    """A flare definition with all its parameters, as canonical JSON."""
    return json.dumps(asdict(definition), sort_keys=True, separators=(",", ":"))


def json_text(value: Any) -> str:
    """A plain value as canonical JSON: a mapping, a list, or a tuple of dataclasses."""
    plain = [asdict(item) for item in value] if isinstance(value, tuple) else dict(value)
    return json.dumps(plain, sort_keys=True, separators=(",", ":"), allow_nan=False)


@lru_cache(maxsize=64)
def definition_of(text: str) -> FlareDefinition:
    """The definition of a stored text.

    A text of another footfit may lack a parameter that this one has. The parameter is then NaN,
    which equals no value, because nobody knows what it was. A parameter that this footfit does
    not have is skipped. So whether two profiles can be compared is decided by their texts, which
    have every parameter.
    """
    stored = {name: _frozen(value) for name, value in json.loads(text).items()}
    default = asdict(FlareDefinition())
    return FlareDefinition(
        **{name: stored.get(name, _unknown(value)) for name, value in default.items()}
    )


def _unknown(like: Any) -> Any:
    """A value of the type of ``like`` that stands for an unknown one."""
    if isinstance(like, str):
        return ""
    return tuple(_unknown(item) for item in like) if isinstance(like, tuple) else math.nan


def _frozen(value: Any) -> Any:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value
