"""Arrays as the catalogue keeps them: little-endian float64, row by row, nothing before it."""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from functools import lru_cache
from typing import Any

import numpy as np

from footfit.geometry.arrays import Floats
from footfit.geometry.flare import FlareDefinition


def blob(array: Floats) -> bytes:
    """The bytes of an array.

    Examples
    --------
    >>> blob(np.array([1.0])).hex()
    '000000000000f03f'
    """
    return np.ascontiguousarray(array, dtype="<f8").tobytes()


def array_of(data: bytes, *shape: int) -> Floats:
    """The array of some bytes, read-only, of ``shape``; (n,) where none is given.

    Examples
    --------
    >>> array_of(blob(np.eye(2)), 2, 2).tolist()
    [[1.0, 0.0], [0.0, 1.0]]
    """
    flat = np.frombuffer(data, dtype="<f8").astype(np.float64, copy=False)
    return flat.reshape(shape) if shape else flat


def definition_text(definition: FlareDefinition) -> str:
    """A flare definition with all its parameters as canonical JSON."""
    return json.dumps(asdict(definition), sort_keys=True, separators=(",", ":"))


@lru_cache(maxsize=64)
def definition_of(text: str) -> FlareDefinition:
    """The definition of a stored text.

    An older definition may lack a parameter that this footfit knows, or have one that it no
    longer knows: such a one keeps its version, by which everyone tells that its profile is not
    comparable; ``upgrade-catalogue`` makes it anew.
    """
    known = {field.name for field in fields(FlareDefinition)}
    stored = {name: _frozen(value) for name, value in json.loads(text).items() if name in known}
    return FlareDefinition(**stored)


def _frozen(value: Any) -> Any:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value
